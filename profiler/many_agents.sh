#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# How long many agents on one host, started at once, take to hear each other.
#   profiler/many_agents.sh [--build FOLDER] [--seconds S] [COUNT]
# Starts COUNT (50) agents of 20 simplexes at 100 Hz in a domain of its own. Prints when the last of
# them had heard all others, and how long `cortex list` then takes to have all of all. Exit code 1 if
# that did not come true within S seconds (60).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build=build/release
seconds=60
while [[ ${1:-} == --* ]]; do
    case $1 in
        --build) build=$2 ;;
        --seconds) seconds=$2 ;;
        *) sed -n '3,7s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2 ;;
    esac
    shift 2
done
count=${1:-50}

folder=$(mktemp -d)
agents=()
end() {
    ((${#agents[@]} == 0)) || kill "${agents[@]}" 2>/dev/null || true
    wait
    rm -r "$folder"
}
trap end EXIT
export CORTEX_PATH=${CORTEX_PATH:-$PWD/ontology}
export CORTEX_DOMAIN=$((1 + $$ % 99))
for ((i = 1; i <= count; ++i)); do
    {
        echo "<system name=\"a$i\"><morphology file=\"robotics-morphology.xml\"/>"
        echo "<cluster name=\"a$i\" frequency=\"100\" threads=\"1\"/>"
        for ((k = 1; k < 20; ++k)); do  # the 20th is the cluster
            echo "<simplex path=\"/plant$i/button/$k\" type=\"DigitalIoConcept\"/>"
        done
        echo "</system>"
    } >"$folder/$i.xml"
done

start=${EPOCHREALTIME/./}
since() { echo $(((${EPOCHREALTIME/./} - start) / 1000)); }
for ((i = 1; i <= count; ++i)); do
    "$build/bin/cortex-agent" --log "$folder/$i.log" "$folder/$i.xml" >/dev/null 2>&1 &
    agents+=($!)
done
launched=$(since)

heard() { cat "$folder"/*.log 2>/dev/null | grep -c ' is heard, from ' || true; }
while (($(since) < seconds * 1000)); do
    (($(heard) < count * (count - 1))) || break
    sleep 0.1
done
pairs=$(heard)
heardAt=$(since)
lines=$("$build/bin/cortex" list --timeout "$seconds" | wc -l) || true
whole=$(since)
lost=$(cat "$folder"/*.log | grep -c ' is lost' || true)

echo "$count agents, load$(cut -d' ' -f1 /proc/loadavg | sed 's/^/ /'): launched within $launched ms"
echo "$pairs of $((count * (count - 1))) pairs heard each other, $heardAt ms after the first start; lost since: $lost"
echo "a list of $lines of $((count * 20)) simplexes was there $((whole - heardAt)) ms later"
((pairs >= count * (count - 1) && lines == count * 20))
