# SPDX-License-Identifier: Apache-2.0
# The stages of `./run test`, and the other commands that run tests or tools. Sourced by `./run`.
stages=(format tidy coverage tsan fuzz realtime package debian instructions profiler docs)

# --- what a stage reports ---------------------------------------------------------------------

minutes() { printf '%3d.%d' $(($1 / 60)) $(($1 % 60 / 6)); }
note() { printf '%s; ' "$*" >>"$logs/${stage:-test}.note"; }

# What a reader wants to see of ctest: all on a terminal, else every 100th test that passed.
ctestOutput() {
    if [[ -t 1 ]]; then cat; else
        awk '/^ *Start +[0-9]+:/ || /^\[ (RUN     |      OK) \]/ {next}
            / Passed +[0-9.]+ sec$/ && ++passed % 100 {next} {print}'
    fi
}

# runTests PRESET [ctest option…]: fails on a failure and, where CI=true, on a test that was skipped.
runTests() {
    local preset=$1 folder=build/$1 log=$logs/ctest-$1.log status=0
    [[ $preset == realtime ]] && folder=build/release
    shift
    prepareLocale
    say "testing $folder"
    ctest --preset "$preset" -j "$jobs" --no-tests=error "$@" 2>&1 | tee "$log" | ctestOutput ||
        status=$?
    countPassed "$log" "$folder/Testing/Temporary/LastTest.log" >>"$logs/${stage:-soak}.closing"
    tellSkipped "$log" "$folder/Testing/Temporary/LastTest.log" || status=$?
    return "$status"
}

# countPassed CTEST-LOG TEST-LOG: a process runs many tests, and says how many of them passed.
countPassed() {
    awk 'FILENAME == ARGV[1] && /^\[  PASSED  \]/ {tests += $4}
        / tests? failed out of / {failed = $4; all = $NF}
        END {printf "%d tests passed; %d of %d processes failed\n", tests, failed, all}' "$2" "$1"
}

