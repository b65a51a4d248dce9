#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What tools/run_tests.py makes of tests that fail once, twice or always, hang, crash, or start a
program that a sanitizer stops. The argument is a compiler that knows AddressSanitizer."""
import datetime
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
COMPILER = sys.argv.pop(1)
TODAY = datetime.date.today()

# CASE TIMES: prints as GoogleTest does, and fails at the first TIMES starts.
FAILS = """#!/bin/sh
case=$1
echo "[ RUN      ] $case"
count=$(cat "$case" 2>/dev/null || echo 0)
echo $((count + 1)) >"$case"
[ "$count" -ge "$2" ] && { echo "[       OK ] $case (0 ms)"; echo "[  PASSED  ] 1 test."; exit 0; }
echo "what $case saw"
echo "[  FAILED  ] $case (0 ms)"
exit 1
"""


class RunTests(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = pathlib.Path(kept.name)
        self.program("fails", FAILS)
        self.tests = []

    def program(self, name, text):
        path = self.folder / name
        path.write_text(text)
        path.chmod(0o755)
        return path

    def add(self, name, *command, label="unit", timeout=60):
        self.tests += [f'add_test([=[{name}]=] {" ".join(f"[=[{word}]=]" for word in command)})',
                       f'set_tests_properties([=[{name}]=] PROPERTIES LABELS "{label}" '
                       f'TIMEOUT {timeout} WORKING_DIRECTORY "{self.folder}")']

    def fails(self, case, times, label="unit"):
        self.add(case, self.folder / "fails", case, times, label=label)

    def run_tests(self, unsteady="", *more):
        """The exit code, and what the summary of all stages will tell, by its kind."""
        (self.folder / "CTestTestfile.cmake").write_text("\n".join(self.tests))
        (self.folder / "unsteady.txt").write_text(unsteady)
        ended = subprocess.run(
            [sys.executable, ROOT / "tools/run_tests.py", "--logs", self.folder / "logs", "--unsteady",
             self.folder / "unsteady.txt", *more, "sabotage", self.folder, "--test-dir", self.folder],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        self.output = ended.stdout
        told = {kind: (self.folder / f"logs/sabotage.{kind}").read_text()
                for kind in ("red", "unsteady", "skipped", "closing", "note")}
        return ended.returncode, told

    def test_one_that_fails_the_first_time_only_is_green_and_named(self):
        self.fails("A.Once", 1)
        self.fails("A.Never", 0)
        code, told = self.run_tests()
        self.assertEqual(code, 0, self.output)
        self.assertIn("A.Once: failed, then passed alone", told["unsteady"])
        self.assertIn("what A.Once saw", told["unsteady"])
        self.assertNotIn("A.Never", told["unsteady"])
        self.assertEqual(told["closing"], "sabotage: 2 passed, 0 failed, 0 skipped\n")

    def test_one_that_passes_at_the_third_try_only_is_green_and_named(self):
        self.fails("A.Twice", 2)
        code, told = self.run_tests()
        self.assertEqual(code, 0, self.output)
        self.assertIn("A.Twice", told["unsteady"])

    def test_one_that_fails_three_times_is_red(self):
        self.fails("A.Thrice", 3)
        self.fails("A.Once", 1)
        code, told = self.run_tests()
        self.assertEqual(code, 1)
        self.assertEqual(told["red"], "A.Thrice failed each time\n")
        self.assertIn("A.Once", told["unsteady"])
        self.assertEqual(told["closing"], "sabotage: 1 passed, 1 failed, 0 skipped\n")

    def test_an_exact_one_that_fails_once_is_red_and_not_run_again(self):
        self.fails("A.Exact", 1, label="unit-cs-exact")
        code, told = self.run_tests()
        self.assertEqual(code, 1)
        self.assertIn("A.Exact is exact", told["red"])
        self.assertEqual((self.folder / "A.Exact").read_text(), "1\n", "it was started once")

    def test_an_exact_one_is_run_again_where_something_did_not_come(self):
        self.program("fails", FAILS.replace("what $case saw", "a.cpp:1: Failure\\nthe answer did not "
                                            "come in 60 s\\na.cpp:2: Failure\\n  2\\n  3"))
        self.fails("A.Exact", 1, label="unit-cs-exact")
        self.add("silent", "sh", "-c", "echo '[ RUN      ] A.Silent'; [ -e spoke ] && "
                 "echo '[       OK ] A.Silent (0 ms)' && exit; : >spoke; echo 'a.cpp:1: Failure'; "
                 "echo 'Unknown: the agent is not heard'; echo '[  FAILED  ] A.Silent (0 ms)'; exit 1",
                 label="unit-cs-exact")
        self.add("hangs", "sh", "-c", "echo '[ RUN      ] A.Hang'; [ -e hung ] && "
                 "echo '[       OK ] A.Hang (0 ms)' && exit; : >hung; sleep 60", label="unit-cs-exact", timeout=1)
        code, told = self.run_tests()
        self.assertEqual(code, 0, self.output)
        self.assertIn("A.Exact: failed, then passed alone", told["unsteady"])
        self.assertIn("A.Silent", told["unsteady"])
        self.assertIn("A.Hang", told["unsteady"])

    def test_an_exact_one_that_judges_before_something_does_not_come_is_red(self):
        self.program("fails", FAILS.replace("what $case saw", "a.cpp:1: Failure\\n  2\\n  3\\na.cpp:2: "
                                            "Failure\\nthe answer did not come in 60 s"))
        self.fails("A.Exact", 1, label="unit-cs-exact")
        self.add("hangs", "sh", "-c", "echo '[ RUN      ] A.Wrong'; echo '[  FAILED  ] A.Wrong (0 ms)'; "
                 "echo '[ RUN      ] A.Hang'; sleep 60", label="unit-cs-exact", timeout=1)
        self.add("differs", "sh", "-c", "echo '[ RUN      ] A.Differs'; echo 'a.cpp:1: Failure'; "
                 "sleep 60", label="unit-cs-exact", timeout=1)
        code, told = self.run_tests()
        self.assertEqual(code, 1)
        self.assertIn("A.Exact is exact", told["red"])
        self.assertIn("A.Wrong is exact", told["red"])
        self.assertIn("A.Differs is exact", told["red"])
        self.assertNotIn("A.Hang", told["red"])

    def test_an_exact_one_that_judges_at_its_second_try_is_red(self):
        self.program("fails", """#!/bin/sh
