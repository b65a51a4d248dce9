#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that every #include respects the rooms of each folder and the layers between folders.

    tools/rooms.py              fails with file:line, rule and remedy for each forbidden include
    tools/rooms.py --draw       prints the arrows between rooms, with their counts
    tools/rooms.py --self-test  shows that each kind of forbidden include is found
"""
import collections
import pathlib
import re
import sys
import tempfile

# A room may include itself and the rooms before it.
ROOMS = {
    "core": ["base", "types", "files", "tables", "commands", "model", "agent"],
    "comms": ["wire", "security", "peers", "rtps", "dds", "agent", "mirror", "leases"],
    "cs": ["threads", "clocks", "tasks", "loop", "hook_checker"],
    "explorer/cli": ["text", "models", "live", "doctor", "conform", "verbs"],
    "explorer/gui": ["style", "record", "session", "model", "plugin", "motion", "drive", "widgets", "plots", "views",
                     "window", "program"],
}
# Rooms of one folder that do not know each other, although one stands before the other.
STRANGERS = {
    ("comms", "mirror"): ["agent"],
    # A view that a user could have written sees what is installed.
    ("explorer/gui", "motion"): ["style", "record", "session", "model"],
    ("explorer/gui", "drive"): ["style", "record", "session", "model"],
}
# A folder may include its own headers and those of these folders.
LAYERS = {
    "core": [],
    "cs": ["core"],
    "comms": ["core"],
    "mechanics": [],
    "drives": [],
    "toolkit": ["core", "cs", "comms", "mechanics", "drives"],
    "modbus": ["core", "cs", "toolkit", "drives"],
    "physics": ["core", "cs", "toolkit"],
    "explorer/common": ["core", "comms"],
    "explorer/cli": ["core", "comms", "explorer/common"],
    "explorer/gui": ["core", "comms", "drives", "explorer/common"],
}
# The room of each header that other folders see (include/ and internal/).
PUBLIC = {
    "core": {
        "base": "cell clock control_commands data error event_count findings findings_json loop_pace machine nearest_names numbered_text path plugin_places printable quality "
                "realtime "
                "report service_threads spsc_ring standstill state system_findings text_faults tick value xml_text",
        "types": "agreement labelled_value type_model",
        "files": "model_files type_description",
        "tables": "archive command_sentence event event_fold event_memory event_sinks image image_pool structure tables",
        "commands": "argument_checks command loop_thread mailbox proposed_settings record",
        "model": "crossed_pairs header_hash make_structure registry sending_checks simplex simplex_tree validation",
        "agent": "agent command_exchange framework_item loopback program_interface transport",
    },
    "comms": {
        "wire": "network_options simplex_mark",
        "security": "security",
        "agent": "dds_interface",
        "mirror": "mirror mirror_data mirror_listening",
        "leases": "lease_client",
    },
    "explorer/gui": {"plugin": "now small_plot theme view"},
    "cs": {
        "clocks": "trigger_source",
        "tasks": "io_exchange newest simplex_cs slow_work",
        "loop": "cluster_cs testing",
        "hook_checker": "hook_checker",
    },
}
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"')


def folder_of(path):
    """'core/src/base/text.cpp' is in 'core'."""
    return next((f for f in LAYERS if path.startswith(f + "/")), None)


def room_of_public(folder, name):
    for room, headers in PUBLIC.get(folder, {}).items():
        if name in headers.split():
            return room
    return None


def room_of(folder, path):
    """The room of a source or header; None: the folder has no rooms, or the file is in none."""
    parts = path[len(folder) + 1:].split("/")
    if parts[0] in ("include", "internal"):
        return room_of_public(folder, pathlib.PurePath(path).stem)
    if parts[0] == "src":
        parts = parts[1:]
    return parts[0] if len(parts) > 1 and parts[0] in ROOMS.get(folder, []) else None


def target_of(folder, included):
    """Folder and room of what an #include names; (None, None): none of this project's layers."""
    parts = included.split("/")
    if parts[0] == "cortex" and len(parts) == 3:
        name = parts[2].removesuffix(".hpp")
        others = [f for f in LAYERS if f.split("/")[0] == parts[1]]
        other = next((f for f in others if room_of_public(f, name)), next(iter(others), None))
        return other, room_of_public(other, name)
    if len(parts) == 2 and parts[0] == "common":
        return "explorer/common", None
    if len(parts) == 2 and parts[0] in ROOMS.get(folder, []):
        return folder, parts[0]
    return None, None


