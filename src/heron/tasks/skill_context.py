"""The context of a task: its running skills. It is published ten times per second, and at once when
a skill starts or ends.
"""

from __future__ import annotations

from typing import Any

from ezskiros.context.snapshot import RunningSkill, SkillAhead, SkillArgument, Snapshots
from heron import messages
from heron.messages import Message
from heron.skills.exported import digest
from heron.tasks.skill_task import SkillTask
from heron.topics import SKILL_CONTEXT, Carrier

_PACKAGE = "skill_context_msgs"


class SkillContextPublisher:
    """Publishes the context of a task while the task exists."""

    period_ns = 100_000_000

    def __init__(self, carrier: Carrier, task: SkillTask) -> None:
        """Raises `ValueError` if the export of the skills is none."""
        self._publish = carrier.publisher(SKILL_CONTEXT)
        self._task = task
        self._snapshots = Snapshots(digest())
        self._goals: dict[str, str] = {}
        task.running.changed = lambda: self._tell(task.now_ns)

    def tick(self, now_ns: int) -> None:
        """Say which skills run."""
        self._tell(now_ns)

    def _tell(self, now_ns: int) -> None:
        snapshot = self._snapshots.of(self._task.running, self._task.ahead)
        message = _new(
            "SkillContext",
            header=messages.header(now_ns, ""),
            digest=snapshot.digest,
            running=[self._skill(each) for each in snapshot.running],
            ahead=[_ahead(each) for each in snapshot.ahead or ()],
            is_ahead_known=snapshot.ahead is not None,
        )
        self._publish(message)

    def _skill(self, found: RunningSkill) -> Message:
        """Its goal gets a name that is the same in each run of an episode."""
        goal = self._goals.setdefault(found.goal, str(len(self._goals) + 1))
        since = messages.instant(round(found.since * 1e9))
        permits = [
            _new("SkillPermission", kind=each.kind, type=each.type, limit=each.limit)
            for each in found.permits
        ]
        arguments = list(map(_argument, found.arguments))
        return _new(
            "RunningSkill",
            skill=found.skill,
            goal=goal,
            since=since,
            arguments=arguments,
            permits=permits,
        )


def _ahead(found: SkillAhead) -> Message:
    return _new("SkillAhead", skill=found.skill, arguments=list(map(_argument, found.arguments)))


def _argument(found: SkillArgument) -> Message:
    properties = [
        _new("SkillProperty", property=each.property, number=each.number)
        for each in found.properties
    ]
    return _new(
        "SkillArgument",
        parameter=found.parameter,
        value=found.value,
        type=found.type,
        number=found.number,
        properties=properties,
    )


def _new(name: str, **fields: Any) -> Message:
    return messages.message_class(f"{_PACKAGE}/{name}")(**fields)