count=$(cat count 2>/dev/null || echo 0)
echo $((count + 1)) >count
echo '[ RUN      ] A.Exact'
echo 'a.cpp:1: Failure'
[ "$count" -eq 2 ] && { echo '[       OK ] A.Exact (0 ms)'; echo '[  PASSED  ] 1 test.'; exit 0; }
[ "$count" -eq 0 ] && echo 'it did not come in 60 s' || echo 'it is wrong'
echo '[  FAILED  ] A.Exact (0 ms)'
exit 1
""")
        self.fails("A.Exact", 1, label="unit-cs-exact")
        code, told = self.run_tests()
        self.assertEqual(code, 1)
        self.assertIn("A.Exact is exact, and failed at the second try", told["red"])

    def test_a_report_of_a_sanitizer_in_a_program_that_a_test_started_is_red(self):
        source = self.folder / "agent.cpp"
        source.write_text("int main() { int* p = new int{1}; delete p; return *p; }\n")
        subprocess.run([COMPILER, "-fsanitize=address", source, "-o", self.folder / "agent"], check=True)
        self.add("starts-an-agent", "sh", "-c", "./agent; true")
        code, told = self.run_tests()
        self.assertEqual(code, 1, self.output)
        self.assertIn("heap-use-after-free", told["red"])

    def test_a_hang_is_ended_and_red_with_the_case_that_had_begun(self):
        self.add("hangs", "sh", "-c", "echo '[ RUN      ] A.Hang'; sleep 60", timeout=1)
        code, told = self.run_tests()
        self.assertEqual(code, 1)
        self.assertEqual(told["red"], "A.Hang failed each time\n")

    def test_a_crash_names_the_case_that_had_begun(self):
        self.add("crashes", "sh", "-c",
                 "[ -e crashed ] && exit; : >crashed; echo '[ RUN      ] A.Crash'; kill -9 $$")
        code, told = self.run_tests()
        self.assertEqual(code, 0, self.output)
        self.assertIn("A.Crash", told["unsteady"])

    def test_one_that_ends_with_0_before_its_last_case_is_red(self):
        self.add("leaves", "sh", "-c", "echo '[==========] Running 2 tests from 1 test suite.'; "
                 "echo '[ RUN      ] A.Leaves'")
        code, told = self.run_tests()
        self.assertEqual(code, 1)
        self.assertIn("leaves ended with 0 before all of its cases had run", told["red"])

    def test_one_whose_filter_matches_nothing_is_red(self):
        self.add("empty", "sh", "-c", "echo '[==========] Running 0 tests from 0 test suites.'; "
                 "echo '[==========] 0 tests from 0 test suites ran. (0 ms total)'")
        code, told = self.run_tests()
        self.assertEqual((code, told["red"]), (1, "empty has run no case\n"))

    def test_a_case_that_failed_is_red_also_where_its_program_ends_with_0(self):
        self.add("hides", "sh", "-c", "echo '[==========] Running 1 test from 1 test suite.'; "
                 "echo '[ RUN      ] A.Hidden'; echo '[  FAILED  ] A.Hidden (0 ms)'; "
                 "echo '[==========] 1 test from 1 test suite ran. (0 ms total)'")
        code, told = self.run_tests()
        self.assertEqual((code, told["red"]), (1, "A.Hidden failed, although hides ended with 0\n"))

    def test_a_name_of_a_list_that_no_case_of_the_program_has_is_red(self):
        listed = self.program("listed", """#!/bin/sh
