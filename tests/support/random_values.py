"""Random skills that pass values to each other, for SkiROS2 and for EzSkiROS, and what they note.

All of them have some of the same few names, so that these meet on the blackboard.
"""

from __future__ import annotations

import json
import random
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import MappingProxyType

from py_trees.common import Status

from ezskiros.driver import check_paths
from ezskiros.engine.execution_context import ExecutionContext
from ezskiros.engine.task import Task
from ezskiros.engine.world import World
from ezskiros.ontology import Ontology
from ezskiros.session import NOWHERE
from ezskiros.skills.calls import SkillCall

MOST_TICKS = 8
RECORDED = Path(__file__).parents[1] / "ezskiros" / "engine" / "values_in_skiros2.json"
LOG: list[str] = []
"""The notes of the skills while they run: their values at each call of one of their methods."""
PRIMITIVES = ("Pa", "Pb", "Pc")
COMPOUNDS = ("Cd", "Ce", "Task")
_FLOWS = ("serial", "serialstar", "selector", "selectorstar", "parallelff", "parallelfs", "nofail")
_RESULTS = {"S": "self.success('')", "F": "self.fail('', -1)", "R": "self.step('')"}


@dataclass(frozen=True)
class Slot:
    """A parameter. `default` is how it is written, None if it has none."""

    name: str
    type: str
    default: str | None
    is_optional: bool


@dataclass(frozen=True)
class Skill:
    """A skill: what its primitive does at each tick, or the tree of its compound.

    `sets` has the values that its methods set, as they are written.
    """

    name: str
    slots: tuple[Slot, ...]
    sets: dict[str, tuple[str, str]]
    script: str
    tree: str

    @property
    def label(self) -> str:
        return self.name.lower()


def skills_of(seed: int) -> list[Skill]:
    """Some skills; `Task` is the last one."""
    chance = random.Random(seed)
    names = "ABCD"[: chance.randint(2, 4)]
    known: dict[str, Skill] = {}
    for name in (*PRIMITIVES, *COMPOUNDS):
        slots = tuple(
            _slot(each, chance) for each in chance.sample(names, chance.randint(1, len(names)))
        )
        known[name] = Skill(
            name,
            slots,
            sets=dict(_sets(slots, chance)),
            script="".join(chance.choice("SSSRRF") for _ in range(3)),
            tree=_tree(known, slots, chance) if name in COMPOUNDS else "",
        )
    return [*known.values()]


def _slot(name: str, chance: random.Random) -> Slot:
    kind = chance.choice(("float", "float", "float", "int", "str"))
    default = _value(kind, chance) if chance.random() < 0.5 else None
    return Slot(name, kind, default, is_optional=default is None or chance.random() < 0.5)


def _value(kind: str, chance: random.Random) -> str:
    number = chance.randint(1, 99)
    return {"float": f"{number}.5", "int": f"{number}", "str": f"'t{number}'"}[kind]


def _sets(slots: tuple[Slot, ...], chance: random.Random) -> Iterator[tuple[str, tuple[str, str]]]:
    for method in ("onStart", "execute", "onPreempt", "onEnd"):
        if chance.random() < (0.5 if method in ("execute", "onPreempt") else 0.2):
            slot = chance.choice(slots)
            yield method, (slot.name, _value(slot.type, chance))


def _tree(known: dict[str, Skill], slots: tuple[Slot, ...], chance: random.Random) -> str:
    below = [name for name in known if name not in COMPOUNDS] * 2
    below += [name for name in known if name in COMPOUNDS]

    def node(depth: int) -> str:
        if depth < 2 and chance.random() < 0.3:
            children = ", ".join(node(depth + 1) for _ in range(chance.randint(1, 3)))
            return f"self.{chance.choice(_FLOWS)}({children})"
        skill = known[chance.choice(below)]
        given = {each.name: _argument(each, slots, chance) for each in skill.slots}
        order = chance.sample([*given], len(given))
        arguments = (f"{name}={given[name]}" for name in order if given[name])
        return f"{skill.name}({', '.join(arguments)})"

    return ", ".join(node(1) for _ in range(chance.randint(1, 4)))


def _argument(slot: Slot, own: tuple[Slot, ...], chance: random.Random) -> str:
    """The argument of a child for a parameter; an empty text for none."""
    way = chance.random()
    passed = chance.choice(own)
    if way < 0.5:
        return f"params.{passed.name}"
    if way < 0.6:
        return _value(slot.type, chance)
    if way < 0.7 and passed.default is not None and passed.type == slot.type != "str":
        return f"params.{passed.name} * 2"
    return ""