def includes(root):
    """(path, line number, included name) of all sources of the layers."""
    for folder in LAYERS:
        for path in sorted((root / folder).rglob("*.[ch]pp")):
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                if match := INCLUDE.match(line):
                    yield path.relative_to(root).as_posix(), number, match[1]


def finding(path, included):
    """What is wrong with an #include, with the remedy; None: nothing."""
    folder = folder_of(path)
    room = room_of(folder, path)
    if folder in ROOMS and room is None:
        return (f"this file is in no room of {folder}; move it to one of "
                f"{', '.join(ROOMS[folder])}, or name its room in tools/rooms.py")
    other, target = target_of(folder, included)
    if other is None:
        return None
    if other != folder:
        if other not in LAYERS[folder]:
            return (f"{folder} must not include {other}; it may include "
                    f"{', '.join(LAYERS[folder]) or 'no other folder'}")
        return None
    if folder not in ROOMS:
        return None
    if target is None:
        return f"'{included}' has no room; name one for it in tools/rooms.py"
    order = ROOMS[folder]
    if target in STRANGERS.get((folder, room), []):
        return f"rooms {room} and {target} of {folder} do not know each other; share below them"
    if order.index(target) > order.index(room):
        return (f"room {room} of {folder} must not include {target}, which stands above it; "
                f"move what is needed down to {room} or below")
    return None


def findings(root):
    for path, number, included in includes(root):
        if what := finding(path, included):
            yield f'{path}:{number}: #include "{included}": {what}'


def draw(root):
    arrows = collections.Counter()
    for path, _, included in includes(root):
        folder = folder_of(path)
        other, target = target_of(folder, included)
        room = room_of(folder, path)
        if other == folder and room and target and room != target:
            arrows[folder, room, target] += 1
    for folder, order in ROOMS.items():
        print(folder)
        for room in reversed(order):
            to = [f"{t} ({arrows[folder, room, t]})" for t in order if arrows[folder, room, t]]
            print(f"  {room:<9} -> {', '.join(to) or 'nothing'}")


def self_test():
    """A tree with one forbidden include of each kind, beside allowed ones."""
    tree = {
        "core/src/base/low.cpp": ['base/text.hpp', 'types/unit.hpp'],
        "core/src/lost.cpp": ['base/text.hpp'],
        "core/include/cortex/core/value.hpp": ['cortex/core/agent.hpp'],
        "core/src/agent/high.cpp": ['base/text.hpp', 'cortex/core/value.hpp', 'common/live_rule.hpp'],
        "comms/src/mirror/view.cpp": ['agent/agent_links.hpp', 'wire/cdr.hpp'],
        "explorer/cli/verbs/main.cpp": ['cortex/cs/cluster_cs.hpp', 'cortex/comms/mirror.hpp'],
    }
    expected = {
        "core/src/base/low.cpp:2", "core/src/lost.cpp:1", "core/include/cortex/core/value.hpp:1",
        "core/src/agent/high.cpp:3",
        "comms/src/mirror/view.cpp:1", "explorer/cli/verbs/main.cpp:1",
    }
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for path, names in tree.items():
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text("".join(f'#include "{name}"\n' for name in names))
        found = {":".join(line.split(":")[:2]) for line in findings(root)}
    if found != expected:
        sys.exit(f"expected findings at {sorted(expected)}, found {sorted(found)}")
    print("each kind of forbidden include is found")


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    if sys.argv[1:] == ["--self-test"]:
        self_test()
    elif sys.argv[1:] == ["--draw"]:
        draw(root)
    elif sys.argv[1:]:
        sys.exit(__doc__)
    else:
        found = list(findings(root))
        print("\n".join(found) if found else "every #include respects the rooms and layers")
        sys.exit(bool(found))


if __name__ == "__main__":
    main()
