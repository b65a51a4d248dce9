# SPDX-License-Identifier: Apache-2.0
"""Random models of descriptive types, and what is to be read of them. One seed, one model."""

import random

UNITS = ["m", "rad", "N.m", "m/s2", "Cel", "L/min", "%"]
NUMBERS = [0.1, -2.5, 1e-9, 123456789.0, 1e22, 3.0, -0.0625, 5e-324, 1.7976931348623157e308]


class Item:
    def __init__(self, chance, name):
        self.name = name
        self.kind = chance.choice(["int", "float", "bool", "string"])
        self.length = 1 if self.kind == "string" else chance.choice([1, 1, 1, 2, 3, 7])
        self.unit = chance.choice(UNITS + [""] * 4) if self.kind in ("int", "float") else ""
        self.constant = chance.random() < 0.25
        self.settable = not self.constant and chance.random() < 0.6

    def xml(self):
        text = f'    <data name="{self.name}" kind="{self.kind}" length="{self.length}"'
        if self.unit:
            text += f' unit="{self.unit}"'
        if self.constant:
            text += ' constant="true"'
        if self.settable:
            text += ' settable="always"'
        return text + "/>\n"

    def value(self, chance):
        """Random elements, as Python has them."""
        make = {
            "int": lambda: chance.choice([0, 1, -1, chance.randrange(-(2**63), 2**63)]),
            "float": lambda: chance.choice(NUMBERS + [chance.uniform(-1e3, 1e3)]),
            "bool": lambda: chance.random() < 0.5,
            "string": lambda: "".join(chance.choice("aZ09 _-äß€") for _ in range(chance.randrange(9))),
        }[self.kind]
        return [make() for _ in range(self.length)]


def text_of(element):
    if isinstance(element, bool):
        return "true" if element else "false"
    return element if isinstance(element, str) else repr(element)


class Model:
    """An ontology, a morphology and a system; `values` is {path: {item: elements}}."""

    def __init__(self, seed):
        chance = random.Random(seed)
        self.name = f"random{seed}"
        self.parents, self.items, self.rules = {}, {}, []
        for number in range(chance.randint(1, 12)):
            self._add_type(chance, f"Type{number}")
        self.types, self.values, self.relations = {}, {}, []
        for number in range(chance.randint(1, 40)):
            self._add_simplex(chance, number)
        self.settings = self._settings(chance)

    def _add_type(self, chance, name):
        parent = chance.choice(["Concept"] + list(self.items))
        inherited = self.items.get(parent, [])
        count = chance.randint(0 if inherited else 1, 8)
        names = chance.sample([f"{letter}{name}" for letter in "aBcDeFgHi_"], count)
        self.parents[name] = parent
        self.items[name] = inherited + [Item(chance, each) for each in names]
        if chance.random() < 0.5:
            self.rules.append((name, f"has{name}", chance.choice(list(self.items))))

    def _add_simplex(self, chance, number):
        above = chance.choice(["", ""] + [path for path in self.values if path.count("/") < 6])
        path, kind = f"{above}/s{number}", chance.choice(list(self.items))
        for owner, rule, target in self.rules:
            others = [each for each in self.types if self._is(self.types[each], target)]
            if self._is(kind, owner) and others:
                chosen = chance.sample(others, min(len(others), chance.randint(0, 3)))
                self.relations += [(path, rule, each) for each in chosen]
        self.types[path] = kind
        self.values[path] = {item.name: item.value(chance) for item in self.items[kind]}

    def _is(self, kind, other):
        while kind in self.parents and kind != other:
            kind = self.parents[kind]
        return kind == other

    def _settings(self, chance):
        """Some (path, {item: elements}) that a command may set."""
        found = []
        for path, kind in self.types.items():
            settable = [item for item in self.items[kind] if item.settable and item.kind != "string"]
            if settable:
                chosen = chance.sample(settable, chance.randint(1, len(settable)))
                found.append((path, {item.name: item.value(chance) for item in chosen}))
        return chance.sample(found, min(2, len(found)))

    def unit(self, path, name):
        return next(item.unit for item in self.items[self.types[path]] if item.name == name)

    def constant(self, path, name):
        return next(item.constant for item in self.items[self.types[path]] if item.name == name)

    def write(self, folder):
        """The files; the path of the system."""
        head = '<?xml version="1.0" encoding="UTF-8"?>\n'
        ontology = head + '<ontology name="random" version="1.0">\n  <include file="base.xml"/>\n'
        for name, parent in self.parents.items():
            inherited = self.items.get(parent, [])
            own = [item for item in self.items[name] if item not in inherited]
            data = "".join(item.xml() for item in own)
            ontology += f'  <type name="{name}" extends="{parent}">\n{data}  </type>\n'
        morphology = (head + '<morphology name="random" version="1.0">\n'
                      '  <include file="base-morphology.xml"/>\n'
                      f'  <include file="{self.name}.xml"/>\n')
        for owner, rule, target in self.rules:
            morphology += (f'  <rules type="{owner}"><relationship name="{rule}" direction="input" '
                           f'target="{target}"/></rules>\n')
        (folder / f"{self.name}.xml").write_text(ontology + "</ontology>\n")
        (folder / f"{self.name}-morphology.xml").write_text(morphology + "</morphology>\n")
        system = folder / f"{self.name}-system.xml"
        system.write_text(head + self._system())
        return system

    def _system(self):
        text = (f'<system name="{self.name}">\n  <morphology file="{self.name}-morphology.xml"/>\n'
                f'  <cluster name="{self.name}" frequency="100"/>\n')
        for path, kind in self.types.items():
            text += f'  <simplex path="{path}" type="{kind}">\n'
            for owner, rule, target in self.relations:
                if owner == path:
                    text += f'    <relate rule="{rule}" to="{target}"/>\n'
            for name, elements in self.values[path].items():
                text += f'    <set data="{name}" value="{" ".join(map(text_of, elements))}"/>\n'
            text += "  </simplex>\n"
        return text + "</system>\n"
