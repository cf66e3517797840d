"""The places of the parts of a machine in the generated C: names and numbers, without meanings.

The input is a machine. The proofs read nothing else from the generator. This module states which
member of memory belongs to which part. The required content of the member follows from the machine,
in other modules. `layout.py` rejects places if a part has none, or if two parts share one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from rossmarie.core import AnyFunction, Sampling
from rossmarie.core.expressions import Subfunction
from rossmarie.ir import model as ir
from rossmarie.targets import formulas
from rossmarie.targets.c99 import layout as generated
from rossmarie.targets.c99.coverage import covered_values
from rossmarie.targets.c99.state import members
from rossmarie.targets.c99.types import fields_of


@dataclass(frozen=True)
class WatchedGuard:
    """A guard: its number, its propositions, and its number of limits."""

    value: int
    leaves: tuple[int, ...]
    limit_count: int


@dataclass(frozen=True)
class MachinePlaces:
    """The places of one machine.

    `remarks` describe each number to readers. `kept_raw` are the numbers that may be kept as
    received until a guard reads them. Names of fields are listed by slot and by array.
    """

    name: str
    remarks: tuple[str, ...]
    value_of_slot: tuple[int, ...]
    value_of_signal: Mapping[int, int]
    value_of_test: Mapping[int, int]
    node_of_proposition: Mapping[int, int]
    guards: tuple[WatchedGuard, ...]
    held: tuple[int, ...]
    sinces: tuple[int, ...]
    oscillations: tuple[int, ...]
    recurring: tuple[int, ...]
    sampled: tuple[int, ...]
    windows: tuple[tuple[int, int], ...]
    kept_raw: frozenset[int]
    members: tuple[str, ...]
    channel_names: tuple[str, ...]
    slot_names: Mapping[int, str]
    array_names: Mapping[int, str]
    list_names: Mapping[int, str]


def places_of(machine: ir.Machine) -> MachinePlaces:
    """Read the places from the layout of the generator."""
    found = generated.lay_out(machine)
    fields = [
        each for channel in range(len(machine.channels)) for each in fields_of(machine, channel)
    ]
    return MachinePlaces(
        name=found.name,
        remarks=tuple(value.remark for value in found.values),
        value_of_slot=found.value_of_slot,
        value_of_signal=found.value_of_signal,
        value_of_test=found.value_of_test,
        node_of_proposition=found.node_of_proposition,
        guards=tuple(
            WatchedGuard(guard.value, tuple(guard.leaves), len(guard.limits))
            for guard in found.guards
        ),
        held=found.held,
        sinces=found.sinces,
        oscillations=found.oscillations,
        recurring=found.recurring,
        sampled=found.sampled,
        windows=found.windows,
        kept_raw=covered_values(found),
        members=tuple(members(found)),
        channel_names=found.channel_names,
        slot_names={each.slot: each.name for each in fields if each.slot is not None},
        array_names={each.array: each.name for each in fields if each.array is not None},
        list_names={
            its_list: each.count.removesuffix("_count")
            for each in fields
            if each.count is not None
            and each.array is not None
            and (its_list := machine.arrays[each.array].list) is not None
        },
    )


def name_of(machine: ir.Machine) -> str:
    """The prefix of the names of all public functions."""
    return generated.lay_out(machine).name


def function_of(function: AnyFunction, count: int) -> str:
    """The C function that computes a function of numbers."""
    return formulas.definition_of(function, count).name


def function_of_subfunction(function: Subfunction) -> str:
    """The C function that computes a subfunction."""
    return formulas.definition_of_subfunction(function).name


def function_of_samples(function: Sampling) -> str | None:
    """The C function that computes a function of samples; None if the C computes it in place."""
    found = formulas.definition_of_samples(function)
    return None if found.is_inline else found.name
