#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# How long many agents on one host, started at once, take to have each other.
#   profiler/many_agents.sh [--build FOLDER] [--seconds S] [--rounds N] [--server] [--links L] [COUNT]
# Starts COUNT (50) agents of 20 simplexes at 10 Hz in a domain of its own. Prints when the last of
# them had heard all others, and when `cortex list` then had all of all. N times (1); --server: with a
# Discovery Server (fast-discovery-server, of Debian's fastdds-tools); --links: each with a
# simplex of each of the next L linked, for which it takes the types and structures of all, and the
# time is that when every link is bound and every agent has said that it knows every other. Exit
# code 1 if that did not come true within S seconds (60) each time.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build=build/release
seconds=60
rounds=1
server=
links=0
while [[ ${1:-} == --* ]]; do
    case $1 in
        --build) build=$2; shift ;;
        --seconds) seconds=$2; shift ;;
        --rounds) rounds=$2; shift ;;
        --server) server=127.0.0.1:$((20000 + $$ % 10000)) ;;
        --links) links=$2; shift ;;
        *) sed -n '3,10s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2 ;;
    esac
    shift
done
count=${1:-50}

folder=$(mktemp -d)
processes=()
endAll() {
    ((${#processes[@]} == 0)) || kill "${processes[@]}" 2>/dev/null || true
    wait
    processes=()
    rm -f "$folder"/*.log
}
trap 'endAll; rm -r "$folder"' EXIT
export CORTEX_PATH=${CORTEX_PATH:-$PWD/ontology}
buttons=19 sign=' is heard, from '  # the 20th simplex is the cluster
((links == 0)) || buttons=17 sign='linked to agent '  # and a handset with its pose
pairs=$((count * (links > 0 ? links : count - 1)))
models=$((links > 0 ? count * (count - 1) : 0))
for ((i = 1; i <= count; ++i)); do
    {
        echo "<system name=\"a$i\"><morphology file=\"robotics-morphology.xml\"/>"
        echo "<cluster name=\"a$i\" frequency=\"10\" threads=\"1\"/>"
        for ((k = 1; k <= buttons; ++k)); do
            echo "<simplex path=\"/plant$i/button/$k\" type=\"DigitalIoConcept\"/>"
        done
        if ((links > 0)); then
            echo "<simplex path=\"/plant$i/hand\" type=\"HtcViveHandset\">"
            for ((k = 0; k < links; ++k)); do
                to=/plant$(((i + k) % count + 1))/button/1
                echo "<relate rule=\"buttons\" to=\"$to\" remote=\"true\"/>"
            done
            echo "</simplex>"
        fi
        echo "</system>"
    } >"$folder/$i.xml"
done

since() { echo $(((${EPOCHREALTIME/./} - start) / 1000)); }
said() { cat "$folder"/*.log 2>/dev/null | grep -c "$1" || true; }

# One round; $1: its number.
startTogether() {
    local found known foundAt lines wholeAt lost
    export CORTEX_DOMAIN=$((1 + ($$ + $1) % 99))
    if [[ $server ]]; then
        export CORTEX_DISCOVERY_SERVER=$server
        fast-discovery-server -i 0 -l 127.0.0.1 -p "${server#*:}" >/dev/null 2>&1 &
        processes+=($!)
    fi
    start=${EPOCHREALTIME/./}
    for ((i = 1; i <= count; ++i)); do
        "$build/bin/cortex-agent" --log "$folder/$i.log" "$folder/$i.xml" >/dev/null 2>&1 &
        processes+=($!)
    done
    while (($(since) < seconds * 1000)); do
        found=$(said "$sign") known=$(said ' is known: ')
        ((links > 0)) || found=$((found - $(said ' is lost: ')))  # and not heard again
        ((found < pairs || known < models)) || break
        sleep 0.3
    done
    foundAt=$(since)
    lines=$("$build/bin/cortex" list --timeout "$seconds" | wc -l) || true
    wholeAt=$(since)
    lost=$(cat "$folder"/*.log | grep -c ' is lost' || true)
    endAll
    echo "$count agents, $links links each${server:+, with a server}: $found of $pairs" \
        "$( ((links > 0)) && echo "links bound, $known of $models models known" ||
            echo pairs heard each other) after $foundAt ms" \
        "(lost again: $lost)," \
        "$lines of $((count * 20)) simplexes listed after $wholeAt ms"
    ((found >= pairs && known >= models && lines == count * 20))
}

echo "load before: $(cut -d' ' -f1-3 /proc/loadavg)"
failed=0
for ((round = 1; round <= rounds; ++round)); do
    startTogether "$round" || failed=1
done
exit "$failed"
