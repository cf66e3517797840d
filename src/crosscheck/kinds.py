"""The numbers that a permission limits, by their dimension."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import z3

from rossmarie.analysis.state import ArbitraryState
from rossmarie.analysis.terms import NO
from rossmarie.ir import Constant, Machine, compared_signals, reachable_propositions
from rossmarie.skills import Permission, PermissionLimit, Skill
from rossmarie.units import UnknownUnitError, parse_unit


@dataclass(frozen=True)
class BehaviorKind:
    """A kind of permitted behavior: its name, the permissions of this kind, the units of its
    numbers, and an example. For a closeness, a smaller number is more permissive.
    """

    words: str
    permissions: tuple[str, ...]
    units: tuple[str, ...]
    example: str
    is_least: bool = False


KINDS = (
    BehaviorKind("contact", ("contact", "force"), ("N", "Nm"), "contact(Object)"),
    BehaviorKind("closeness", ("closeness",), ("m",), 'closeness(Object, "10 cm")', is_least=True),
    BehaviorKind("speed", ("speed",), ("m/s", "rad/s"), 'speed("0.2 m/s")'),
)


def signals_of(machine: Machine, rule: int, kind: BehaviorKind) -> tuple[int, ...]:
    """The numbers of a kind that the condition of a rule compares, without constants."""
    return tuple(
        signal
        for signal in compared_by(machine, rule)
        if dimension_of(machine.signals[signal].unit) in {dimension_of(each) for each in kind.units}
    )


def compared_by(machine: Machine, rule: int) -> Iterator[int]:
    """The numbers that the condition of a rule compares."""
    seen: dict[int, None] = {}
    for proposition in reachable_propositions(machine, machine.rules[rule].condition):
        for signal in compared_signals(machine.propositions[proposition].node):
            if not isinstance(machine.signals[signal].node, Constant):
                seen[signal] = None
    yield from seen


def dimension_of(unit: str) -> str | None:
    """The dimension of a unit, in words; None if it has none."""
    try:
        return str(parse_unit(unit).dimension)
    except UnknownUnitError:
        return None


def permissions_of(skill: Skill, kind: BehaviorKind) -> tuple[Permission, ...]:
    """The permissions of a kind."""
    return tuple(each for each in skill.permits if each.kind in kind.permissions)


def widest(
    permissions: Sequence[Permission], kind: BehaviorKind
) -> tuple[Permission, PermissionLimit] | None:
    """The most permissive permission among those with a limit."""
    limited = [(each, each.limit) for each in permissions if each.limit is not None]
    sign = -1.0 if kind.is_least else 1.0
    return max(limited, key=lambda each: sign * each[1].si, default=None)


def is_beyond(
    state: ArbitraryState, signals: Sequence[int], limit: PermissionLimit, kind: BehaviorKind
) -> z3.BoolRef:
    """The fact that one of some numbers is known and beyond the limit."""
    return z3.Or(NO, *(_beyond(state, signal, limit, kind) for signal in signals))


def is_within(
    state: ArbitraryState, signals: Sequence[int], limit: PermissionLimit, kind: BehaviorKind
) -> z3.BoolRef:
    """The fact that all of some numbers are known and within the limit."""
    known = [state.signal(signal).known for signal in signals]
    return z3.And(*known, z3.Not(is_beyond(state, signals, limit, kind)))


def _beyond(
    state: ArbitraryState, signal: int, limit: PermissionLimit, kind: BehaviorKind
) -> z3.BoolRef:
    number = state.signal(signal)
    end = z3.RealVal(repr(limit.si))
    return z3.And(number.known, number.value < end if kind.is_least else number.value > end)


def by_dimension(
    signals: Sequence[int], machine: Machine, limit: PermissionLimit
) -> tuple[int, ...]:
    """The signals that can be compared with a limit."""
    wanted = dimension_of(limit.unit)
    return tuple(each for each in signals if dimension_of(machine.signals[each].unit) == wanted)
