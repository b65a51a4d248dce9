#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Counts the instructions of cortex-hot-paths under callgrind and compares them with a baseline; tells
how many cache lines a cycle touches.

    instructions.py check BUILD BASELINE    exit status 1 where a cost has grown too much
    instructions.py write BUILD BASELINE    writes the baseline anew
"""
import os
import pathlib
import re
import subprocess
import sys

GROWTH = 0.05   # of a scenario, or of a function above SHARE of it, is a failure
SHARE = 0.02
LISTED = 0.01   # functions above this share of their scenario stand in the baseline
MOVED = 0.005   # what changed less is called the same
NAME_WIDTH = 78

# One choice of copying functions whatever the CPU: else counts would depend on it, and `rep movsb`
# counts as an instruction for each octet.
TUNABLES = "glibc.cpu.hwcaps=" + ",".join(
    "-" + each for each in ("AVX2", "AVX512F", "AVX512VL", "AVX_Fast_Unaligned_Load", "ERMS",
                            "FSRM", "SSSE3"))

# So small that what a cycle touches is gone when the next one comes to it: what it misses is the
# number of lines that it touches, those counted twice that it comes back to.
CACHE = ["--cache-sim=yes", "--D1=32768,8,64"]
LINES = "cache lines of data"  # beside the functions of a scenario; not judged

HEAD = """\
# Instructions per cycle, exclusive per function, as `./run baseline` counted them; the stage
# `instructions` of `./run test` compares with them. Functions below 1 % are in the total only.
# Cache lines: missed in a cycle by a data cache of 32 KiB.
"""
REMEDY = """
Look first why: `callgrind_annotate FILE` shows more (the files are in
{folder}). If the change is worth it, or only moved a cost from one
function to another, write the new counts with it (./run baseline) and say so in the commit: what is
written now is what every later change is compared with."""


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def versions(build):
    """What counts depend on, apart from the sources."""
    cache = dict(re.findall(r"^(CMAKE_\w+):\w+=(.*)$", (build / "CMakeCache.txt").read_text(),
                            re.MULTILINE))
    compiler = cache["CMAKE_CXX_COMPILER"]
    library = pathlib.Path(output(compiler, "-print-file-name=libstdc++.so.6").strip())
    target = re.search(r"-march=\s+(\S+)", output(compiler, "-Q", "--help=target"))
    flags = f"{cache['CMAKE_CXX_FLAGS']} {cache['CMAKE_CXX_FLAGS_RELEASE']}".split()
    return {
        "compiler": output(compiler, "--version").splitlines()[0],
        "flags": " ".join(flags + [f"(for {target.group(1)})" if target else ""]).strip(),
        "glibc": os.confstr("CS_GNU_LIBC_VERSION").split()[-1],
        "libstdc++": library.resolve().name,
        "valgrind": output("valgrind", "--version").strip().removeprefix("valgrind-"),
    }


def function_name(name, library):
    """Stable: without what the compiler or callgrind appends. Other libraries count as a whole: which
    names are known of them depends on the debug symbols that are installed."""
    library = pathlib.Path(library).name.split(".so")[0]
    if "cortex" not in library or name.startswith("0x"):
        return f"({library or 'unknown'})"
    return re.sub(r"( \[clone [^]]*\])+|'\d+$", "", name)


def read_dump(path):
    """(scenario, {function: instructions per cycle, LINES: …}) of a file that callgrind wrote."""
    label, cycles, costs, lines, events = "", 0, {}, 0, []
    names = {"fn": {}, "ob": {}}
    current = {"fn": "", "ob": ""}
    inclusive = False  # the next line of cost is that of a call
    for line in path.read_text().splitlines():
        if found := re.match(r"desc: Trigger: Client Request: (\S+) (\d+)$", line):
            label, cycles = found.group(1), int(found.group(2))
        elif line.startswith("events: "):
            events = line.split()[1:]
        elif found := re.match(r"c?(fn|ob|fi|fl|fe)=\((\d+)\)(?: (.*))?$", line):
            kind, number, name = found.groups()
            if kind in names:
                if name is not None:
                    names[kind][number] = name
                if not line.startswith("c"):
                    current[kind] = names[kind][number]
        elif line.startswith("calls="):
            inclusive = True
        elif re.match(r"[-+*\d]", line):
            if not inclusive:
                name = function_name(current["fn"], current["ob"])
                cost = dict(zip(events, map(int, line.split()[1:])))  # those at the end may lack
                costs[name] = costs.get(name, 0) + cost.get("Ir", 0)
                lines += cost.get("D1mr", 0) + cost.get("D1mw", 0)
            inclusive = False
    costs[LINES] = lines
    return label, {name: cost / cycles for name, cost in costs.items()} if cycles else {}


def count(build, folder):
    """{scenario: {function: instructions per cycle, LINES: …}}"""
    environment = dict(os.environ, GLIBC_TUNABLES=TUNABLES)
    program = build / "bin" / "cortex-hot-paths"
    for old in folder.glob("callgrind.out*"):
        old.unlink()
    done = subprocess.run(["valgrind", "--quiet", "--tool=callgrind", "--instr-atstart=no",
                           "--collect-atstart=no", f"--callgrind-out-file={folder}/callgrind.out",
                           *CACHE, str(program)], env=environment, capture_output=True, text=True,
                          check=False)
    if done.returncode != 0:
        sys.exit(f"{program} ended with {done.returncode} under callgrind:\n{done.stderr}")
    dumps = sorted(folder.glob("callgrind.out.*"), key=lambda path: int(path.suffix[1:]))
    return dict(filter(lambda each: each[0], map(read_dump, dumps)))


def total(functions):
    return sum(cost for name, cost in functions.items() if name != LINES)


def by_cost(functions):
    return sorted(functions.keys() - {LINES}, key=lambda name: (-functions[name], name))


def write(path, described, counted):
    lines = [HEAD] + [f"{key:<10} {value}\n" for key, value in described.items()]
    for scenario, functions in counted.items():
        whole = total(functions)
        lines.append(f"\n[{scenario}]\n{whole:12.1f}  total\n")
        lines.append(f"{functions[LINES]:12.1f}  {LINES}\n")
        lines += [f"{functions[name]:12.1f}  {name}\n" for name in by_cost(functions)
                  if functions[name] >= LISTED * whole]
    path.write_text("".join(lines))


def read(path):
    """(versions, {scenario: {function or 'total': instructions per cycle}}) of a baseline."""
    described, counted, scenario = {}, {}, None
    for line in path.read_text().splitlines():
        if not line or line.startswith("#"):
            continue
        if line.startswith("["):
            scenario = counted.setdefault(line.strip("[]"), {})
        elif scenario is None:
            key, _, value = line.partition(" ")
            described[key] = value.strip()
        else:
            cost, name = line.strip().split("  ", 1)
            scenario[name] = float(cost)
    return described, counted


def shortened(name):
    """As much as a table has room for."""
    return name if len(name) <= NAME_WIDTH else name[:NAME_WIDTH - 1] + "…"


def change(before, now):
    if before == 0:
        return "new"
    return f"{(now / before - 1) * 100:+.1f} %"


def verdict(before, now, judged):
    if now > before * (1 + GROWTH) and judged:
        return "GREW"
    if now < before * (1 - MOVED):
        return "fell"
    return "grew" if now > before * (1 + MOVED) else ""


def compare(scenario, before, now):
    """Prints the table of a scenario; returns what grew too much."""
    whole = total(now)
    rows = [("total", before["total"], whole, verdict(before["total"], whole, True))]
    shown = before.keys() - {"total", LINES}
    shown |= {name for name in by_cost(now) if now[name] >= SHARE * whole}
    latest = {name: max(now.get(name, 0), before.get(name, 0)) for name in shown}
    for name in by_cost(latest):
        old, new = before.get(name, 0), now.get(name, 0)
        judged = old > SHARE * before["total"]
        word = verdict(old, new, judged)
        if latest[name] >= SHARE * min(whole, before["total"]) or word:
            rows.append((name, old, new, word))
    print(f"\n{scenario}\n{'before':>12}{'now':>12}{'change':>10}        function")
    for name, old, new, word in rows:
        print(f"{old:12.1f}{new:12.1f}{change(old, new):>10}  {word:<4}  {shortened(name)}")
    old, new = before.get(LINES, 0), now[LINES]
    print(f"{old:12.1f}{new:12.1f}{change(old, new):>10}        {LINES}")
    return [f"{scenario}: {name} {change(old, new)}" for name, old, new, word in rows
            if word == "GREW"]


def check(path, described, counted, folder):
    old_versions, old = read(path)
    grown = []
    for scenario, functions in counted.items():
        if scenario in old:
            grown += compare(scenario, old[scenario], functions)
        else:
            print(f"\n{scenario}: not in the baseline, {total(functions):.1f} in a cycle")
    missing = [f"{each}: not counted any more" for each in old if each not in counted]
    differing = [key for key in described if described[key] != old_versions.get(key)]
    for key in differing:
        print(f"\n{key} differs: the baseline has {old_versions.get(key)}, here is "
              f"{described[key]}", end="")
    if differing:
        print("\nCounts of other versions cannot be blamed on the sources: count both with the same.")
    if grown or missing:
        print(f"\nmore than {GROWTH * 100:.0f} % above {path}:")
        print("\n".join("  " + each for each in grown + missing))
        print(REMEDY.format(folder=folder))
        return 1
    print(f"\nno scenario, and no function above {SHARE * 100:.0f} % of one, grew by more than "
          f"{GROWTH * 100:.0f} %")
    return 0


def main():
    if len(sys.argv) != 4 or sys.argv[1] not in ("check", "write"):
        sys.exit(__doc__)
    build, baseline = pathlib.Path(sys.argv[2]).resolve(), pathlib.Path(sys.argv[3])
    folder = build / "instructions"
    folder.mkdir(exist_ok=True)
    counted = count(build, folder)
    if not counted:
        sys.exit("callgrind counted nothing")
    if sys.argv[1] == "check":
        sys.exit(check(baseline, versions(build), counted, folder))
    write(baseline, versions(build), counted)


main()
