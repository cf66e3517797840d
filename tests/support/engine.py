"""Skills that are written into files and run in the engine, by a clock that nobody waits for."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ezskiros.engine.events import Event, Happened
from ezskiros.engine.execution_context import ExecutionContext
from ezskiros.engine.expansion import Expansions
from ezskiros.engine.task import Task, TaskOutcome, run
from ezskiros.engine.world import World
from ezskiros.runner import FaultyError, prepare
from support.ontologies import HALL

IMPORTS = f"""\
import enum
from ezskiros import (
    CONSUME, INFERRED, LOCK, OPTIONAL, OUTPUT, RESPECT_TYPE, UNSPECIFY, SkillDescription, generated
)
from ezskiros.ontology import load

world = load({str(HALL)!r})
cora, rparts, skiros, sumo = world.cora, world.rparts, world.skiros, world.sumo
"""
PREFIXES = """\
@prefix cora: <http://www.inf.ufrgs.br/phi-group/ontologies/cora.owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix rparts: <http://www.inf.ufrgs.br/phi-group/ontologies/RParts.owl#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
"""


class Clock:
    """Time passes when somebody waits."""

    def __init__(self) -> None:
        self.seconds = 0.0

    def __call__(self) -> float:
        return self.seconds

    def wait(self, seconds: float) -> None:
        self.seconds += seconds


@dataclass
class Ran:
    """The result of a run."""

    outcome: TaskOutcome
    events: list[Event]
    world: World
    clock: Clock
    notes: list[str]

    @property
    def reason(self) -> str:
        return self.outcome.reason.text if self.outcome.reason else ""

    def ends(self) -> list[str]:
        """The ends of all skills in order, as in `Wait#2 failed`."""
        found = (Happened.SUCCEEDED, Happened.FAILED, Happened.PREEMPTED)
        return [
            f"{each.path[-1]} {each.happened.value}"
            for each in self.events
            if each.happened in found
        ]


class FaultyTreeError(AssertionError):
    """A check refuses the skills; the text says why."""


@dataclass
class Skills:
    """Skills of a text, and the scene that they run in."""

    folder: Path
    source: str
    scene: str = ""
    options: dict[str, Any] = field(default_factory=dict)

    def task(self, skill: str, *texts: str) -> tuple[Task, list[Event], Clock]:
        """Prepare a task that can be run."""
        folder = Path(tempfile.mkdtemp(dir=self.folder))  # Python knows modules by their places
        path = folder / "skills.py"
        path.write_text(IMPORTS + self.source, encoding="utf-8")
        scene = folder / "lab.turtle" if self.scene else None
        if scene is not None:
            scene.write_text(PREFIXES + self.scene, encoding="utf-8")
        try:
            ready = prepare(skill, [path], scene, texts)
        except FaultyError as problem:
            found = [f"{each.title} ({each.primary.span})" for each in problem.diagnostics]
            raise FaultyTreeError(found) from None
        events: list[Event] = []
        clock = Clock()
        execution = ExecutionContext(
            ready.library,
            ready.world,
            tell=events.append,
            clock=clock,
            expansions=Expansions(ready.trees),
            **self.options,
        )
        return Task(ready.call, execution), events, clock

    def run(self, skill: str, *texts: str, most_ticks: int = 100) -> Ran:
        """Run a skill. It is stopped after so many ticks."""
        task, events, clock = self.task(skill, *texts)

        def why_stop() -> str | None:
            return "too many ticks" if task.ticks >= most_ticks else None

        outcome = run(task, wait=clock.wait, why_stop=why_stop)
        return Ran(outcome, events, task.execution.world, clock, notes_of(events))


def notes_of(events: Sequence[Event]) -> list[str]:
    """The messages of skills, in order."""
    return [each.text for each in events]
