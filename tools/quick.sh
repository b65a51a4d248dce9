# SPDX-License-Identifier: Apache-2.0
# `./run quick [FOLDER…]`, sourced by tools/stages.sh: what a person runs before a commit.

# Files that differ from the branch main, committed or not.
changedFiles() {
    local base
    base=$(git merge-base HEAD main 2>/dev/null || git merge-base HEAD origin/main 2>/dev/null ||
        echo HEAD)
    { git diff --name-only --diff-filter=d "$base"; git ls-files --others --exclude-standard; } |
        sort -u
}

# The folders whose tests look at the files that are named.
foldersOf() {
    sed -nE 's#^tests/(cli|docs|gui|data/schema)/.*#explorer#; s#^tests/determinism/.*#cs#
        s#^tests/(support|data|plugins)/.*#core\ncs\ncomms#; s#^tests/([a-z]+)/.*#\1#
        s#^ontology/.*#core#; s#^([a-z]+)/.*#\1#; p' | sort -u |
        grep -xE 'core|cs|comms|mechanics|drives|toolkit|modbus|physics|profiler|explorer' || true
}

# Rewrites those of the named files that are not formatted.
formatFiles() {
    local file
    for file in "$@"; do
        [[ $file == *.?pp ]] || continue
        clang-format-19 --dry-run -Werror "$file" 2>/dev/null && continue
        clang-format-19 -i "$file"
        echo "formatted anew: $file"
    done
}

quick() {
    local changed=() folders=() folder
    ensure "${quickPackages[@]}"
    mapfile -t changed < <(changedFiles)
    mapfile -t folders < <(
        if (($#)); then printf '%s/\n' "${@%/}"; else printf '%s\n' "${changed[@]}"; fi | foldersOf)
    if (($#)) && ((${#folders[@]} == 0)); then die "no tests of: $*"; fi
    say "format of ${#changed[@]} changed files, and the includes of all"
    formatFiles "${changed[@]}"
    python3 tools/rooms.py
    if ((${#folders[@]})); then
        build gate -- "${folders[@]/#/tests-of-}"
        prepareLocale
        say "testing ${folders[*]}"
        ctest --preset gate -j "$jobs" --no-tests=error \
            -L "^(unit|concurrent)-($(IFS='|'; echo "${folders[*]}"))(-|$)" 2>&1 | ctestOutput
    fi
    say "left out: tests of other folders than: ${folders[*]:-none}; tests of programs and networks,
   and the product (./run test); what judges time or takes minutes, tidy, docs … (./run test all)"
}
