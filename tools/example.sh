#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# `./run example [NAME [--seconds N] [--secure] [ARG…]]`: the agents of a plant in examples/, and
# `cortex top` to look at them; where there is a display, the window too. They use the loopback
# interface and a domain of their own, so that they meet nothing else. Other ARGs go to all agents.
# A plant is a folder with a file `agents`: a line for each agent's system file, perhaps one with
# `simulator`, a program, the item of the address at which it listens and its options, then one with
# `show`, the path that the window shows first. The programs are in build/release/bin.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

say() { printf '\n== %s\n' "$*"; }
die() { printf 'error: %s\n' "$*" >&2; exit 1; }

# Each plant with the first sentence of its page.
list() {
    local file name
    for file in examples/*/agents; do
        name=$(basename "$(dirname "$file")")
        printf '%-14s %s\n' "$name" "$(awk 'NR > 2 && !NF {exit} NR > 2 {text = text " " $0}
            END {sub(/^ /, "", text); sub(/[.:] .*/, ".", text); print text}' \
            "examples/$name/README.md")"
    done
    printf './run example NAME runs one; its page is examples/NAME/README.md.\n'
}

# readAgents PLANT: fills names (of the agents), view (the path to show) and simulator.
readAgents() {
    local first rest
    [[ -f examples/$1/agents ]] ||
        die "there is no plant '$1' in examples/; './run example' lists them"
    while read -r first rest; do
        case $first in
            show) view=$rest ;;
            simulator) read -ra simulator <<<"$rest" ;;
            *) names+=("${first%.xml}") ;;
        esac
    done <"examples/$1/agents"
}

# Starts the simulator of the plant, which ends after the agents; fills address for them.
startSimulator() {
    local file=$folder/simulator.txt line
    "$bin/${simulator[0]}" "${simulator[@]:2}" >"$file" 2>&1 &
    simulatorPid=$!
    trap 'kill "$simulatorPid" 2>/dev/null || true' EXIT
    until [[ -s $file ]] || ! kill -0 "$simulatorPid" 2>/dev/null; do sleep 0.05; done
    read -r line <"$file" || true
    [[ $line == *" listening on "* ]] || die "no simulator: ${line:-it ended}"
    address=(--set "${simulator[1]}=${line##* }")
}

runPlant() {
    local plant=$1 seconds=20 secure="" names=() view=/ folder=build/examples/$1
    local simulator=() address=()
    local bin=build/release/bin name look="" pids ended="" window=""
    shift
    readAgents "$plant"
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
        makeKeys
        look=" CORTEX_SECURITY=$folder/station"
    fi
    say "$plant: ${names[*]} for $seconds s; to look in from another terminal, in this folder:
   export CORTEX_DOMAIN=$CORTEX_DOMAIN CORTEX_INTERFACE=lo$look PATH=\$PWD/$bin:\$PATH
   cortex list          # what there is${secure:+; without a folder of this authority, nobody is seen}
   cortex-explorer      # the same in a window
   what to try: examples/$plant/README.md"
    if ((${#simulator[@]})); then startSimulator; fi
    pids=()
    trap 'ended=signal' INT TERM HUP
    for name in "${names[@]}"; do
        "$bin/cortex-agent" "examples/$plant/$name.xml" --startup --interface lo \
            --files "$folder/files" \
            ${secure:+--security "$folder/$name"} --log "$folder/$name.log" "${address[@]}" "$@" \
            >"$folder/$name.txt" 2>&1 &
        pids+=($!)
    done
    "$bin/cortex" top --interface lo ${secure:+--security "$folder/station"} \
        --seconds "$seconds" <&0 &
    pids+=($!)
    if [[ ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]]; then
        "$bin/cortex-explorer" --interface lo ${secure:+--security "$folder/station"} "$view" \
            >"$folder/window.txt" 2>&1 &
        window=$!
    fi
    if [[ -z $ended ]]; then wait -n -p ended "${pids[@]}" || true; fi
    if [[ $window ]]; then kill "$window" 2>/dev/null || true; fi
    tellEnd "${ended:-signal}"
}

# An authority for this run, a folder for each agent and one for tools.
makeKeys() {
    local cortex=$PWD/$bin/cortex
    say "security on: keys and rights in $folder"
    (
        cd "$folder" && "$cortex" security create-authority &&
            for name in "${names[@]}" station; do
                "$cortex" security create-agent "$name" || exit
            done
    ) >"$folder/security.txt" 2>&1 || { cat "$folder/security.txt"; return 1; }
}

# Stops what runs and tells how it went. $1: what ended by itself, if anything. No agent may end by
# itself; `cortex top` may, unless it fails.
tellEnd() {
    local ended=$1 i status top=0 failed=() topPid=${pids[-1]}
    kill -TERM "${pids[@]}" 2>/dev/null || true
    wait "$topPid" || top=$?
    if [[ $ended == "$topPid" ]] && ((top != 0)); then
        failed+=("cortex top ended with exit code $top")
    fi
    for i in "${!names[@]}"; do
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

if (($#)); then runPlant "$@"; else list; fi
