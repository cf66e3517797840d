"""The generated guard node as seen from outside: state, verdicts, and filtered commands."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from heron.guard import Occurrence, unfiltered, waiting
from heron.messages import Message
from heron.ros1.node import Ros1Node, Service, text
from heron.topics import InProcess, Topic
from rossmarie.ir import Machine, TaskCommandKind
from rossmarie.ir.reactions import Publish

_IN_FORCE = ("running", "holding")
_BEGUN = (*_IN_FORCE, "done")
_WORDS = ("cleared", "activated", "activated")


class Ros1Guard:
    """`announce` is called before an operator's word goes out into ROS."""

    period_ns = 1_000_000_000

    def __init__(
        self, machine: Machine, node: Ros1Node, carrier: InProcess, announce: Callable[[], None]
    ) -> None:
        self._machine, self._node, self._announce = machine, node, announce
        self._name = name_of(machine)
        self.active: tuple[str, ...] = ()
        self.is_acting = False
        self.occurrences: list[Occurrence] = []
        self.reported: list[tuple[int, str]] = []
        self._begun: set[tuple[str, str, str]] = set()
        self._wanted: dict[str, Message] = {}
        self._passed: dict[str, Message] = {}
        node.subscribe(f"{self._name}/state", "*", self._hear_state)
        node.subscribe(f"{self._name}/verdicts", "*", self._hear_verdict)
        self._owed: set[str] = set()
        self._taking = _taking(machine)
        for command in machine.reactions.commands:
            source = Topic(unfiltered(command.topic), command.message_type)
            carrier.subscribe(source, partial(self._want, command.topic))
            filtered = Topic(command.topic, command.message_type)
            carrier.subscribe(filtered, partial(self._pass, command.topic))
        self._reset: Service | None = None
        self._is_commanding = False
        self.has_begun = False
        """True once it has reported anything of itself."""

    @property
    def latched(self) -> tuple[str, ...]:
        """The active rules that wait for an operator."""
        return waiting(self._machine, self.active)

    @property
    def is_restricting(self) -> bool:
        """True while the last command on a topic differs from the command of the program."""
        return any(self._wanted.get(topic) != passed for topic, passed in self._passed.items())

    @property
    def owes(self) -> bool:
        """True while it has let nothing pass for a command of a program, as it does while no rule
        commands.
        """
        return bool(self._owed) and not self._is_commanding

    def reset(self) -> None:
        """An operator resets all latched rules."""
        self._announce()
        self._reset = self._reset or self._node.service(f"{self._name}/reset")
        self._reset.call(text(""))  # no rule is named, so reset all

    def close(self) -> None:
        """No further operator comes."""
        if self._reset is not None:
            self._reset.close()

    def tick(self, now_ns: int) -> None:
        """The guard has its own clock."""

    def _want(self, topic: str, command: Message) -> None:
        self._wanted[topic] = command
        self._owed.add(topic)

    def _pass(self, topic: str, command: Message) -> None:
        self._passed[topic] = command
        self._owed.discard(topic)

    def _hear_state(self, state: Message) -> None:
        self.has_begun = True
        self.active = tuple(state.active)
        in_force = {(task.rule, task.action) for task in state.tasks if task.state in _IN_FORCE}
        self.is_acting = bool(in_force)
        self._is_commanding = bool(in_force & self._taking)
        begun = {
            (task.rule, task.action, task.effect) for task in state.tasks if task.state in _BEGUN
        }
        at_ns = _nanoseconds(state.at)
        self.occurrences += [
            Occurrence(at_ns, rule, action, TaskCommandKind.START)
            for rule, action, _ in sorted(begun - self._begun)
        ]
        self._begun = begun

    def _hear_verdict(self, verdict: Message) -> None:
        change = _WORDS[verdict.change] if verdict.rule else "time jumped back"
        self.reported.append(
            (_nanoseconds(verdict.at), f"{verdict.rule} {change}: {verdict.cause}".lstrip())
        )


def name_of(machine: Machine) -> str:
    """The node that is generated for rules, as its launch file calls it."""
    return f"/{machine.name}_safety"


def _taking(machine: Machine) -> set[tuple[str, str]]:
    """Rules and actions that replace the commands of the programs."""
    reactions = machine.reactions
    return {
        (machine.rules[rule].name, reactions.actions[reactions.tasks[task].action].name)
        for rule, plan in enumerate(reactions.plans)
        for task in plan.tasks
        if isinstance(effect := reactions.tasks[task].effect, Publish)
        and effect.command is not None
        and effect.period_ns is not None
    }


def _nanoseconds(time: Message) -> int:
    return int(time.sec) * 1_000_000_000 + int(time.nanosec)
