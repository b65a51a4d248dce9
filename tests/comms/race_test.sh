#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# race_test.sh PROGRAM: the program races in a listener of Fast DDS, and ThreadSanitizer reports it.
code=0
output=$(env -u UBSAN_OPTIONS -u LSAN_OPTIONS TSAN_OPTIONS="${TSAN_OPTIONS:-}:log_path=stderr" \
    "$1" 2>&1) || code=$?
printf '%s\n' "$output" | head -40
[[ $code == 66 && $output == *"ThreadSanitizer: data race"* && $output == *heard* &&
    $output != *"nothing was heard"* ]]
