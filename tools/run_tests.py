#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs tests with ctest and judges: `run_tests.py STAGE FOLDER CTEST-OPTION…`.

What fails is run again, alone, at most twice; what passes then is unsteady, and named. A test that is
labelled `exact` is not where it judged what came: only where something did not come in time, or the
limit of ctest ended it. Nothing is where a sanitizer has reported. A process holds many test cases,
so what is counted and named are those. Logs, and what the summary of
`./run test` tells, are in build/logs. Ends with 0 where nothing is red."""
import argparse
import datetime
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

MOST_UNSTEADY = 5  # that tests/unsteady.txt does not name
MOST_LINES = 10    # in tests/unsteady.txt
LONGEST_DAYS = 30  # that a line may stand there
ROOT = pathlib.Path(__file__).resolve().parent.parent
CASE = r"[^\s,:]+\.[^\s,:]+"
NOT_SHOWN = re.compile(r" *Start +\d+:|\[ (RUN     |      OK) \]")
IN_VAIN = re.compile(r"\bdid not come in \d+ s\b|\bis not heard\b")  # so say tests and tools
PASSED = re.compile(r" Passed +[0-9.]+ sec$")


# --- what ctest does --------------------------------------------------------------------------

def reports_environment(reports):
    """Sanitizers write their reports into files there, those of child processes too."""
    common = f'log_path="{reports}/report":log_exe_name=1:print_suppressions=0'
    symbolizer = shutil.which("llvm-symbolizer-19")
    if symbolizer:
        common += f":external_symbolizer_path={symbolizer}"
    own = {name: value for name, value in os.environ.items() if not name.startswith("GTEST_")}
    for name in ("ASAN_OPTIONS", "UBSAN_OPTIONS", "TSAN_OPTIONS", "LSAN_OPTIONS"):
        own[name] = ":".join(part for part in (own.get(name), common) if part)
    return own


def ctest(options, log, environment):
    """Its exit code. Shown is what a reader wants to see: every 100th test that passed."""
    passed = 0
    with open(log, "w", encoding="utf-8", errors="replace") as file, subprocess.Popen(
            ["ctest", *options], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            stdin=subprocess.DEVNULL, text=True, errors="replace", env=environment) as running:
        for line in running.stdout:
            file.write(line)
            passed += bool(PASSED.search(line))
            if sys.stdout.isatty() or not (NOT_SHOWN.match(line) or
                                           (PASSED.search(line) and passed % 100)):
                print(line, end="", flush=True)
    return running.returncode


def outputs(last_test):
    """What each process printed, by the name that ctest gives it; a repetition is added."""
    found, name = {}, None
    for line in read(last_test).splitlines():
        start = re.match(r"\d+/\d+ Testing: (.*)", line)
        if start:
            name = start[1]
            found.setdefault(name, [])
        elif name:
            found[name].append(line)
    return found


def failed_processes(folder):
    log = folder / "Testing/Temporary/LastTestsFailed.log"
    return [line.split(":", 1)[1] for line in read(log).splitlines() if ":" in line]


def timed_out(log):
    """The processes that the limit of ctest has ended."""
    return set(re.findall(r"Test +#\d+: (\S+) \.*\*\*\*Timeout", read(log)))


def read(path):
    return path.read_text(encoding="utf-8", errors="replace") if path.exists() else ""


# --- what a process tells of its cases --------------------------------------------------------

def failed_cases(lines):
    """Each case that failed, with what it printed; after a crash or a hang, that which had begun."""
    cases, begun, text = {}, None, []
    for line in lines:
        run = re.search(rf"\[ RUN      \] ({CASE})", line)
        end = re.search(rf"\[ +(OK|FAILED|SKIPPED) +\] ({CASE})", line)
        if run:
            begun, text = run[1], []
        elif end and end[2] == begun:
            if end[1] == "FAILED":
                cases[begun] = text
            begun = None
        elif begun:
            text.append(line)
        listed = re.fullmatch(rf"\[  FAILED  \] ({CASE})(, where .*)?", line)
        if listed:  # at the end, where no child prints any more
            cases.setdefault(listed[1], [])
    if begun:
        cases[begun] = text
    return cases


def is_failure(line):
    return line.endswith(": Failure")


def judged_what_came(lines):
    """False where the first failure of a case is that something did not come in time, or an agent
    was not heard."""
    begins = [number for number, line in enumerate(lines) if is_failure(line)]
    first = lines[begins[0]:(begins + [len(lines)])[1]] if begins else []
    return not any(map(IN_VAIN.search, first))


def untold(printed, failed):
    """What ctest holds for passed, although cases failed, or have not run."""
    found = []
    for name, lines in printed.items():
        text = "\n".join(lines)
        text = text[max(text.rfind("[==========] Running "), 0):]
        if name in failed or not text.startswith("[==========] Running "):
            continue
        if not re.search(r"\[={10}\] \d+ tests? from .* ran\.", text):
            found.append(f"{name} ended with 0 before all of its cases had run")
        elif " Running 0 tests" in text and "This is test shard" not in "\n".join(lines):
            found.append(f"{name} has run no case")
        found += [f"{case} failed, although {name} ended with 0"
                  for case in failed_cases(text.splitlines())]
    return found


def cases_that_failed(processes, printed):
    """Those of all these processes; of one that names none, the process itself."""
    return {process: failed_cases(printed.get(process, [])) or {process: printed.get(process, [])}
            for process in processes}


def first_words(lines):
    """The first three lines that say something."""
    dull = re.compile(r"Command:|Directory:|-{20}|Output:|<end of output>|\".*\" (start|end|time)|"
                      r"Test (time|Passed|Failed)|End testing|\d+/\d+ Test:")
    return [line.strip() for line in lines if line.strip() and not dull.match(line)][:3]


def passed_cases(lines):
    """How many passed at the last try; None for a program that has no cases."""
    counts = re.findall(r"^\[  PASSED  \] (\d+) test", "\n".join(lines), re.M)
    return int(counts[-1]) if counts else None


def skipped_cases(log, found):
    """'NAME: REASON' for each case and each process that did not run."""
    reasons = {}
    for name, lines in found.items():
        case = name
        for line, after in zip(lines, lines[1:] + [""]):
            run = re.search(rf"\[ RUN      \] ({CASE})", line)
            case = run[1] if run else case
            if line.endswith(": Skipped"):
                reasons[case] = after
            elif line.startswith("not run: "):
                reasons[case] = line[len("not run: "):]
    for name in re.findall(r"Test +#\d+: (\S+) \.*\*\*\*(?:Skipped|Not Run)", read(log)):
        reasons.setdefault(name, "did not run")
    return sorted(f"{name}: {reason}" for name, reason in reasons.items())


# --- what is known of the tests ---------------------------------------------------------------

def all_tests(folder):
    told = subprocess.run(["ctest", "--test-dir", folder, "--show-only=json-v1"],
                          stdout=subprocess.PIPE, check=True, text=True)
    return json.loads(told.stdout)["tests"]


def labels(test):
    return " ".join(word for each in test.get("properties", []) if each["name"] == "LABELS"
                    for word in each["value"])


def cases_of(test):
    """How many cases it runs; a filter that a list of names made is asked for them."""
    command = test.get("command", [])
    if len(command) != 2 or not command[1].startswith("--gtest_filter="):
        return 1
    told = subprocess.run([*command, "--gtest_list_tests"], stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, text=True, check=False)
    return sum(line.startswith("  ") for line in told.stdout.splitlines())


def outside(tests, ran):
    counts = []
    for label in ("long", "timed"):
        ours = [test for test in tests if re.search(rf"\b{label}\b", labels(test))
                and test["name"] not in ran]
        counts.append(f"{sum(map(cases_of, ours))} {label}")
    return " and ".join(counts)


def unsteady_list(path, date):
    """The names in tests/unsteady.txt, and what is wrong with it."""
    names, wrong = [], []
    for number, line in enumerate(read(path).splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        entry = re.fullmatch(r"(\S+) +(\d{4}-\d{2}-\d{2}) +\S.*", line)
        if not entry:
            wrong.append(f"{path.name}:{number}: not 'NAME YYYY-MM-DD what was seen'")
            continue
        names.append(entry[1])
        try:
            age = (date - datetime.date.fromisoformat(entry[2])).days
        except ValueError:
            wrong.append(f"{path.name}:{number}: {entry[2]} is no date")
            continue
        if age < min(0, (date - datetime.date.today()).days):
            wrong.append(f"{path.name}:{number}: {entry[1]}: {entry[2]} is yet to come")
        if age > LONGEST_DAYS:
            wrong.append(f"{path.name}:{number}: {entry[1]} stands there for {age} days, of at most "
                         f"{LONGEST_DAYS}: find its cause")
    if len(names) > MOST_LINES:
        wrong.append(f"{path.name} has {len(names)} lines, of at most {MOST_LINES}")
    return names, wrong


def commit_date():
    told = subprocess.run(["git", "log", "-1", "--format=%cs"], cwd=ROOT, stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, text=True, check=False)
    return datetime.date.fromisoformat(told.stdout.strip() or datetime.date.today().isoformat())


# --- the judgement ----------------------------------------------------------------------------

def sanitizer_reports(reports):
    """A line for each: the file, and what it is about."""
    found = []
    for path in sorted(reports.iterdir()):
        text = read(path)
        about = re.search(r"(ERROR|WARNING): \w+Sanitizer: .*|.*runtime error: .*", text)
        found.append(f"a sanitizer reports in {path}: "
                     f"{about[0] if about else text.strip().split(chr(10))[0]}")
    return found


class Verdict:
    """Of all runs: what is red, and why; cases that failed; those that passed alone, with what they
    printed first; how many passed; what each process printed first."""

    def __init__(self):
        self.red, self.failed, self.unsteady, self.passed, self.outputs = [], [], {}, 0, {}


def count_passed(printed, failed):
    """Of a program without cases, the one that it is."""
    counts = {name: passed_cases(lines) for name, lines in printed.items()}
    return sum(name not in failed if count is None else count for name, count in counts.items())


def exact_cases(exact, cases, log):
    """Those of these processes' cases that judged what came, and so are not tried again: all but one
    that waited in vain, or had begun and judged nothing when the limit of ctest ended its process."""
    ended = timed_out(log)
    return [case for process in cases if process in exact
            for number, (case, lines) in enumerate(reversed(cases[process].items()))
            if judged_what_came(lines) and
            not (number == 0 and process in ended and not any(map(is_failure, lines)))]


def judge(arguments, folder, logs, reports):
    stage, options = arguments.stage, arguments.options
    environment, verdict = reports_environment(reports), Verdict()
    last = folder / "Testing/Temporary/LastTest.log"
    for name in ("LastTest.log", "LastTestsFailed.log"):
        (last.parent / name).unlink(missing_ok=True)
    status = ctest(options, logs / f"ctest-{stage}.log", environment)
    (logs / f"ctest-{stage}-outputs.log").write_text(read(last))
    verdict.outputs = outputs(last)
    processes = failed_processes(folder)
    verdict.passed = count_passed(verdict.outputs, processes)
    cases = cases_that_failed(processes, verdict.outputs)
    verdict.red = sanitizer_reports(reports) + untold(verdict.outputs, processes)
    if status != 0 and not processes:
        verdict.red.append(f"ctest ended with {status}")
    exact = {test["name"] for test in all_tests(folder) if re.search(r"\bexact\b", labels(test))}
    verdict.red += [f"{case} is exact, so it is not run again"
                    for case in exact_cases(exact, cases, logs / f"ctest-{stage}.log")]
    if verdict.red or not processes:
        verdict.failed = [case for process in processes for case in cases[process]]
        return verdict
    print(f"\n== a second try of {len(processes)} processes, one at a time", flush=True)
    status = ctest([*options, "-j1", "--rerun-failed", "--repeat", "until-pass:2"],
                   logs / f"ctest-{stage}-again.log", environment)
    still, again = failed_processes(folder) if status else [], outputs(last)
    (logs / f"ctest-{stage}-again-outputs.log").write_text(read(last))
    verdict.passed = count_passed({**verdict.outputs, **again}, still)
    verdict.failed = [case for failed in cases_that_failed(still, again).values() for case in failed]
    if status and not still:
        verdict.red.append(f"ctest ended with {status} at the second try")
    later = {process: failed_cases(lines) for process, lines in again.items()}
    for of_process in (*cases.values(), *later.values()):
        for case, text in of_process.items():
            if case not in verdict.failed:
                verdict.unsteady.setdefault(case, text)
    verdict.red += [f"{case} failed each time" for case in verdict.failed]
    verdict.red += [f"{case} is exact, and failed at the second try" for case in
                    exact_cases(exact, later, logs / f"ctest-{stage}-again.log")
                    if case not in verdict.failed]
    verdict.red += sanitizer_reports(reports) + untold(again, still)
    return verdict


def parse():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--logs", type=pathlib.Path, default=ROOT / "build/logs")
    parser.add_argument("--unsteady", type=pathlib.Path, default=ROOT / "tests/unsteady.txt")
    parser.add_argument("--must-run", action="store_true", help="a test that is skipped is red")
    parser.add_argument("stage")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("options", nargs=argparse.REMAINDER)
    return parser.parse_args()


def main():
    arguments = parse()
    stage, folder, logs = arguments.stage, arguments.folder, arguments.logs.resolve()
    reports = logs / f"reports-{stage}"
    shutil.rmtree(reports, ignore_errors=True)
    reports.mkdir(parents=True)
    reports.chmod(0o1777)  # a child may have become another user
    known, wrong = unsteady_list(arguments.unsteady, commit_date())
    verdict = judge(arguments, folder, logs, reports)
    verdict.red += wrong
    new = [case for case in verdict.unsteady if case not in known]
    if len(new) > MOST_UNSTEADY:
        verdict.red.append(f"{len(new)} cases are unsteady and not in {arguments.unsteady.name}, of "
                           f"at most {MOST_UNSTEADY}")
    skipped = skipped_cases(logs / f"ctest-{stage}.log", verdict.outputs)
    if arguments.must_run and skipped:
        verdict.red.append(f"{len(skipped)} cases did not run")
    tell(logs, stage, verdict, known, skipped)
    with open(logs / f"{stage}.note", "a", encoding="utf-8") as note:
        note.write(f"{len(skipped)} skipped; {len(verdict.unsteady)} unsteady; {len(known)} known to "
                   f"be; {outside(all_tests(folder), verdict.outputs)} stand outside; ")
    return 1 if verdict.red else 0


def tell(logs, stage, verdict, known, skipped):
    """Writes what the summary of all stages shows."""
    unsteady = []
    for case, text in verdict.unsteady.items():
        of_list = " (in the list)" if case in known else ""
        unsteady += [f"{case}{of_list}: failed, then passed alone"]
        unsteady += [f"    {word}" for word in first_words(text)]
    for name, lines in (("skipped", skipped), ("unsteady", unsteady), ("red", verdict.red)):
        (logs / f"{stage}.{name}").write_text("".join(f"{line}\n" for line in lines))
    (logs / f"{stage}.closing").write_text(
        f"{stage}: {verdict.passed} passed, {len(verdict.failed)} failed, "
        f"{len(skipped)} skipped\n")
    for line in verdict.red:
        print(f"red: {line}")


if __name__ == "__main__":
    sys.exit(main())
