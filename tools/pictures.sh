#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The pictures of docs/explorer.md, `./run pictures [FOLDER]`: the window on the tele-operated arm,
# two agents on the loopback interface in a domain of their own. No display is needed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bin=${BIN:-build/release/bin} folder=${1:-docs/pictures} pids=()
export CORTEX_DOMAIN=${CORTEX_DOMAIN:-43} CORTEX_INTERFACE=lo

# name, size, then the options of the window
pictures=(
    "window 1280x800 /arm/lbr --theme light"
    "dark 1280x800 /arm/lbr --theme dark"
    "commands 1280x800 /playback --view commands"
    "system 1280x800 /tracking --view system"
    "agents 1280x800 /tracking --view agents"
    "events 1280x800 /tracking --view events"
    "small 800x600 /arm/lbr --font-scale 1.5"
)

end() { ((${#pids[@]})) && kill "${pids[@]}" 2>/dev/null; wait; }
trap end EXIT

mkdir -p "$folder" build/pictures
for name in robot operator; do
    "$bin/cortex-agent" "examples/lbr_teleop/$name.xml" --startup --frequency 200 \
        >"build/pictures/$name.txt" 2>&1 &
    pids+=($!)
done
for try in {1..10}; do
    if "$bin/cortex" watch /tracking.time /playback.state --count 15 >build/pictures/watch.txt 2>&1
    then break; fi
    ((try < 10)) || { cat build/pictures/*.txt; exit 1; }
done
for each in "${pictures[@]}"; do
    read -r name size options <<<"$each"
    # shellcheck disable=SC2086
    "$bin/cortex-explorer" $options --size "$size" --timeout 60 --screenshot "$folder/$name.png" \
        2>"build/pictures/$name.txt"
    if grep -H '^warning' "build/pictures/$name.txt"; then exit 1; fi
    printf '%s: %s bytes\n' "$folder/$name.png" "$(stat -c %s "$folder/$name.png")"
done
