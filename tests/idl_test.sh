#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The messages printed in docs/protocol.md are those of comms/idl. Usage: idl_test.sh SOURCE_DIR
set -euo pipefail
diff <(awk '/^```idl$/ {inside = 1; next} /^```$/ {inside = 0} inside' "$1/docs/protocol.md") \
    "$1/comms/idl/cortex.idl"
