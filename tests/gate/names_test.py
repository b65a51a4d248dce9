#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`names_test.py PROGRAM NAME…`: each of these names of tests/kinds.cmake, in the words of
--gtest_filter, is that of a case which the program has."""
import re
import subprocess
import sys


def cases(program):
    told = subprocess.run([program, "--gtest_list_tests"], stdout=subprocess.PIPE, check=True, text=True)
    suite = ""
    for line in told.stdout.splitlines():
        name = line.split("#")[0].strip()
        if line.startswith("  "):
            yield suite + name
        else:
            suite = name


def matches(name, case):
    return re.fullmatch(re.escape(name).replace(r"\*", ".*").replace(r"\?", "."), case)


def main():
    program, *names = sys.argv[1:]
    there = list(cases(program))
    absent = [name for name in names if not any(matches(name, case) for case in there)]
    for name in absent:
        print(f"{name} is no case of {program}: correct tests/kinds.cmake")
    return 1 if absent else 0


if __name__ == "__main__":
    sys.exit(main())
