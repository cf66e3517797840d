"""The effects of rules in words: the action, the undoing on release, and possible failures.

The input is a machine that `ir.verify` has accepted. The text follows R4 to R11 and R15 of
`docs/explanation/reactions.md`. Numbers are in the units of the messages that contain them.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from rossmarie import ir
from rossmarie.ir import overruled, reactions
from rossmarie.ir.duration_text import duration_text
from rossmarie.ir.path import path_words
from rossmarie.report.safety.conditions import ConditionWords
from rossmarie.report.safety.numbers import number, quantity
from rossmarie.report.safety.phrase import Phrase, listed


class Effects:
    """The words for each task of one machine."""

    def __init__(self, machine: ir.Machine, conditions: ConditionWords) -> None:
        self._machine = machine
        self._found = machine.reactions
        self._conditions = conditions

    def phrase(self, index: int) -> Phrase:
        """A task, and the escalation after its failure."""
        task = self._found.tasks[index]
        action = self._found.actions[task.action]
        parts = [*self._details(task.effect), *self._waits(index), *self._after(task)]
        text = self._does(task.effect)
        return Phrase(f"{text}{':' if parts else ''}", tuple(parts), task.span, action.name)

    # --- what is done ------------------------------------------------------------------------

    def _does(self, effect: reactions.Effect) -> str:
        match effect:
            case reactions.Limit(topic=topic, bounds=bounds):
                return self._limited(self._found.commands[topic], bounds)
            case reactions.Scale(topic=topic, factor=factor):
                name = self._found.commands[topic].topic
                return f"every number of commands on {name} is multiplied by {number(factor)}"
            case reactions.Publish():
                return self._published(effect)
            case reactions.Retrace():
                return self._retraced(effect)
            case reactions.Log(level=level, text=text):
                return f'"{text}" is logged once ({level.value})'
            case reactions.Diagnose(level=level, text=text):
                return f'the diagnostics show "{text}" ({level.value}) until the rule is released'
            case reactions.Hook(name=name):
                return f"the function {name} is called, and called again when the rule is released"
            case reactions.Reset():
                return "all latched rules are reset whose condition is false at that instant"
            case (
                reactions.Call() | reactions.SetParameter() | reactions.SwitchControllers()
                | reactions.SendGoal() | reactions.CancelGoal()
            ):  # fmt: skip
                return self._awaited(effect)

    def _limited(self, command: reactions.CommandTopic, bounds: tuple[reactions.Bound, ...]) -> str:
        held = {bound.field for bound in bounds if bound.low == 0 == bound.high}
        if len(held) == len(command.fields) and held:
            return f"commands on {command.topic} are held at zero, in all their numbers"
        if not bounds:
            return f"commands on {command.topic} are limited in no field"
        fields = listed(tuple(_bounded(command, bound) for bound in bounds))
        return f"commands on {command.topic} are limited: {fields}"

    def _retraced(self, effect: reactions.Retrace) -> str:
        memory = self._found.memories[effect.memory]
        apart = [f"{memory.apart:g} m"] if memory.apart else []
        apart += [duration_text(memory.apart_ns)] if memory.apart_ns else []
        return (
            f"the last poses are sent back on {effect.topic} ({effect.message_type}), the newest "
            f"first, one every {duration_text(effect.period_ns)}, until the rule is released or "
            f"none is left; at most {memory.most} are kept, at least {listed(tuple(apart))} apart, "
            "of times at which no rule that sends them back was carried out"
        )

    def _published(self, effect: reactions.Publish) -> str:
        how = "once"
        if effect.period_ns is not None:
            how = f"every {duration_text(effect.period_ns)} until the rule is released"
        place = "" if effect.command is None else ", in the place of the commands of others"
        units = {} if effect.command is None else self._units(effect.command)
        kind = f"a {effect.message_type} with {_assigned(effect.assignments, units)}"
        return f"{kind} is published on {effect.topic} {how}{place}"

    def _units(self, command: int) -> dict[reactions.FieldPath, str]:
        return {field.path: field.unit for field in self._found.commands[command].fields}

    def _awaited(self, effect: reactions.Awaited) -> str:
        match effect:
            case reactions.Call(service=service, service_type=kind, assignments=assignments):
                return f"the service {service} ({kind}) is called with {_assigned(assignments)}"
            case reactions.SetParameter(node=node, parameter=parameter, value=value):
                return f"the parameter {node}.{parameter} is set to {_value(value)}"
            case reactions.SwitchControllers(manager=manager, start=start, stop=stop):
                stopped, started = listed(stop) or "nothing", listed(start) or "nothing"
                return f"{manager} stops {stopped} and starts {started}"
            case reactions.SendGoal(server=server, action_type=kind, assignments=assignments):
                goal = f"a goal {kind} with {_assigned(assignments)}"
                return f"the goal at hand of {server} is cancelled, and {goal} is sent"
            case reactions.CancelGoal(server=server):
                return f"the goal of {server} is cancelled, and every later one of others too"

    # --- what goes with it -------------------------------------------------------------------

    def _details(self, effect: reactions.Effect) -> list[Phrase]:
        """Describe the condition for the end of the effect, and the undoing on release."""
        found = []
        if isinstance(effect, reactions.CancelGoal) and effect.confirmation is not None:
            watched = self._conditions.phrase(self._machine.watches[effect.confirmation])
            found.append(Phrase("it counts as done only once this holds as well:", (watched,)))
        if isinstance(effect, reactions.Call):
            found.append(Phrase("done is an answer whose `success`, if it has one, is true"))
        return [*found, *map(Phrase, self._undone(effect))]

    def _undone(self, effect: reactions.Effect) -> list[str]:
        match effect:
            case reactions.Limit(topic=topic, bounds=bounds):
                return _lifted(self._found.commands[topic], bounds)
            case reactions.Scale(ramp=ramp):
                if ramp is None:
                    return ["on release it is lifted at once"]
                return [f"on release the factor grows by {number(ramp)} per second, up to 1"]
            case reactions.SetParameter():
                return ["on release the value that it had is set again"]
            case reactions.SwitchControllers():
                return ["on release the controllers are switched back"]
            case reactions.SendGoal(interrupted=interrupted):
                return [f"on release it is cancelled if it still runs{_resent(interrupted)}"]
            case reactions.CancelGoal(interrupted=interrupted):
                return [f"on release goals pass again{_resent(interrupted)}"]
            case (
                reactions.Publish() | reactions.Retrace() | reactions.Call() | reactions.Log()
                | reactions.Diagnose() | reactions.Hook() | reactions.Reset()
            ):  # fmt: skip
                return []

    # --- what can go wrong -------------------------------------------------------------------

    def _after(self, task: reactions.Task) -> list[Phrase]:
        """Describe the escalation after a failure."""
        followers = tuple(self.phrase(other) for other in task.otherwise)
        if not overruled.can_fail(task):
            text = "it cannot fail, so this never starts:"
            return [Phrase(text, followers)] if followers else []
        if overruled.fails_at_once(task):
            stale = f"if it loses {self._needed(task)} to another rule, this starts:"
            return [Phrase(stale, followers)]
        causes = self._causes_of_failure(task)
        if followers:
            return [
                Phrase(f"if it {causes}, the rule goes no further, and this starts:", followers)
            ]
        return [Phrase(f"if it {causes}, the rule goes no further; nothing else is tried")]

    def _causes_of_failure(self, task: reactions.Task) -> str:
        timeout_ns = reactions.timeout_ns(task.effect)
        causes: list[str] = []
        if timeout_ns is not None:
            causes += ["is refused", f"is not done within {duration_text(timeout_ns)}"]
        if task.resource is not None and not reactions.waits(task.effect):
            causes.append(f"loses {self._needed(task)} to another rule")
        return listed(tuple(causes), "or") or "fails"

    def _waits(self, index: int) -> list[Phrase]:
        """Describe the task while another rule has its resource, if it waits for the resource."""
        task = self._found.tasks[index]
        timeout_ns = reactions.timeout_ns(task.effect)
        rivals = self._rivals(index)
        if timeout_ns is None or not reactions.waits(task.effect) or not rivals:
            return []
        unless = ""
        if reactions.confirmation(task.effect) is not None:
            unless = ", unless the condition above holds"
        elif any(overruled.does_the_same(self._found, index, rule) for rule in rivals):
            unless = ", unless that rule does the same, and has done it"
        return [
            Phrase(
                f"while another rule has {self._needed(task)} it waits, and starts afterwards; "
                f"after {duration_text(timeout_ns)} it counts as failed{unless}"
            )
        ]

    def _rivals(self, index: int) -> list[int]:
        """The other rules that need the same resource."""
        resource = self._found.tasks[index].resource
        return [
            rule
            for rule, plan in enumerate(self._found.plans)
            if index not in plan.tasks
            and any(self._found.tasks[other].resource == resource for other in plan.tasks)
        ]

    def _needed(self, task: reactions.Task) -> str:
        assert task.resource is not None, "only what needs something can lose it"
        return self._found.resources[task.resource]


def _bounded(command: reactions.CommandTopic, bound: reactions.Bound) -> str:
    field = command.fields[bound.field]
    each = "each of " if field.is_array else ""
    high = quantity(bound.high, field.unit)
    return f"{each}{path_words(field.path)} from {number(bound.low)} to {high}"


def _lifted(command: reactions.CommandTopic, bounds: tuple[reactions.Bound, ...]) -> list[str]:
    """Describe the lifting of each bound. Bounds that are lifted alike are described together."""
    fields_by_bound: dict[str, list[str]] = {}
    for bound in bounds:
        field = command.fields[bound.field]
        ramp = bound.ramp
        how = "lifted at once"
        if ramp is not None:
            how = f"moved apart by {quantity(ramp, field.unit)} per second"
        fields_by_bound.setdefault(how, []).append(path_words(field.path))
    if len(fields_by_bound) == 1:
        return [f"on release the bounds are {how}" for how in fields_by_bound]
    return [
        f"on release the bounds of {listed(tuple(of))} are {how}"
        for how, of in fields_by_bound.items()
    ]


def _resent(interrupted: reactions.Interrupted) -> str:
    match interrupted:
        case reactions.Interrupted.RESEND:
            return ", and the goal that was interrupted is sent again"
        case reactions.Interrupted.DROP:
            return "; the goal that was interrupted is dropped"


def _assigned(
    assignments: tuple[reactions.Assignment, ...],
    units: Mapping[reactions.FieldPath, str] = MappingProxyType({}),
) -> str:
    """Describe the new values of the fields of a message, with the known units."""
    fields = tuple(
        f"{path_words(each.path)} = {_values(each.value)} {units.get(each.path, '')}".rstrip()
        for each in assignments
    )
    return listed(fields) or "all fields at zero, false or empty"


def _values(value: reactions.Scalar | tuple[reactions.Scalar, ...]) -> str:
    if isinstance(value, tuple):
        return f"[{', '.join(map(_value, value))}]"
    return _value(value)


def _value(value: reactions.Scalar) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return f'"{value}"' if isinstance(value, str) else number(value)
