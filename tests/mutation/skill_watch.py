"""Says whether rules that know skills mean what they should: `python -m mutation.skill_watch`.

A program of its own, so that the package it imports may be a damaged copy. It writes who notices;
a fault may also end it.
"""

from __future__ import annotations

import json
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from random import Random

from rossmarie import ir
from rossmarie.ir.calls import covering, query_at
from rossmarie.ir.skills import SkillContext, answer
from support.compiled import machine_of
from support.exempted import differences, random_events, random_program
from support.programs import errors_of
from support.rule_skills import FILE, HEAD, content
from support.skill_tales import any_context, honest_context
from support.skill_worlds import asked_of, random_world

WORLDS = 60
CONTEXTS = 16
PROGRAMS = 80

REFUSED = {
    "rule it: always if force > 5 N while doing Push then { stop; };": ["ROSS426"],
    "rule it: always if force > 5 N then { stop; } unless doing Push;": ["ROSS426"],
    "rule it: if force > 5 N then { stop; } unless doing Push unless doing Push;": ["ROSS431"],
    'hazard H "h"; rule it: if force > 5 N then { stop; } unless doing Push mitigates H;': [
        "ROSS427"
    ],
    "rule it: if doing Push(Object: Shelf) then { stop; };": ["ROSS245"],
}
"""Rules that are not right, and their errors."""


def answers() -> Iterator[str]:
    """Messages are answered otherwise than S58 says."""
    random = Random(58)
    with tempfile.TemporaryDirectory() as folder:
        worlds = [random_world(random) for _ in range(WORLDS)]
        for world in worlds:
            asked = asked_of(random, world, Path(folder))
            for _ in range(CONTEXTS):
                context = any_context(random, world, worlds)
                found = [answer(each, context) for each in asked.steps()]
                wanted = [world.answer(each, context) for each in asked.queries]
                if repr(found) != repr(wanted):
                    yield f"{found}, and not {wanted}"


def calls() -> Iterator[str]:
    """Answers that skills give are held for impossible."""
    random = Random(59)
    with tempfile.TemporaryDirectory() as folder:
        yield from _of_two_classes(Path(folder))
        for _ in range(WORLDS):
            world = random_world(random)
            asked = asked_of(random, world, Path(folder))
            for _ in range(CONTEXTS):
                context = honest_context(random, world)
                pairs = zip(asked.steps(), asked.queries, strict=True)
                given = {step: world.answer(each, context) == 1 for step, each in pairs}
                flags = {step: yes for step, yes in given.items() if isinstance(step, ir.Doing)}
                chosen = covering(asked.machine.calls, flags)
                running = () if chosen is None else tuple(each.running for each in chosen)
                reported = SkillContext.of(world.digest, running)
                if chosen is None or any(answer(s, reported) != yes for s, yes in flags.items()):
                    yield f"{flags}"


def _of_two_classes(folder: Path) -> Iterator[str]:
    """An individual that is a product and a box, and yet none of the chests, which are both: chance
    meets one too seldom.
    """
    found = content()
    chest = {**found["classes"][0], "name": "toys.Chest", "parents": ["skiros.Product", "toys.Box"]}
    found["classes"].append(chest)
    (folder / "skills.json").write_text(json.dumps(found), encoding="utf-8")
    head = HEAD.replace(str(FILE), str(folder / "skills.json"))
    condition = "doing Push(Object: toys.Box) or doing Push(Object: Chest)"
    machine = machine_of(f"{head} rule it: if {condition} then {{ stop; }};")
    box, chests = (step for slot in machine.slots if (step := query_at(slot.path)) is not None)
    if covering(machine.calls, {box: True, chests: False}) is None:
        yield "a box that is no chest"


def rules() -> Iterator[str]:
    """Rules hold otherwise than S59 to S62 say."""
    random = Random(60)
    for _ in range(PROGRAMS):
        yield from differences(random_program(random), random_events(random))


def findings() -> Iterator[str]:
    """Rules that are not right pass, or have another error."""
    for text, wanted in REFUSED.items():
        found = [code for code, _ in errors_of(HEAD + text)]
        if found != wanted:
            yield f"{text}: {found}"


WATCHERS: Mapping[str, Callable[[], Iterator[str]]] = {
    "random messages": answers,
    "answers that go together": calls,
    "random rules": rules,
    "findings": findings,
}


if __name__ == "__main__":
    for name, watcher in WATCHERS.items():
        if next(watcher(), None) is not None:
            sys.stdout.write(f"{name}\n")
