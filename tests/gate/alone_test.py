#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`alone_test.py FOLDER [FILE…]`: each of these test files compiles without its neighbours.

FOLDER is a build that compiles the sources of one folder as one (preset gate), where a file finds
what only its neighbour includes. Without FILEs: those that the last twenty commits touched."""
import argparse
import json
import pathlib
import re
import shlex
import subprocess
import sys

COMMITS = 20
ROOT = pathlib.Path(__file__).resolve().parents[2]


def touched():
    told = subprocess.run(["git", "log", f"-{COMMITS}", "--format=", "--name-only", "--", "tests"],
                          cwd=ROOT, stdout=subprocess.PIPE, check=True, text=True)
    return {ROOT / name for name in told.stdout.split("\n") if name.endswith(".cpp")}


def parts_of(unity):
    """The files that a file made by CMake includes; none of any other file."""
    if "/Unity/" not in unity:
        return []
    return re.findall(r'^#include "(.+)"$', pathlib.Path(unity).read_text(encoding="utf-8"), re.M)


def commands(folder):
    """For each file that is compiled with others: how it is checked alone, and where."""
    found = {}
    for entry in json.loads((folder / "compile_commands.json").read_text(encoding="utf-8")):
        words = shlex.split(entry["command"])
        alone = words[:words.index("-o")] + ["-fsyntax-only"]
        for part in parts_of(entry["file"]):
            found[pathlib.Path(part).resolve()] = (alone + [part], entry["directory"])
    return found


def compiles(command, directory):
    return subprocess.run(command, cwd=directory, check=False).returncode == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("files", nargs="*", type=pathlib.Path)
    arguments = parser.parse_args()
    known = commands(arguments.folder)
    files = sorted({file.resolve() for file in arguments.files} or
                   {file for file in touched() if file in known})
    missing = [file for file in files if file not in known]
    if missing:
        parser.error(f"{arguments.folder} compiles no {missing[0]} together with others")
    red = [str(file.relative_to(ROOT)) for file in files if not compiles(*known[file])]
    print(f"{len(files) - len(red)} of {len(files)} test files compile by themselves")
    for name in red:
        print(f"{name} does not: see above, and include there what it uses")
    return 1 if red else 0


if __name__ == "__main__":
    sys.exit(main())
