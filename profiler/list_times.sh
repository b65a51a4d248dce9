#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# How long `cortex list` takes from its start to its end, and whether it is right each time.
#   profiler/list_times.sh [--build FOLDER] [--count N] [SYSTEM.xml…]
# Starts an agent for each system file in a domain of its own (the case study's if none is given),
# lists N times (100) and prints milliseconds. Exit code 1 if an answer was wrong.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build=build/release
count=100
systems=()
while (($#)); do
    case $1 in
        --build) build=$2; shift 2 ;;
        --count) count=$2; shift 2 ;;
        -*) sed -n '3,6s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2 ;;
        *) systems+=("$1"); shift ;;
    esac
done
((${#systems[@]})) || systems=(examples/lbr_teleop/{operator,robot}.xml)

export CORTEX_PATH=${CORTEX_PATH:-ontology}
export CORTEX_DOMAIN=$((1 + $$ % 99))
agents=()
trap '((${#agents[@]} == 0)) || kill "${agents[@]}" 2>/dev/null || true' EXIT
for system in "${systems[@]}"; do
    "$build/bin/cortex-agent" --startup "$system" >/dev/null 2>&1 &
    agents+=($!)
done

# Path, type, role and agent of each simplex; its state may change, but it is never unknown.
list() { "$build/bin/cortex" list | awk '$NF == "lost" { exit 3 } { print $1, $2, $3, $4 }'; }
whole() { [[ $("$build/bin/cortex" agents --json | grep -c '"running"') == "${#systems[@]}" ]]; }
for ((i = 0; i < 100; ++i)); do ! whole || break; done
whole || { echo "not all of ${systems[*]} run: see what cortex-agent says" >&2; exit 1; }
right=$(list)

times=()
wrong=0
for ((i = 0; i < count; ++i)); do
    start=${EPOCHREALTIME/./}
    answer=$(list) || answer="exit code $?"
    times+=($(((${EPOCHREALTIME/./} - start) / 1000)))
    [[ $answer == "$right" ]] || wrong=$((wrong + 1))
done

mapfile -t sorted < <(printf '%s\n' "${times[@]}" | sort -n)
echo "${#systems[@]} agents, $(wc -l <<<"$right") simplexes, $count starts of cortex list, load$(
    cut -d' ' -f1 /proc/loadavg | sed 's/^/ /')"
echo "median ${sorted[count / 2]} ms, 95 of 100 within ${sorted[(count * 95 + 99) / 100 - 1]} ms," \
    "worst ${sorted[count - 1]} ms, wrong $wrong"
((wrong == 0))
