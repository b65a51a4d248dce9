#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Cuts the files out of the tutorials in docs/, builds and runs them against an installed cortex.

Fenced blocks of a Markdown file are its steps, in order:
    ```cpp file=thermometer.cpp     written to that file (a later block of the same name replaces it)
    ```sh run                       run in the tutorial's folder; must end with exit status 0
    ```sh run=2                     the same, must end with exit status 2
    ```text expect                  each line must occur, in this order, in the output of the last run
Blocks without these words are prose. Every file with at least one run block gets its own folder.
They run on the loopback interface, in a domain that nobody else uses, whichever number they name.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

FENCE = re.compile(r"^```(\w*)[ \t]*([^\n`]*)\n(.*?)^```[ \t]*$", re.MULTILINE | re.DOTALL)
DOMAIN = re.compile(r"(--domain |CORTEX_DOMAIN=)\d+")
TIMEOUT_SECONDS = 300


def own_domain():
    """Of tests/support/own_domain.sh, in a shell that holds its lock until this process ends."""
    script = pathlib.Path(__file__).resolve().parents[1] / "support/own_domain.sh"
    shell = subprocess.Popen(["bash", "-c", f"source '{script}'; echo $ownDomain; read -r _"],
                             stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    return shell, shell.stdout.readline().strip()


def blocks(text):
    """Yields (line, info, body) of each fenced block."""
    for match in FENCE.finditer(text):
        yield text.count("\n", 0, match.start()) + 1, match.group(2).strip(), match.group(3)


def environment(prefix, domain):
    """A reader's environment: the installed programs, and cmake and pkg-config see the package."""
    result = dict(os.environ)
    result["PATH"] = f"{prefix}/bin:{result['PATH']}"
    result["CMAKE_PREFIX_PATH"] = str(prefix)
    result["PKG_CONFIG_PATH"] = f"{prefix}/lib/pkgconfig"
    result["LD_LIBRARY_PATH"] = f"{prefix}/lib"
    result["CORTEX_DOMAIN"] = domain
    result["CORTEX_INTERFACE"] = "lo"
    result.pop("CORTEX_PATH", None)
    return result


def run(folder, script, status, env, place):
    script = DOMAIN.sub(r"\g<1>" + env["CORTEX_DOMAIN"], script)
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", script], cwd=folder, env=env,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          timeout=TIMEOUT_SECONDS, check=False)
    if done.returncode != status:
        sys.exit(f"{place}: ended with {done.returncode} instead of {status}:\n{script}"
                 f"{done.stdout}")
    return done.stdout


def expect(lines, output, place):
    rest = output
    for line in filter(None, map(str.strip, lines)):
        _, found, rest = rest.partition(line)
        if not found:
            sys.exit(f"{place}: '{line}' is not in the output, or not in this order:\n{output}")


def follow(tutorial, folder, env):
    """Does what the tutorial says; returns the numbers of files written and of commands run."""
    files, runs, output = 0, 0, ""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for line, info, body in blocks(tutorial.read_text(encoding="utf-8")):
        place = f"{tutorial}:{line}"
        word, _, value = info.partition("=")
        if word == "file":
            target = folder / value
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(body, encoding="utf-8")
            files += 1
        elif word == "run":
            output = run(folder, body, int(value or 0), env, place)
            runs += 1
        elif word == "expect":
            expect(body.splitlines(), output, place)
        elif info:
            sys.exit(f"{place}: a block says '{info}'; known are file=NAME, run, run=STATUS, expect")
    return files, runs


def main():
    docs, work, prefix = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
    lock, domain = own_domain()
    env = environment(prefix, domain)
    total = 0
    for tutorial in sorted(docs.glob("*.md")):
        if not any(info.startswith("run") for _, info, _ in blocks(tutorial.read_text("utf-8"))):
            continue
        files, runs = follow(tutorial, work / tutorial.stem, env)
        print(f"{tutorial.name}: {files} files cut out, {runs} commands run")
        total += runs
    lock.communicate()
    if total == 0:
        sys.exit(f"no tutorial in {docs} has a run block")


if __name__ == "__main__":
    main()
