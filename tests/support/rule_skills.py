"""Skills files for rules: those of the fixtures, which examples in the documentation name; and
robots that run these skills.
"""

from __future__ import annotations

import json
import shutil
from dataclasses import replace
from pathlib import Path
from typing import Any

from rossmarie import ir
from rossmarie.interpreter import Interpreter
from rossmarie.ir.skills import RunningSkill, SkillArgument, SkillContext, answer
from support.compiled import machine_of

FOLDER = Path(__file__).parents[1] / "fixtures" / "skills"
FILE = FOLDER / "skills.json"
DIGEST = "5b" * 32
"""The digest of that file."""
HEAD = f"""
skills "{FILE}" timeout 1 sec;
action stop;
action slow;
input force = topic /force : std_msgs/Float32 in N;
"""
"""Rules about these skills, and about a force that is never stale."""


def put_skills(folder: Path) -> None:
    """Copy all skills files into a folder."""
    for file in FOLDER.glob("*.json"):
        shutil.copy(file, folder)


def content() -> dict[str, Any]:
    """The contents of the file, to be changed."""
    found: dict[str, Any] = json.loads(FILE.read_text(encoding="utf-8"))
    return found


def running(skill: str, **individuals: str) -> RunningSkill:
    """A skill that runs, with the classes of its individuals."""
    return RunningSkill(
        skill, tuple(SkillArgument(name, type=t) for name, t in individuals.items())
    )


def ahead(skill: str, **individuals: str) -> RunningSkill:
    """A skill that can start next, with the classes of its individuals that are known."""
    return replace(running(skill, **individuals), is_ahead=True)


class Robot:
    """A robot with rules over `HEAD`, which tells of a force and of the skills that it runs."""

    def __init__(self, rules: str, machine: ir.Machine | None = None) -> None:
        self.machine = machine or machine_of(HEAD + rules)
        self.monitor = Interpreter(self.machine)

    def tell(
        self,
        at_s: float,
        *skills: RunningSkill,
        force: float | None = None,
        digest: str = DIGEST,
        is_ahead_known: bool = True,
    ) -> tuple[ir.Event, ...]:
        """A message that tells which skills run and can start next, and with `force` one of that as
        well.
        """
        context = replace(SkillContext.of(digest, skills), is_ahead_known=is_ahead_known)
        messages = {self._channel("/skill_context"): self._answers(context)}
        if force is not None:
            messages |= self._force(force)
        return tuple(self.monitor.update(_ns(at_s), messages))

    def feel(self, at_s: float, force: float) -> None:
        """A message about the force alone."""
        self.monitor.update(_ns(at_s), self._force(force))

    def wait(self, at_s: float) -> tuple[ir.Event, ...]:
        """Let time pass."""
        return tuple(self.monitor.advance(_ns(at_s)))

    def active(self) -> set[str]:
        """The rules that are active."""
        pairs = zip(self.machine.rules, self.monitor.active, strict=True)
        return {rule.name for rule, is_active in pairs if is_active}

    def _force(self, force: float) -> dict[int, ir.ChannelValues]:
        channel = self._channel("/force")
        slots = [n for n, slot in enumerate(self.machine.slots) if self._of(slot) == channel]
        return {channel: ir.ChannelValues(dict.fromkeys(slots, force), {})}

    def _answers(self, context: SkillContext) -> ir.ChannelValues:
        slots = {
            number: answer(slot.path[0], context)
            for number, slot in enumerate(self.machine.slots)
            if isinstance(slot.path[0], ir.Doing | ir.Quantity)
        }
        return ir.ChannelValues(slots, {})

    def _of(self, slot: ir.Slot) -> int:
        return self.machine.inputs[slot.input].channel

    def _channel(self, topic: str) -> int:
        topics = [channel.topic for channel in self.machine.channels]
        return topics.index(topic)


def _ns(seconds: float) -> int:
    return round(seconds * 1e9)