# tellSkipped CTEST-LOG TEST-LOG: keeps the name and the reason of each test that did not run.
tellSkipped() {
    local list=$logs/${stage:-soak}.skipped count
    awk '/^[0-9]+\/[0-9]+ Testing: / {name = substr($0, index($0, "Testing: ") + 9)}
        /^\[ RUN      \] / {name = substr($0, 14)}
        /: Skipped$/ {if ((getline why) > 0) reason[name] = why}
        /^not run: / {reason[name] = substr($0, 10)}
        FILENAME == ARGV[2] && /\*\*\*(Skipped|Not Run)/ {
            sub(/^.*Test +#[0-9]+: /, ""); sub(/ *\.+ *\*\*\*.*$/, "")
            if (!($0 in reason)) reason[$0] = "did not run"
        }
        END {for (name in reason) printf "%s: %s\n", name, reason[name]}' "$2" "$1" |
        sort >"$list"
    count=$(wc -l <"$list")
    note "$count skipped"
    [[ ${CI:-} != true ]] || ((count == 0))
}

# A locale with a decimal comma: numbers must be read and written the same under it.
prepareLocale() {
    local folder=build/locales
    export LOCPATH=$PWD/$folder
    [[ -d $folder/de_DE.UTF-8 ]] && return
    mkdir -p "$folder"
    localedef -i de_DE -f UTF-8 "$folder/de_DE.UTF-8"
}

# --- the stages of `./run test` ---------------------------------------------------------------

stage_format() {
    say "checking the format of $(sources | wc -l) files, and their includes"
    sources | xargs clang-format-19 --dry-run -Werror
    if grep -rnE '(GCOVR?|LCOV)_EXCL' core cs; then die "no exclusion marks in core and cs"; fi
    python3 tools/rooms.py --self-test
    python3 tools/rooms.py
    python3 tools/documents.py --self-test
    python3 tools/documents.py
}

# Reads each file once; those that are compiled as one are read as one. The tests are not read.
stage_tidy() {
    local files=()
    mkdir -p "$logs"
    cmake --preset tidy >"$logs/configure-tidy.log" 2>&1 ||
        { cat "$logs/configure-tidy.log"; return 1; }
    mapfile -t files < <(sed -n 's/^ *"file": "\(.*\)",\?$/\1/p' build/tidy/compile_commands.json |
        grep -v -e _verify_interface_header_sets/ -e _autogen/)
    say "clang-tidy of ${#files[@]} files"
    printf '%s\n' "${files[@]}" |
        xargs -n 1 -P "$jobs" clang-tidy-19 --quiet -p build/tidy 2>"$logs/tidy.log" ||
        { grep -v ' warnings\? generated' "$logs/tidy.log"; return 1; }
    note "${#files[@]} files"
}

stage_coverage() {
    find build/coverage -name '*.gcda' -delete 2>/dev/null || true
    build coverage
    runTests coverage
    measureCoverage
}

measureCoverage() {
    local status=0
    say "counting covered lines of libraries and programs"
    gcovr --gcov-executable "llvm-cov-19 gcov" --filter core/ --filter cs/ --filter comms/ \
        --filter mechanics/ --filter toolkit/ --filter explorer/ --exclude ".*_autogen.*" \
        -j "$jobs" --json build/coverage/coverage.json build/coverage >"$logs/gcovr.log" 2>&1 ||
        { cat "$logs/gcovr.log"; return 1; }
    requireCoverage 90 core cs || status=$?
    requireCoverage 85 comms || status=$?
    requireCoverage 85 mechanics || status=$?
    requireCoverage 85 toolkit/src toolkit/include || status=$?
    requireCoverage 80 toolkit/agent || status=$?
    requireCoverage 80 explorer/cli || status=$?
    requireCoverage 80 explorer/gui || status=$?
    return "$status"
}

# requireCoverage PERCENT folder…: at least so many of the folders' lines are covered.
requireCoverage() {
    local percent=$1 filters=() status=0 folder
    shift
    say "coverage of $* (at least $percent % of the lines)"
    for folder in "$@"; do filters+=(--filter "$folder/"); done
    gcovr --add-tracefile build/coverage/coverage.json "${filters[@]}" --txt \
        --print-summary --fail-under-line "$percent" | tee "$logs/coverage-${1##*/}.txt" || status=$?
    note "$*: $(awk '/^lines:/ {print $2}' "$logs/coverage-${1##*/}.txt") of the lines"
    return "$status"
}

# Each fuzz target for a while, one per core; shipped files and committed seeds to begin with.
stage_fuzz() {
    build coverage -- fuzz-targets
    local seconds=${FUZZ_SECONDS:-30} targets=(build/coverage/bin/fuzz-*) name
    say "fuzzing ${#targets[@]} targets for $seconds s each"
    for name in "${targets[@]##*/}"; do
        mkdir -p "build/fuzz/corpus/$name"
        echo "$name"
    done | xargs -P "$jobs" -I{} bash -c '
        build/coverage/bin/{} -max_total_time='"$seconds"' -timeout=10 -rss_limit_mb=4096 \
            -max_len=16384 -dict=tests/fuzz/cortex.dict \
            -artifact_prefix=build/fuzz/{}- build/fuzz/corpus/{} \
            tests/fuzz/seeds/{} >build/logs/{}.log 2>&1 ||
            { tail -40 build/logs/{}.log; exit 1; }'
    note "${#targets[@]} fuzz targets × $seconds s"
}

stage_tsan() {
    build tsan -- tests-concurrent
    runTests tsan
}

# The build of the stages that look at what users get, with the tests that need an optimised one. It
# compiles each file by itself, so that a missing include is found.
buildRelease() {
    build release -DCORTEX_BENCH=ON -DCORTEX_TESTS=ON -- all all_verify_interface_header_sets \
        tests-realtime
}

# Tests that no sanitizer may slow down or hide the allocator from.
stage_realtime() {
    buildRelease
    runTests realtime
}

stage_package() {
    local prefix=$PWD/build/package
    buildRelease
    say "installing to build/package, building the examples against it outside of the tree"
    rm -rf "$prefix"
    cmake --install build/release --prefix "$prefix" >"$logs/install.log"
    bash tests/package_test.sh "$prefix"
}

# The Debian packages; where we are root, installed into a bare root, started and removed.
stage_debian() {
    buildRelease
    makePackages
    if ((EUID)); then note "not installed: that needs root"; return; fi
    say "installing into a bare root"
    bash tests/debian_test.sh build/debian build/debian
}

makePackages() {
    say "making Debian packages in build/debian"
    rm -rf build/debian
    (cd build/release && cpack -B ../debian) >"$logs/cpack.log" 2>&1 ||
        { cat "$logs/cpack.log"; return 1; }
    rm -rf build/debian/_CPack_Packages
    lintian --allow-root --fail-on error build/debian/*.deb
    ls build/debian/*.deb
}

# What the hot paths cost, in instructions under callgrind, beside instructions/baseline.txt.
stage_instructions() {
    local log=$logs/instructions.log status=0
    buildRelease
    say "counting instructions"
    countInstructions check | tee "$log" || status=$?
    note "$(grep -cE ' GREW ' "$log" || true) costs grew by more than 5 %"
    return "$status"
}

countInstructions() {
    /usr/bin/python3 profiler/instructions/instructions.py "$1" build/release \
        profiler/instructions/baseline.txt
}

stage_profiler() {
    buildRelease
    say "the profiler as users run it"
    bash tests/profiler_test.sh build/release/bin
}

stage_docs() {
    [[ -d build/package ]] || stage_package
    say "taking the pictures of docs/explorer.md"
    build release -- cortex-agent cortex-cli cortex-explorer
    tools/pictures.sh build/pictures
    say "cutting the tutorials out of docs/, building and running them"
    /usr/bin/python3 tests/docs/tutorials.py docs build/tutorials build/package
    if [[ -f docs/Doxyfile ]]; then reference; fi
}

# --- commands ---------------------------------------------------------------------------------

# Every stage in its own shell, so that one that fails does not hide what the others find.
command_test() {
    local name begin failed=0 result table="" closing="" skipped=""
    (($#)) || set -- "${stages[@]}"
    mkdir -p "$logs"
    for name in "$@"; do
        [[ " ${stages[*]} " == *" $name "* ]] ||
            die "no stage '$name'; there are: ${stages[*]}"
    done
    ensure "${testPackages[@]}"
    for name in "$@"; do
        rm -f "$logs/$name".{note,closing,skipped}
        say "stage $name"
        begin=$SECONDS
        result=ok
        bash ./run stage "$name" || { result=FAILED; failed=1; }
        table+=$(printf '%-12s %s min  %-6s  %s' "$name" "$(minutes $((SECONDS - begin)))" \
            "$result" "$(cat "$logs/$name.note" 2>/dev/null)")$'\n'
        skipped+=$(sed "s/^/  ($name) /" "$logs/$name.skipped" 2>/dev/null || true)
        [[ -z $skipped || $skipped == *$'\n' ]] || skipped+=$'\n'
        if [[ -s $logs/$name.closing ]]; then
            closing+=$(<"$logs/$name.closing")"   ($name)"$'\n'
        fi
    done
    say "summary"
    printf '%s' "$table"
    if [[ $skipped ]]; then printf 'what did not run, and why:\n%s' "$skipped"; fi
    printf '%-12s %s min on %s cores\n%s' total "$(minutes "$SECONDS")" "$jobs" "$closing"
    return "$failed"
}

command_stage() {
    export stage=$1
    "stage_$stage"
}

command_package() {
    ensure "${packagePackages[@]}"
    build release
    makePackages
    say "install with: sudo apt-get install ./build/debian/*.deb"
}

command_baseline() {
    ensure "${benchPackages[@]}" python3 valgrind
    build release -DCORTEX_BENCH=ON -- cortex-hot-paths
    say "counting instructions"
    countInstructions write
    git --no-pager diff --stat -- profiler/instructions/baseline.txt || true
}

command_soak() {
    ensure "${testPackages[@]}"
    build soak -- tests-soak
    runTests soak
}

command_coverage() {
    command_test coverage
    gcovr --add-tracefile build/coverage/coverage.json --html-details \
        build/coverage/report/index.html 2>/dev/null || die "the report could not be written"
    say "see build/coverage/report/index.html"
}

command_pictures() {
    ensure "${buildPackages[@]}"
    build release -- cortex-agent cortex-cli cortex-explorer
    say "taking the pictures of docs/explorer.md"
    tools/pictures.sh "$@"
}

command_reference() {
    ensure doxygen
    reference
    say "see build/reference/html/index.html"
}

# Whether warnings are errors is said in docs/Doxyfile too; here they are in any case.
reference() {
    [[ -f docs/Doxyfile ]] || die "docs/Doxyfile is missing"
    say "the reference of the installed headers"
    mkdir -p build/reference
    { cat docs/Doxyfile; echo 'WARN_AS_ERROR = FAIL_ON_WARNINGS'; } | doxygen - >"$logs/doxygen.log"
}

command_quick() {
    source tools/quick.sh
    quick "$@"
}
