#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The pictures of docs/explorer.md and of the examples' pages, `./run pictures [FOLDER]`: the window
# on a plant of examples/ on the loopback interface, in a domain of its own. No display is needed.
# They go to where the pages expect them, with a FOLDER to the same places below that.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bin=${BIN:-build/release/bin} folder=${1:-} pids=()
source tests/support/own_domain.sh
export CORTEX_DOMAIN=$ownDomain CORTEX_INTERFACE=lo

# folder of the page, name, size, then the options of the window
teleop=(
    "docs/pictures window 1280x800 /arm/lbr --theme light"
    "docs/pictures dark 1280x800 /arm/lbr --theme dark"
    "docs/pictures commands 1280x800 /playback --view commands"
    "docs/pictures system 1280x800 /tracking --view system"
    "docs/pictures agents 1280x800 /tracking --view agents"
    "docs/pictures events 1280x800 /tracking --view events"
    "docs/pictures small 800x600 /arm/lbr --font-scale 1.5"
)
jog=(
    "examples/jog_axis graph 1100x600 /jog --view system --theme light"
    "docs/pictures jog 1280x800 /jog --theme light"
)
drive=("docs/pictures drive 1280x800 /processor --theme light")
gantry=("examples/gantry graph 1500x900 /control --view system --theme light")

end() {
    ((${#pids[@]} == 0)) || kill "${pids[@]}" 2>/dev/null || true
    wait
    pids=()
}
trap end EXIT

# simulate PROGRAM ITEM OPTION…: starts a simulator; fills address for the agents.
simulate() {
    local file=build/pictures/simulator.txt line='' try
    : >"$file"
    "$bin/$1" "${@:3}" >"$file" 2>&1 &
    pids+=($!)
    for try in {1..200}; do
        read -r line <"$file" || true
        [[ $line == *" listening on "* ]] && break
        ((try < 200)) || { cat "$file"; exit 1; }
        sleep 0.05
    done
    address=(--set "$2=${line##* }")
}

# start PLANT ITEM…: its agents, until these items have come 15 times.
start() {
    local plant=$1 file simulator rest try address=()
    shift
    read -ra simulator <<<"$(sed -n 's/^simulator //p' "examples/$plant/agents")"
    ((${#simulator[@]} == 0)) || simulate "${simulator[@]}"
    while read -r file rest; do
        [[ $file == show || $file == simulator ]] && continue
        "$bin/cortex-agent" "examples/$plant/$file" --startup --frequency 200 "${address[@]}" \
            >"build/pictures/${file%.xml}.txt" 2>&1 &
        pids+=($!)
    done <"examples/$plant/agents"
    for try in {1..10}; do
        if "$bin/cortex" watch "$@" --count 15 >build/pictures/watch.txt 2>&1; then return; fi
        ((try < 10)) || { cat build/pictures/*.txt; exit 1; }
    done
}

take() {
    local each place name size options status=0
    for each in "$@"; do
        read -r place name size options <<<"$each"
        place=${folder:+$folder/}$place
        mkdir -p "$place"
        # shellcheck disable=SC2086
        "$bin/cortex-explorer" $options --size "$size" --timeout 60 \
            --screenshot "$place/$name.png" 2>"build/pictures/$name.txt" || status=$?
        if ((status)) || grep -q '^warning' "build/pictures/$name.txt"; then
            printf 'error: the picture %s: exit code %s\n' "$place/$name.png" "$status" >&2
            cat "build/pictures/$name.txt" >&2
            exit 1
        fi
        printf '%s: %s bytes\n' "$place/$name.png" "$(stat -c %s "$place/$name.png")"
    done
}

mkdir -p build/pictures
start lbr_teleop /tracking.time /playback.state
take "${teleop[@]}"
end
start jog_axis /jog.state /turntable/axis.position
take "${jog[@]}"
end
start ds402_dual_axis /processor.state /drive/a.position
take "${drive[@]}"
end
start gantry /control.state /hook.position
take "${gantry[@]}"