def written(skills: list[Skill]) -> str:
    """The skills in EzSkiROS."""
    text = (
        "from ezskiros import OPTIONAL, SkillDescription\nfrom support.random_values import LOG\n"
    )
    for each in skills:
        slots = ", ".join(map(_described, each.slots))
        text += f"\n\nclass {each.name}(SkillDescription):\n"
        text += f"    def description(self, *, {slots}):\n        pass\n"
        text += f"\n\nclass {each.label}({each.name}.SkillBase):\n"
        if each.tree:
            text += f"    def expandBT(self, params):\n        self.serialstar({each.tree})\n"
        values = " ".join(f"{{self.params.{slot.name}!r}}" for slot in each.slots)
        text += _methods(each, values, "self.params.{}", each.sets)
    return text


def _described(slot: Slot) -> str:
    kind = f"OPTIONAL[{slot.type}]" if slot.is_optional else slot.type
    return f"{slot.name}: {kind}" + ("" if slot.default is None else f" = {slot.default}")


def natively(skills: list[Skill]) -> str:
    """The skills for SkiROS2, by its own API."""
    text = (
        "from skiros2_common.core.params import ParamTypes\n"
        "from skiros2_common.core.primitive import PrimitiveBase\n"
        "from skiros2_skill.core.skill import SkillBase, SkillDescription, State\n"
        "from support.native_trees import expand\nfrom support.random_values import LOG\n"
    )
    for each in skills:
        text += f"\n\nclass {each.name}(SkillDescription):\n    def createDescription(self):\n"
        for slot in each.slots:
            kind = "Optional" if slot.is_optional else "Required"
            value = slot.type if slot.default is None else slot.default
            text += f"        self.addParam({slot.name!r}, {value}, ParamTypes.{kind})\n"
        base = "SkillBase" if each.tree else "PrimitiveBase"
        text += f"\n\nclass {each.label}({base}):\n    def createDescription(self):\n"
        text += f"        self.setDescription({each.name}(), {each.label!r})\n"
        if each.tree:
            text += f"    def expand(self, skill):\n        expand(self, skill, {each.tree!r})\n"
        values = " ".join(f"{{self.params['{slot.name}'].value!r}}" for slot in each.slots)
        text += _methods(each, values, "self.params['{}'].value", each.sets)
    return text


def _methods(skill: Skill, values: str, place: str, sets: dict[str, tuple[str, str]]) -> str:
    """Methods that note the values, set some, and note them again."""
    results = {"onStart": "True", "onPreempt": "self.fail('', -1)", "onEnd": "True"}
    if not skill.tree:
        results["execute"] = "self.result()"
    text = (
        f'    def note(self, method):\n        LOG.append(f"{skill.label} {{method}} {values}")\n'
    )
    if not skill.tree:
        letters = ", ".join(f"lambda self: {_RESULTS[each]}" for each in skill.script)
        text += f"    def result(self):\n        self.count += 1\n        made = [{letters}]\n"
        text += "        return made[min(self.count, len(made)) - 1](self)\n"
    for method, result in results.items():
        text += f"    def {method}(self):\n"
        text += "        self.count = 0\n" if method == "onStart" else ""
        text += f"        self.note('{method}')\n"
        if method in sets:
            name, value = sets[method]
            text += f"        {place.format(name)} = {value}\n"
        text += f"        return {result}\n"
    return text


@cache
def recorded() -> dict[int, list[str]]:
    """The notes of random skills in SkiROS2, by seed."""
    return {int(seed): noted for seed, noted in json.loads(RECORDED.read_text()).items()}


def noted_here(skills: list[Skill], folder: Path) -> list[str]:
    """The notes of the skills in our engine with `--compatible`, and the state after each tick.

    Many of them have errors; they run nevertheless.
    """
    path = Path(tempfile.mkdtemp(dir=folder)) / "skills.py"
    path.write_text(written(skills))
    known = check_paths([path]).library
    description = next(each for each in known.descriptions() if each.__name__ == "Task")
    execution = ExecutionContext(known, World(Ontology(())), compatible=True)
    task = Task(SkillCall(description, None, MappingProxyType({}), NOWHERE), execution)
    LOG.clear()
    for _ in range(MOST_TICKS):
        state = task.tick()
        LOG.append(f"= {state.name.capitalize()}")
        if state is not Status.RUNNING:
            break
    return [*LOG]
