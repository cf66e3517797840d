"""The context of a task: which of its skills run, told ten times a second."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from ezskiros.engine.events import Event, Happened
from heron import messages
from heron.messages import Message
from heron.skills import EXPORT
from heron.tasks.skill_task import SkillTask
from heron.topics import SKILL_CONTEXT, Carrier

_ENDS = (Happened.SUCCEEDED, Happened.FAILED, Happened.PREEMPTED)


class _Running(NamedTuple):
    """A skill that runs: its description, which call of it this is, and since when (s)."""

    skill: str
    goal: str
    since: float


class SkillContext:
    """Publishes it, as long as the task is there."""

    period_ns = 100_000_000

    def __init__(self, carrier: Carrier, task: SkillTask) -> None:
        self._publish = carrier.publisher(SKILL_CONTEXT)
        self._task = task
        self._digest = str(json.loads(EXPORT.read_text(encoding="utf-8"))["digest"])

    def tick(self, now_ns: int) -> None:
        """Say which skills run."""
        message = messages.new_message(SKILL_CONTEXT.type)
        message.header.stamp = messages.instant(now_ns)
        message.digest = self._digest
        message.running = [_told(one) for one in running_of(self._task.events)]
        self._publish(message)


def running_of(events: Iterable[tuple[float, Event]]) -> Iterator[_Running]:
    """The skills that run after these events, those above others first."""
    found: dict[tuple[str, ...], _Running] = {}
    calls: Counter[tuple[str, ...]] = Counter()
    for at_s, event in events:
        if event.happened is Happened.STARTED:
            calls[event.path] += 1
            goal = f"{'/'.join(event.path)}@{calls[event.path]}"
            found[event.path] = _Running(event.skill, goal, at_s)
        elif event.happened in _ENDS:
            found.pop(event.path, None)
    yield from found.values()


def _told(one: _Running) -> Message:
    message = messages.new_message("skill_context_msgs/RunningSkill")
    message.skill, message.goal = one.skill, one.goal
    message.since = messages.instant(round(one.since * 1e9))
    return message