printf 'A.\\n  First\\n  Second\\nShards/B/1.  # TypeParam = int\\n  Holds/0  # GetParam() = 7\\n'
""")
        names = [sys.executable, ROOT / "tests/gate/names_test.py", listed]
        told = subprocess.run([*names, "A.First", "A.Sec*", "Shards/B/?.*/0"], check=False)
        self.assertEqual(told.returncode, 0)
        told = subprocess.run([*names, "A.First", "A.Third", "Shards/*/1"], stdout=subprocess.PIPE,
                              text=True, check=False)
        self.assertEqual(told.returncode, 1)
        self.assertIn("A.Third is no case of", told.stdout)
        self.assertIn("Shards/*/1 is no case of", told.stdout)
        self.assertNotIn("A.First", told.stdout)

    def test_six_unsteady_cases_are_red_unless_the_list_names_one(self):
        for number in range(6):
            self.fails(f"A.Once{number}", 1)
        code, told = self.run_tests()
        self.assertEqual(code, 1)
        self.assertIn("6 cases are unsteady", told["red"])
        for number in range(6):
            (self.folder / f"A.Once{number}").unlink()
        code, told = self.run_tests(f"A.Once3  {TODAY}  seen here\n")
        self.assertEqual(code, 0, self.output)
        self.assertIn("A.Once3 (in the list)", told["unsteady"])

    def test_a_line_of_the_list_that_is_old_or_says_nothing_is_red(self):
        self.fails("A.Never", 0)
        old = TODAY - datetime.timedelta(days=90)
        code, told = self.run_tests(f"A.Old  {old}  seen here\n\n# a comment\nA.Nameless\n")
        self.assertEqual(code, 1)
        self.assertIn("unsteady.txt:1: A.Old stands there for", told["red"])
        self.assertIn("unsteady.txt:4: not 'NAME YYYY-MM-DD what was seen'", told["red"])
        code, told = self.run_tests("A.Later  2999-01-01  seen\nA.Never  2026-13-45  seen\n")
        self.assertIn("unsteady.txt:1: A.Later: 2999-01-01 is yet to come", told["red"])
        self.assertIn("unsteady.txt:2: 2026-13-45 is no date", told["red"])
        code, told = self.run_tests("".join(f"A.B{n}  {TODAY}  seen\n" for n in range(11)))
        self.assertIn("has 11 lines, of at most 10", told["red"])

    def test_a_skipped_case_is_named_with_its_reason_and_red_where_all_must_run(self):
        self.add("needs-a-device", "sh", "-c", "echo '[ RUN      ] A.Needs'; echo 'a.cpp:1: Skipped'; "
                 "echo 'no device'; echo '[  SKIPPED ] A.Needs (0 ms)'")
        code, told = self.run_tests()
        self.assertEqual((code, told["skipped"]), (0, "A.Needs: no device\n"), self.output)
        code, told = self.run_tests("", "--must-run")
        self.assertEqual(code, 1)


if __name__ == "__main__":
    unittest.main()
