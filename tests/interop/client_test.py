#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A client that knows docs/protocol.md and Cyclone DDS only, against agents.

client_test.py SOURCE_DIR BINARY_DIR SYSTEM…: the systems are those of the demonstration.
The client is compiled outside of the tree, from the IDL that the protocol prints.
"""

import concurrent.futures
import contextlib
import fcntl
import functools
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

import random_model

SOURCE, BINARY, *SYSTEMS = (pathlib.Path(each).resolve() for each in sys.argv[1:])
LINE = re.compile(r'^(/\S*)\.([\w-]+) =(.*?)(?: \[([^]]*)\] (good|stale|bad|lost))?$')


PATIENCE = 60  # s; no test that passes waits so long
AGENTS = []  # that must run
LOCKS = []  # held until this process ends


def free(domain):
    """As in tests/support/own_domain.hpp: no port is bound, and the file was locked by this process."""
    first = 7400 + 250 * domain
    sockets = pathlib.Path("/proc/net/udp").read_text().splitlines()[1:]
    if any(int(line.split()[1][-4:], 16) in range(first, first + 250) for line in sockets):
        return False
    try:
        name = f"/tmp/cortex-test-domain-{domain}"
        file = os.open(name, os.O_RDONLY if os.path.exists(name) else os.O_RDONLY | os.O_CREAT)
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    LOCKS.append(file)
    return True


@functools.cache
def domain(number):
    """A domain of this process alone for each number."""
    return next(each for each in (1 + (os.getpid() + number + i) % 99 for i in range(99))
                if free(each))


def until(look, wanted):
    """What is seen once it is what is wanted."""
    end = time.monotonic() + PATIENCE
    while not wanted(seen := look()):
        ended = [each.args for each in AGENTS if each.poll() is not None]
        if ended or time.monotonic() > end:
            raise AssertionError(f"it did not come; ended: {ended}; seen last: {seen}")
    return seen


def build(folder):
    """The client, made in `folder` of what a stranger has."""
    for each in (SOURCE / "tests/interop/client").iterdir():
        shutil.copy(each, folder)
    protocol = (SOURCE / "docs/protocol.md").read_text()
    (folder / "cortex.idl").write_text(re.search(r"^```idl\n(.*?)^```$", protocol, re.M | re.S)[1])
    subprocess.run(["idlc", "cortex.idl"], cwd=folder, check=True)
    sources = sorted(each.name for each in folder.glob("*.c"))
    options = ["-std=gnu17", "-D_GNU_SOURCE", "-O1", "-Wall", "-Wextra", "-Werror"]
    subprocess.run(["cc", *options, "-o", "client", *sources, "-lddsc"], cwd=folder, check=True)
    return folder / "client"


@contextlib.contextmanager
def agent(system, number, *options):
    """An agent on a domain of this process, until the block ends."""
    environment = dict(os.environ, CORTEX_PATH=str(SOURCE / "ontology"))
    command = [BINARY / "bin/cortex-agent", system, "--priority", "0", "--interface", "127.0.0.1",
               "--domain", str(domain(number)), *options]
    with tempfile.TemporaryFile("w+") as output:
        process = subprocess.Popen(command, env=environment, stdin=subprocess.DEVNULL,
                                   stdout=output, stderr=subprocess.STDOUT)
        AGENTS.append(process)
        try:
            yield process
            if process.poll() is not None:
                output.seek(0)
                raise AssertionError(f"{system} ended: {output.read()}")
        finally:
            AGENTS.remove(process)
            process.terminate()
            process.wait()


class Client:
    folder = tempfile.TemporaryDirectory()
    program = build(pathlib.Path(folder.name))

    def __init__(self, number):
        self.domain = domain(number)

    # Its output; any code will do where None is expected.
    def run(self, *words, exits=0):
        ran = subprocess.run([self.program, str(self.domain), *words], text=True,
                             capture_output=True, timeout=PATIENCE)
        if exits not in (None, ran.returncode):
            raise AssertionError(f"{words} ended with {ran.returncode}:\n{ran.stdout}{ran.stderr}")
        return ran.stdout.splitlines()

    def list(self):
        return {tuple(line.split()) for line in self.run("list")}

    def values(self, prefix):
        """{path: {item: (elements, unit, quality)}}"""
        found = {}
        for line in self.run("values", prefix)[1:]:
            path, item, elements, unit, quality = LINE.match(line).groups()
            found.setdefault(path, {})[item] = (elements, unit, quality)
        return found


def number(text):
    return {"true": True, "false": False}.get(text) if text in ("true", "false") else float(text)


def same(printed, elements):
    if isinstance(elements[0], str):
        return printed == f' "{elements[0]}"'
    return [number(each) for each in printed.split()] == [float(each) for each in elements]


@contextlib.contextmanager
def demonstration():
    with contextlib.ExitStack() as stack:
        for system in SYSTEMS:
            stack.enter_context(agent(system, 0, "--startup"))
        yield


class CycloneClient(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.enterClassContext(demonstration())

    def test_lists_what_the_command_line_lists(self):
        # Again, while one of the agents is not heard yet.
        _, expected = until(lambda: (Client(0).list(), self.listed()),
                            lambda seen: seen[0] == seen[1])
        self.assertGreater(len(expected), 40)

    def test_prints_live_values(self):
        lines = Client(0).run("values", "/playback", "20")
        cycles = [int(line.split()[1]) for line in lines if line.startswith("cycle")]
        times = [float(line.split()[2]) for line in lines if line.startswith("/playback.time =")]
        self.assertEqual(len(times), 20)
        self.assertEqual(cycles, sorted(set(cycles)))
        self.assertGreater(len(set(times)), 10, times)
        self.assertIn('/playback.file = "synthetic_hand_path.csv"', lines)

    def test_prints_how_the_simplexes_of_an_agent_are(self):
        client = Client(0)
        listed = client.list()
        owner = next(each[3] for each in listed if each[0] == "/drives/1")
        until(lambda: client.run("summary", "/drives/1"),  # it is started up meanwhile
              lambda seen: seen == ["/drives/1 good Active"])
        marks = dict(line.split(" ", 1) for line in client.run("summary", "/"))
        self.assertEqual(sorted(marks), sorted(each[0] for each in listed if each[3] == owner))
        self.assertEqual(len(client.run("summary", "/drives/1")), 1)

    def test_calls_commands_and_gets_their_answers(self):
        client = Client(0)
        owner = next(each[3] for each in client.list() if each[0] == "/drives/1")
        startup = ("call", f"/{owner}", "startup", "prefix=/")
        until(lambda: client.run(*startup, exits=None),  # after that of its own start
              lambda seen: seen != ["Rejected busy startup is running"])
        self.assertEqual(client.run(*startup), ["Done none "])
        answer, = client.run("call", "/drives/1", "startup", exits=1)
        self.assertEqual(answer, "Rejected state startup needs Standby, is Active")
        answer, = client.run("call", "/drives/1", "strtup", exits=1)
        self.assertRegex(answer, "^Rejected unknown .*startup")
        answer, = client.run("call", f"/{owner}", "takeControl", "prefix=7", exits=1)
        self.assertRegex(answer, "^Rejected range .*7")

    def test_reads_and_commands_random_models(self):
        with concurrent.futures.ThreadPoolExecutor(6) as pool:
            for _ in pool.map(self.checkModel, range(1, int(os.environ.get("MODELS", "12")) + 1)):
                pass

    def test_asks_a_person_for_control(self):
        network = ["--domain", str(domain(0)), "--interface", "127.0.0.1"]
        with subprocess.Popen(
                [BINARY / "bin/cortex", "shell", "--name", "alice", "--keep-going", *network],
                text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as shell:
            shell.stdin.write("take /drives\n")
            shell.stdin.flush()
            self.assertIn("you control /drives", shell.stdout.readline())
            with concurrent.futures.ThreadPoolExecutor(1) as pool:
                asking = pool.submit(Client(0).run, "ask", "bob", "/drives/1", exits=1)
                people = [BINARY / "bin/cortex", "people", "--json", *network,
                          "--timeout", str(PATIENCE)]
                seen = until(lambda: json.loads(subprocess.run(people, capture_output=True).stdout),
                             lambda all: any(each["asks"] for each in all))
                self.assertEqual({each["person"]: each["asks"] for each in seen},
                                 {"alice": "", "bob": "/drives/1"})
                until(lambda: self.refuse(shell, asking), lambda _: asking.done())
                said = asking.result()
            tool = next(each["tool"] for each in seen if each["person"] == "alice")
            self.assertEqual(said, [f"{tool} is used by alice", f"{tool} refuses"])

    def test_reads_what_an_agent_has_kept(self):
        client = Client(0)
        until(lambda: client.run("call", "/drives/1", "startup", exits=None),
              lambda seen: seen[0].startswith("Rejected state"))
        owner = next(each[3] for each in client.list() if each[0] == "/drives/1")
        client.run("call", f"/{owner}", "takeControl", "prefix=/drives", exits=None)
        lines = until(lambda: client.run("past", "/drives/1"),
                      lambda seen: any(each.startswith("control") for each in seen))
        expected = subprocess.run(
            [BINARY / "bin/cortex", "events", "--since", "1d", "--json", "--domain",
             str(domain(0)), "--interface", "127.0.0.1"], capture_output=True, check=True).stdout
        self.assertRegex("\n".join(lines), r"state change info /drives/1 .*Active")
        self.assertRegex("\n".join(lines), r"control info .*takeControl.*: Done")
        self.assertRegex("\n".join(lines), r"refusal warning /drives/1 .*startup")
        kept = [each.split()[1] for each in lines if each.startswith("kept")]
        self.assertEqual(sorted(kept), ["command", "control", "fault", "loss", "message", "refusal",
                                        "state", "value"])
        shown = {(each["kind"], each["path"], each["text"]) for each in json.loads(expected)}
        for each in lines:
            if each.startswith(("control", "refusal")):
                kind, _, path, text = each.split(" ", 3)
                self.assertIn((kind, path, text), shown)

    @staticmethod
    def refuse(shell, asking):
        """Again, while the shell has not heard of the ask yet."""
        shell.stdin.write("refuse bob\n")
        shell.stdin.flush()
        concurrent.futures.wait([asking], timeout=0.2)

    def listed(self):
        """What the command line lists."""
        listed = subprocess.run(
            [BINARY / "bin/cortex", "list", "--json", "--domain", str(domain(0)), "--interface",
             "127.0.0.1", "--timeout", str(PATIENCE)], capture_output=True, check=True).stdout
        return {(each["path"], each["type"], each["role"], each["agent"])
                for each in json.loads(listed)}

    def checkModel(self, seed):
        model = random_model.Model(seed)
        with tempfile.TemporaryDirectory() as folder:
            with agent(model.write(pathlib.Path(folder)), seed):
                client = Client(seed)
                listed = {each[:2] for each in client.list() if each[0] != f"/{model.name}"}
                self.assertEqual(listed, set(model.types.items()), f"seed {seed}")
                self.compare(client, model)
                for path, changes in model.settings:
                    words = [f"{name}={','.join(map(random_model.text_of, elements))}"
                             for name, elements in changes.items()]
                    answer, = client.run("call", path, "set", *words)
                    self.assertEqual(answer, "Done none ", f"seed {seed} {path} {words}")
                    model.values[path].update(changes)
                if model.settings:
                    self.compare(client, model)

    def compare(self, client, model):
        # A value that is late is stale: it is looked at again.
        values = until(lambda: client.values("/"), lambda seen: "stale" not in str(seen))
        for path, items in model.values.items():
            for name, elements in items.items():
                printed, unit, quality = values[path][name]
                where = f"{model.name} {path}.{name}: {printed!r}, not {elements}"
                self.assertTrue(same(printed, elements), where)
                if not model.constant(path, name):
                    self.assertEqual((unit, quality), (model.unit(path, name), "good"), where)


if __name__ == "__main__":
    begin = time.monotonic()
    ended = unittest.main(argv=sys.argv[:1], verbosity=2, exit=False)
    print(f"{time.monotonic() - begin:.1f} s")
    sys.exit(not ended.result.wasSuccessful())
