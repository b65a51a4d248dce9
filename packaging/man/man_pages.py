#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes man pages from what programs say of themselves.

    man_pages.py VERSION FOLDER PROGRAM…

For each program, its verbs and theirs in turn, `--help` is asked and one page written to FOLDER.
So a page cannot say anything else than the program. The page of `cortex watch` is cortex-watch.1.
"""
import os
import pathlib
import re
import subprocess
import sys

ENVIRONMENT = {
    "CORTEX_DOMAIN": "Domain of the agents, as with --domain.",
    "CORTEX_INTERFACE": "Address or name of a network interface, as with --interface.",
    "CORTEX_DISCOVERY_SERVER": "Fast DDS Discovery Server, as with --discovery-server.",
    "CORTEX_SECURITY": "Folder of keys and rights, as with --security.",
    "CORTEX_TIMEOUT": "Seconds to wait for agents, as with --timeout.",
    "CORTEX_PATH": "Folders, separated by colons, in which files of models are looked for before "
                   "the installed ones.",
    "CORTEX_AGENT_PLUGINS": "Folders, separated by colons, with plug-ins that are loaded for "
                            "the types that they list.",
}
HEADINGS = {"Positionals": "ARGUMENTS", "Options": "OPTIONS", "Subcommands": "COMMANDS",
            "Examples": "EXAMPLES"}


def escaped(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text[:1] in (".", "'") else text


def helpOf(command):
    result = subprocess.run([*command, "--help"], capture_output=True, text=True, check=True,
                            env={**os.environ, "QT_QPA_PLATFORM": "offscreen"})
    return result.stdout.splitlines()


def entries(lines):
    """[[term, description]] of lines in two columns; a long term has its description below."""
    result = []
    for line in lines:
        if line.startswith("   "):
            result[-1][1] = (result[-1][1] + " " + line.strip()).strip()
        else:
            result.append((re.split(r"\s{2,}", line.strip(), maxsplit=1) + [""])[:2])
    return result


def split(lines):
    """The summary, the usage, and the sections, in the order in which a page has them."""
    summary, usage, sections, at = "", "", [], None
    for line in lines:
        heading = re.fullmatch(r"(\w+):", line)
        if not summary:
            summary = line
        elif line.startswith("Usage: "):
            usage = line.removeprefix("Usage: ")
        elif heading:
            at = (HEADINGS.get(heading[1], heading[1].upper()), [])
            sections.append(at)
        elif line and not line.startswith(" ") and (at is None or at[0] != "NOTES"):
            at = ("NOTES", [line])
            sections.append(at)
        elif line and at:
            at[1].append(line)
    return summary, usage, sections


def kindInWords(kind):
    number = re.fullmatch(r"(INT|FLOAT) in \[(\S+) - (\S+)\](.*)", kind)
    choice = re.fullmatch(r"\w*:?\{(.*)\}(=.*)?", kind)
    if number:
        word = "an integer" if number[1] == "INT" else "a number"
        return f"{word} from {number[2]} to {number[3]}" + given(number[4])
    if choice:
        return "one of " + choice[1].replace(",", ", ") + given(choice[2])
    return ""


def given(default):
    default = (default or "").strip()
    return f"; {default[1:]} if not given" if default.startswith("=") else ""


def definition(term, text):
    """One `.TP` of roff: --rate HZ:INT in [0 - 100] Excludes: --csv."""
    term, _, excluded = term.partition(" Excludes: ")
    required = " REQUIRED" in term
    term = term.replace(" REQUIRED", "")
    names, _, value = term.partition(" ")
    if names.startswith("-"):
        label = ", ".join(f"\\fB{escaped(name)}\\fR" for name in names.split(","))
    else:
        label, value = f"\\fI{escaped(names)}\\fR", value
    many = value.endswith("...")
    value = value.removesuffix("...").strip()
    kind = re.search(r"(?:^|(?<=:))((INT|FLOAT|TEXT)\b|\{).*", value)
    name = value if kind is None else value[:kind.start()].rstrip(":")
    kind = kind[0] if kind else ""
    kind = re.sub(r"^(INT|FLOAT|TEXT):", "", kind)
    name = name or {"I": "N", "F": "NUMBER"}.get(kind[:1], "WORD")
    if value:
        label += f" \\fI{escaped(name)}\\fR"
    if many:
        label += " ..."
    more = [words for words in (kindInWords(kind) if kind else "",
                                "must be given" if required else "",
                                f"not together with {excluded.strip()}" if excluded else "")
            if words]
    if text and more:
        text = f"{text.rstrip('.')} ({'; '.join(more)})"
    return f".TP\n{label}\n{escaped(text.rstrip('.'))}.\n"


def page(version, name, lines, related):
    summary, usage, sections = split(lines)
    summary = summary.split(": ", 1)[-1]
    first = summary[:1].lower() + summary[1:].rstrip(".")
    out = [f'.TH {name.upper()} 1 "" "CorteX {version}" "CorteX"\n',
           f".SH NAME\n{escaped(name)} \\- {escaped(first)}\n",
           f".SH SYNOPSIS\n.nf\n{escaped(usage)}\n.fi\n"]
    text = "\n".join(lines)
    for heading, body in sections:
        out.append(f".SH {heading}\n")
        if heading in ("ARGUMENTS", "OPTIONS", "COMMANDS"):
            out += [definition(*entry) for entry in entries(body)]
        elif heading == "EXAMPLES":
            out.append(".nf\n" + "".join(escaped(line) + "\n" for line in body) + ".fi\n")
        else:
            out.append("\n.br\n".join(escaped(line) for line in body) + "\n")
    known = [key for key in ENVIRONMENT if key in text]
    if known:
        out.append(".SH ENVIRONMENT\n")
        out += [f".TP\n\\fB{escaped(key)}\\fR\n{escaped(ENVIRONMENT[key])}\n" for key in known]
    if related:
        out.append(".SH SEE ALSO\n" + ", ".join(f"\\fB{escaped(one)}\\fR(1)" for one in related)
                   + "\n")
    return "".join(out)


def write(version, folder, command, name, above):
    lines = helpOf(command)
    verbs = [entry[0] for heading, body in split(lines)[2] if heading == "COMMANDS"
             for entry in entries(body)]
    below = [f"{name}-{verb}" for verb in verbs]
    (folder / f"{name}.1").write_text(page(version, name, lines, above + below), encoding="utf-8")
    for verb, child in zip(verbs, below):
        write(version, folder, [*command, verb], child, [name])


def main():
    version, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    programs = [pathlib.Path(one) for one in sys.argv[3:]]
    folder.mkdir(parents=True, exist_ok=True)
    for program in programs:
        others = [one.name for one in programs if one != program]
        write(version, folder, [str(program)], program.name, others)


if __name__ == "__main__":
    main()
