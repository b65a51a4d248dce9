#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The demonstration, `./run demo [--seconds N] [--secure] [ARG…]`: the two agents of this example,
# and `cortex top` to look at them; where there is a display, the window too. They use the loopback interface and a domain of their own, so
# that they meet nothing else. Other ARGs go to both agents. The programs are in build/release/bin.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

say() { printf '\n== %s\n' "$*"; }
die() { printf 'error: %s\n' "$*" >&2; exit 1; }

demo() {
    local seconds=20 secure="" names=(robot operator) folder=build/demo bin=build/release/bin
    local name look="" pids ended="" window=""
    while (($#)); do
        case $1 in
            --seconds) seconds=${2:?--seconds needs a number}; shift 2 ;;
            --secure) secure=yes; shift ;;
            *) break ;;
        esac
    done
    export CORTEX_DOMAIN=${CORTEX_DOMAIN:-42}
    if "$bin/cortex" agents --interface lo --timeout 1 2>/dev/null; then
        die "these are on domain $CORTEX_DOMAIN; end them, or set CORTEX_DOMAIN to another one"
    fi
    rm -rf "$folder"
    mkdir -p "$folder"
    if [[ $secure ]]; then
        demoKeys
        look="; without a folder of this authority, one sees nobody"
    fi
    say "${names[*]} at 1 kHz for $seconds s; to look in from another terminal:
   export CORTEX_DOMAIN=$CORTEX_DOMAIN CORTEX_INTERFACE=lo${secure:+ CORTEX_SECURITY=$folder/station}; $bin/cortex list$look
   in a window: $bin/cortex-explorer"
    pids=()
    trap 'ended=signal' INT TERM HUP
    for name in "${names[@]}"; do
        "$bin/cortex-agent" "examples/lbr_teleop/$name.xml" --startup --interface lo \
            ${secure:+--security "$folder/$name"} --log "$folder/$name.log" "$@" \
            >"$folder/$name.txt" 2>&1 &
        pids+=($!)
    done
    "$bin/cortex" top --interface lo ${secure:+--security "$folder/station"} \
        --seconds "$seconds" <&0 &
    pids+=($!)
    if [[ ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]]; then
        "$bin/cortex-explorer" --interface lo ${secure:+--security "$folder/station"} /tracking \
            >"$folder/window.txt" 2>&1 &
        window=$!
    fi
    if [[ -z $ended ]]; then wait -n -p ended "${pids[@]}" || true; fi
    if [[ $window ]]; then kill "$window" 2>/dev/null || true; fi
    demoEnd "${ended:-signal}"
}

# An authority for the demonstration, a folder for each agent and one for tools.
demoKeys() {
    local cortex=$PWD/$bin/cortex
    say "security on: keys and rights in $folder"
    (
        cd "$folder" && "$cortex" security create-authority &&
            for name in "${names[@]}" station; do
                "$cortex" security create-agent "$name" || exit
            done
    ) >"$folder/security.txt" 2>&1 || { cat "$folder/security.txt"; return 1; }
}

# Stops what runs of the demonstration and tells how it went. $1: what ended by itself, if anything.
# No agent may end by itself; `cortex top` may, unless it fails.
demoEnd() {
    local ended=$1 i status top=0 failed=()
    kill -TERM "${pids[@]}" 2>/dev/null || true
    wait "${pids[2]}" || top=$?
    if [[ $ended == "${pids[2]}" ]] && ((top != 0)); then
        failed+=("cortex top ended with exit code $top")
    fi
    for i in 0 1; do
        status=0
        wait "${pids[i]}" || status=$?
        if ((status != 0)) || [[ $ended == "${pids[i]}" ]]; then
            failed+=("${names[i]} ended with exit code $status")
        fi
        say "${names[i]} (events: $folder/${names[i]}.log)"
        cat "$folder/${names[i]}.txt"
    done
    ((${#failed[@]} == 0)) || die "$(printf '%s; ' "${failed[@]}")see above and $folder"
}

demo "$@"
