# SPDX-License-Identifier: Apache-2.0
# The stages of `./run test`, and the other commands that run tests or tools. Sourced by `./run`.
gateStages=(format checks product)
otherStages=(tidy coverage tsan long timed fuzz realtime package debian instructions profiler docs)

# --- what a stage reports ---------------------------------------------------------------------

minutes() { printf '%3d.%d' $(($1 / 60)) $(($1 % 60 / 6)); }
note() { printf '%s; ' "$*" >>"$logs/${stage:-test}.note"; }

# What an interactive ctest prints, or every 100th test that passed.
ctestOutput() {
    if [[ -t 1 ]]; then cat; else
        awk '/^ *Start +[0-9]+:/ || /^\[ (RUN     |      OK) \]/ {next}
            / Passed +[0-9.]+ sec$/ && ++passed % 100 {next} {print}'
    fi
}

# runTests PRESET FOLDER [ctest option…]: judged by tools/run_tests.py.
runTests() {
    local preset=$1 folder=$2
    shift 2
    prepareLocale
    say "testing $folder"
    python3 tools/run_tests.py ${CORTEX_NOTHING_SKIPPED:+--must-run} "${stage:-soak}" "$folder" \
        --preset "$preset" -j "$jobs" --no-tests=error "$@"
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

# Every test but those that judge time, and those that need minutes.
stage_checks() {
    build gate
    runTests gate build/gate
}

# What users get: the programs and their manual, installed; a program of one's own; the demo.
stage_product() {
    local prefix=$PWD/build/product/installed example=$PWD/build/product/e01_two_simplexes
    buildPrograms cortex-man
    say "installing to build/product, building an example against it"
    rm -rf build/product
    cmake --install build/release --prefix "$prefix" >"$logs/install.log"
    cmake -S examples/e01_two_simplexes -B "$example" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" \
        >"$logs/configure-e01.log"
    cmake --build "$example"
    source tests/support/own_domain.sh
    export CORTEX_DOMAIN=$ownDomain CORTEX_INTERFACE=lo
    twice "$example/e01_two_simplexes" >/dev/null
    twice tools/example.sh lbr_teleop --seconds 5
}

# Runs a program; where it fails once more, the stage fails. What passed then is named as unsteady.
twice() {
    "$@" && return
    say "a second try of $*" >&2
    "$@" || return
    echo "$*: failed, then passed" >>"$logs/$stage.unsteady"
}

# What the gate leaves out because it takes minutes; in the gate's build.
stage_long() {
    build gate
    runTests long build/gate
}

# What judges time, each alone, in the build that users get.
stage_timed() {
    buildRelease
    runTests timed build/release -j 1
}

stage_coverage() {
    find build/coverage -name '*.gcda' -delete 2>/dev/null || true
    build coverage
    runTests coverage build/coverage
    measureCoverage
}

measureCoverage() {
    local status=0
    say "counting covered lines of libraries and programs"
    gcovr --gcov-executable "llvm-cov-19 gcov" --filter core/ --filter cs/ --filter comms/ \
        --filter mechanics/ --filter drives/ --filter modbus/ --filter physics/ \
        --filter toolkit/ --filter explorer/ --exclude ".*_autogen.*" \
        -j "$jobs" --json build/coverage/coverage.json build/coverage >"$logs/gcovr.log" 2>&1 ||
        { cat "$logs/gcovr.log"; return 1; }
    requireCoverage 90 core cs || status=$?
    requireCoverage 85 comms || status=$?
    requireCoverage 85 mechanics || status=$?
    requireCoverage 85 drives || status=$?
    requireCoverage 85 modbus/src modbus/drive modbus/gripper modbus/gripper_sim modbus/sim || status=$?
    requireCoverage 85 physics/src || status=$?
    requireCoverage 85 toolkit/src toolkit/include || status=$?
    requireCoverage 80 toolkit/agent || status=$?
    requireCoverage 80 explorer/cli || status=$?
    requireCoverage 80 explorer/common || status=$?
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
    runTests tsan build/tsan
}

# The build of the stages that look at what users get, with all tests. It compiles each file by
# itself, so that a missing include is found.
buildRelease() {
    build release -DCORTEX_BENCH=ON -DCORTEX_TESTS=ON -- all all_verify_interface_header_sets \
        tests-unit tests-concurrent tests-integration tests-realtime
}

# Tests that no sanitizer may slow down or hide the allocator from.
stage_realtime() {
    buildRelease
    runTests realtime build/release
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
    buildPrograms
    tools/pictures.sh build/pictures
    say "cutting the tutorials out of docs/, building and running them"
    /usr/bin/python3 tests/docs/tutorials.py docs build/tutorials build/package
    if [[ -f docs/Doxyfile ]]; then reference; fi
}

# --- commands ---------------------------------------------------------------------------------

# The gate, all stages, or those that are named; each in a shell of its own, so that one that fails
# does not hide what the others find. build/logs/passed holds the id of the tree that the gate passed.
command_test() {
    local name begin failed=() result table="" tree
    (($#)) || set -- "${gateStages[@]}"
    if [[ $* == all ]]; then
        set -- "${gateStages[@]}" "${otherStages[@]}"
        [[ ${CI:-} != true ]] || export CORTEX_NOTHING_SKIPPED=yes
    fi
    mkdir -p "$logs"
    rm -f "$logs/passed"
    tree=$(cleanTree)
    for name in "$@"; do
        [[ " ${gateStages[*]} ${otherStages[*]} " == *" $name "* ]] ||
            die "no stage '$name'; there are: ${gateStages[*]} (the gate), ${otherStages[*]}; all"
    done
    for name in "$@"; do
        rm -f "$logs/$name".{note,closing,skipped,unsteady,red}
        ensurePackagesOf "$name"
        say "stage $name"
        begin=$SECONDS
        result=ok
        bash ./run stage "$name" || { result=FAILED; failed+=("$name"); }
        table+=$(printf '%-12s %s min  %-6s  %s' "$name" "$(minutes $((SECONDS - begin)))" \
            "$result" "$(cat "$logs/$name.note" 2>/dev/null)")$'\n'
    done
    say "summary"
    printf '%s' "$table"
    tellOf skipped 'what did not run, and why' "$@"
    tellOf unsteady 'unsteady' "$@"
    tellOf red 'red' "$@"
    printf '%-12s %s min on %s cores\n' total "$(minutes "$SECONDS")" "$jobs"
    for name in "$@"; do cat "$logs/$name.closing" 2>/dev/null || true; done
    if [[ " $* " == *" ${gateStages[*]} "* && " ${failed[*]} " != *\ @(format|checks|product)\ * ]]; then
        [[ -z $tree || $tree != "$(cleanTree)" ]] || echo "$tree" >"$logs/passed"
    fi
    ((${#failed[@]} == 0))
}

# The id of the tree, if nothing stands in the folder that is not committed.
cleanTree() {
    [[ $(git status --porcelain --untracked-files=normal 2>&1) ]] || git rev-parse 'HEAD^{tree}'
}

# tellOf KIND TITLE STAGE…: what these stages have written of that kind.
tellOf() {
    local kind=$1 title=$2 name lines=""
    shift 2
    for name in "$@"; do lines+=$(sed "s/^/  ($name) /" "$logs/$name.$kind" 2>/dev/null || true); done
    [[ -z $lines ]] || printf '%s:\n%s\n' "$title" "$lines"
}

ensurePackagesOf() {
    case $1 in
        format) ensure "${formatPackages[@]}" ;;
        checks | long) ensure "${checksPackages[@]}" ;;
        product) ensure "${productPackages[@]}" ;;
        *) ensure "${testPackages[@]}" ;;
    esac
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
    runTests soak build/soak
}

command_coverage() {
    command_test coverage
    gcovr --add-tracefile build/coverage/coverage.json --html-details \
        build/coverage/report/index.html 2>/dev/null || die "the report could not be written"
    say "see build/coverage/report/index.html"
}

command_pictures() {
    ensure "${buildPackages[@]}"
    buildPrograms
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
