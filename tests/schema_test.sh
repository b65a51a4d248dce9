#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The schemas accept every shipped file and the valid samples, and refuse each invalid one.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
status=0 count=0

validates() {
    local root schema
    root=$(xmllint --xpath 'local-name(/*)' "$1")
    schema=ontology/$root.xsd
    [[ -f $schema ]] || schema=ontology/ontology.xsd  # no root element of ours
    xmllint --noout --schema "$schema" "$1" 2>"$messages"
}
messages=$(mktemp)
trap 'rm -f "$messages"' EXIT

for file in $(find ontology examples tests/data/schema/valid -name '*.xml' | sort); do
    validates "$file" || { echo "$file is refused:"; cat "$messages"; status=1; }
    count=$((count + 1))
done
for file in $(find tests/data/schema/invalid -name '*.xml' | sort); do
    if validates "$file"; then echo "$file is accepted"; status=1; fi
    count=$((count + 1))
done
echo "$count files"
exit "$status"
