#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds documents against what they tell of.

    tools/documents.py              fails with each place where a document is wrong
    tools/documents.py --self-test  shows that each kind of mistake is found

docs/decisions.md: numbers in order, each once in the table, at most ten lines each, the number of
installed headers. docs/architecture.md: the rooms of tools/rooms.py, in their order, and its layers.
"""
import pathlib
import re
import sys

import rooms

DECISIONS, ARCHITECTURE = "docs/decisions.md", "docs/architecture.md"
MOST_LINES = 10
COUNTED = ["core", "cs", "comms"]


def decisions(text):
    """(number, its lines) of each, as they stand."""
    found = []
    for line in text.splitlines():
        if match := re.match(r"\*\*(\d+)\. ", line):
            found.append((int(match[1]), []))
        if found:
            found[-1][1].append(line)
    return [(number, "\n".join(lines).strip().splitlines()) for number, lines in found]


def indexed(text):
    """The numbers in the table at the begin, with 7 for each of "5 to 7"."""
    numbers = []
    for row in re.findall(r"^\|[^|]*\|([ \d,to]+)\|$", text, re.MULTILINE):
        for first, last in re.findall(r"(\d+)(?: to (\d+))?", row):
            numbers += range(int(first), int(last or first) + 1)
    return numbers


def of_decisions(text, headers):
    found = decisions(text)
    numbers = [number for number, _ in found]
    for at, number in enumerate(numbers, 1):
        if number != at:
            yield f"decision {number} stands where {at} belongs; put them in order, without a gap"
            break
    for number, lines in found:
        if len(lines) > MOST_LINES:
            yield f"decision {number} has {len(lines)} lines; at most {MOST_LINES}"
    table = indexed(text)
    for number in sorted(set(numbers) | set(table)):
        if table.count(number) != 1 or number not in numbers:
            yield (f"the table has decision {number} {table.count(number)} times, the text "
                   f"{numbers.count(number)} times; each has it once")
    told = re.search(r"(\d+)\s+headers\s+of\s+core,\s+cs\s+and\s+comms", text)
    if told is None or int(told[1]) != headers:
        yield (f"it says {told[1] if told else 'nothing'} of the installed headers of core, cs and "
               f"comms; there are {headers}")


def of_architecture(text, order, layers):
    for folder, names in order.items():
        heading = folder if "/" in folder else f"{folder}/src"
        match = re.search(rf"^\| `{heading}` \| idea \|\n\|---\|---\|\n((?:\|.*\n)+)", text,
                          re.MULTILINE)
        told = re.findall(r"^\| `([^`]+)`", match[1], re.MULTILINE) if match else []
        if told != names:
            yield (f"the rooms of {folder} are {', '.join(names)}; the table `{heading}` has "
                   f"{', '.join(told) or 'none'}")
    for folder in layers:
        if f"| `{folder}` |" not in text:
            yield f"no row of the layers says what {folder} is"


def installed_headers(root):
    """As CMake's file sets list them: what is not in one is not installed."""
    lists = [path for layer in COUNTED for path in sorted((root / layer).rglob("CMakeLists.txt"))]
    return len({name for path in lists
                for name in re.findall(r"include/(cortex/\w+/\w+\.hpp)", path.read_text("utf-8"))})


def findings(root):
    read = lambda name: (root / name).read_text(encoding="utf-8")
    for document, found in (
            (DECISIONS, of_decisions(read(DECISIONS), installed_headers(root))),
            (ARCHITECTURE, of_architecture(read(ARCHITECTURE), rooms.ROOMS, rooms.LAYERS))):
        yield from (f"{document}: {each}" for each in found)


def self_test():
    good = ("| about | decisions |\n|---|---|\n| a | 1, 3 |\n| b | 2 |\n\n"
            "**1. One.** It has 2\nheaders of core, cs and comms.\n\n**2. Two.** b\n\n**3. Three.** c\n")
    layers = ("| `core` | tables |\n\n| `core/src` | idea |\n|---|---|\n| `low` | a |\n"
              "| `high` | b |\n")
    wrong = {
        "in order": good.replace("**2.", "**4.").replace("| 2 |", "| 4 |"),
        "at most 10": good.replace("**2. Two.**", "**2. Two.**" + "\nmore" * 10),
        "decision 3 0 times": good.replace("1, 3", "1"),
        "decision 2 2 times": good.replace("1, 3", "1 to 3"),
        "there are 2": good.replace("has 2", "has 5"),
    }
    order = {"core": ["low", "high"]}
    mistakes = [(text, list(of_decisions(of, 2))) for text, of in wrong.items()]
    mistakes.append(("rooms of core", list(of_architecture(
        layers.replace("low", "lost"), order, ["core"]))))
    mistakes.append(("no row", list(of_architecture(layers, order, ["core", "cs"]))))
    right = [*of_decisions(good, 2), *of_architecture(layers, order, ["core"])]
    missed = [text for text, found in mistakes if not any(text in each for each in found)]
    if missed or right:
        sys.exit(f"not found: {missed}; found in what is right: {right}")
    print("each kind of mistake in a document is found")


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
    elif sys.argv[1:]:
        sys.exit(__doc__)
    else:
        found = list(findings(pathlib.Path(__file__).resolve().parent.parent))
        print("\n".join(found) if found else "decisions and architecture say what there is")
        sys.exit(bool(found))


if __name__ == "__main__":
    main()
