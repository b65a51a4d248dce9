#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The profiler as users run it: results and report, what a stop leaves, comparison, a running agent.
# Its argument is the folder with the programs.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tests/support/own_domain.sh
bin=$(realpath "$1")
out=$(mktemp -d)
agent=0
cleanUp() {
    if ((agent != 0)); then kill "$agent" 2>/dev/null || true; fi
    rm -rf "$out"
}
trap cleanUp EXIT
export CORTEX_PATH=$PWD/ontology

fail() { cat "$out"/*.log >&2 || true; printf 'profiler: %s\n' "$*" >&2; exit 1; }
# COMMAND ends within two minutes with one of those exit codes; what it says is in NAME.log.
expect() {
    local codes=$1 name=$2 status=0
    shift 2
    timeout 120 "$bin/cortex-profiler" "$@" >"$out/$name.log" 2>&1 || status=$?
    [[ " $codes " == *" $status "* ]] || fail "$* ended with $status, not $codes"
}
says() { grep -q "$2" "$out/$1.log" || fail "$1 does not say: $2"; }

expect 2 unknown run acces
says unknown 'access'
expect '0 4' first run access --quick --out "$out/first"
says first 'Takes about'
says first 'report.html'
for file in report.html results.json summary.csv; do
    [[ -s $out/first/$file ]] || fail "no $file"
done
if grep -qE '(src|href)="?(https?:)?//' "$out/first/report.html"; then fail "it needs a network"; fi
# A limit that cannot be held is a missed aim, and the exit code says so.
python3 - "$out/first/results.json" <<'EOF'
import json, sys
results = json.load(open(sys.argv[1]))
for each in results["quantities"]: each["limit"] = 0
json.dump(results, open(sys.argv[1], "w"))
EOF
expect 0 missed report "$out/first"
says missed 'Missed:'
expect 1 again run access --quick --out "$out/first"
says again 'not empty'
cp "$out/first/report.html" "$out/report.before"
expect 0 report report "$out/first"
cmp "$out/first/report.html" "$out/report.before" || fail "the same results, another report"

# Stopped, it keeps what there is, and says so.
"$bin/cortex-profiler" run memory access --out "$out/stopped" >"$out/stopped.log" 2>&1 &
running=$!
for ((waited = 0; waited < 1200; ++waited)); do
    if grep -q 'memory over time' "$out/stopped.log"; then break; fi
    kill -0 "$running" 2>/dev/null || fail "it ended by itself"
    sleep 0.05
done
((waited < 1200)) || fail "nothing was measured within a minute"
kill -INT "$running"
status=0
wait "$running" || status=$?
((status == 1)) || fail "stopped, it ended with $status, not 1"
says stopped 'Stopped: not everything was measured'
expect 0 compare compare "$out/first" "$out/first"
says compare 'noise'

# An agent that runs, by the metrics that it has as data.
export CORTEX_DOMAIN=$ownDomain
"$bin/cortex-agent" examples/lbr_teleop/lbr_teleop.xml --interface lo --priority 0 \
    >"$out/agent.log" 2>&1 &
agent=$!
expect 0 attach attach teleop --interface lo --seconds 2 --timeout 30 --out "$out/attached"
for figure in duty jitter lateness task; do
    ls "$out/attached" | grep -qi "$figure" || fail "no figure of $figure: $(ls "$out/attached")"
done
expect 1 absent attach nobody --interface lo --timeout 0.5 --out "$out/absent"
says absent 'nobody'
echo 'the profiler runs, stops, compares and attaches'
