"""Scripts as text in the rules language. The formatter makes the layout canonical.

Every number is written so that it is read as the same double in SI. The shortest such number in its
unit is used, if there is one.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence

from rossmarie import ir
from rossmarie.ir.script import Expectation, FieldValue, Script, ScriptedArrival, ScriptedReset
from rossmarie.testing.findings import seconds
from rossmarie.units import DIMENSIONLESS, Unit, parse_unit

Bases = Mapping[str, ir.Path]
"""The path that the declaration of each input selects, by the name of the input."""


def own_name(name: str, seen: Counter[str]) -> str:
    """A name that no other test has, and that can be written in quotes."""
    plain = name.replace('"', "'")
    seen[plain] += 1
    return plain if seen[plain] == 1 else f"{plain} ({seen[plain]})"


def write_script(machine: ir.Machine, script: Script, bases: Bases) -> str:
    """The text of one test."""
    lines = [f'test "{script.name}" {{']
    for event in script.events:
        if isinstance(event, ScriptedReset):
            rule = "" if event.rule is None else f" {machine.rules[event.rule].name}"
            lines.append(f"at {seconds(event.at_ns)} reset{rule};")
        else:
            lines.append(f"{_times(event)} {', '.join(_sent(machine, event, bases))};")
    lines += [_expected(machine, expected) for expected in script.expectations]
    return "\n".join([*lines, "}"])


def _times(event: ScriptedArrival) -> str:
    first = seconds(event.first_ns)
    if event.period_ns is None:
        return f"at {first}"
    return f"every {seconds(event.period_ns)} from {first} to {seconds(event.last_ns)}"


def _expected(machine: ir.Machine, expected: Expectation) -> str:
    state = "active" if expected.is_active else "inactive"
    words = f"expect {machine.rules[expected.rule].name} {state}"
    if expected.first_ns == expected.last_ns:
        return f"{words} at {seconds(expected.first_ns)};"
    is_open = expected.last_ns % 1000 == 999  # one nanosecond before something happens
    last = (
        f"until {seconds(expected.last_ns + 1)}" if is_open else f"to {seconds(expected.last_ns)}"
    )
    return f"{words} from {seconds(expected.first_ns)} {last};"


def _sent(machine: ir.Machine, event: ScriptedArrival, bases: Bases) -> Iterator[str]:
    set_inputs = {setting.input for setting in event.settings}
    yield from (name for name in event.inputs if name not in set_inputs)
    for setting in event.settings:
        yield f"{_field(setting, bases)} = {_value(machine, setting)}"
    if event.running is not None:
        yield event.running.text


def _field(setting: FieldValue, bases: Bases) -> str:
    base = bases[setting.input]
    is_sector = isinstance(setting.path[-1], ir.Sector)
    if is_sector and base[-1:] in ((str(ir.RETURNS),), (str(ir.INVALID),)):
        base = base[:-1]  # readings beside these set the points
    is_header = setting.path[:1] == ("header",) and base[:1] not in ((), ("header",))
    steps = setting.path if is_header else setting.path[len(base) :]
    text = f"{setting.input}{ir.path_text(steps)}"
    return text if setting.angle is None else f"{text}.{setting.angle}"


def _value(machine: ir.Machine, setting: FieldValue) -> str:
    value = setting.value
    if isinstance(value, bool):
        return _word(value)
    if isinstance(value, str):
        return f'"{value}"'
    unit = _unit(machine, setting)
    symbol = "" if unit == DIMENSIONLESS else f" {unit.symbol}"
    if isinstance(value, tuple):
        numbers = ", ".join(_element(each, unit) for each in value)
        nothing = "[]" if _is_list(machine, setting) else "unknown"
        return f"[{numbers}]{symbol}" if value else nothing
    return "unknown" if value is None or math.isnan(value) else f"{_number(value, unit)}{symbol}"


def _unit(machine: ir.Machine, setting: FieldValue) -> Unit:
    if setting.unit:
        return parse_unit(setting.unit)
    if setting.angle is not None:
        return parse_unit("deg")
    fields: Sequence[ir.Slot | ir.Array] = (*machine.slots, *machine.arrays)
    found = [
        each.unit
        for each in fields
        if _leads_to(each.path, setting.path) and _topic(machine, each) == setting.topic
    ]
    return parse_unit(found[0]) if found and found[0] else DIMENSIONLESS


def _leads_to(path: ir.Path, written: ir.Path) -> bool:
    """Say whether a path, in which `EACH` stands for any element, is the path of a setting."""
    return len(path) == len(written) and all(
        step in (other, ir.EACH) for step, other in zip(path, written, strict=True)
    )


def _is_list(machine: ir.Machine, setting: FieldValue) -> bool:
    lists = [(_topic(machine, each), each.path) for each in machine.lists]
    return (setting.topic, setting.path) in lists


def _topic(machine: ir.Machine, field: ir.Slot | ir.Array | ir.List) -> str:
    return machine.channels[machine.inputs[field.input].channel].topic


def _element(value: float | bool, unit: Unit) -> str:
    return _word(value) if isinstance(value, bool) else _number(value, unit)


def _word(value: bool) -> str:
    return "true" if value else "false"


def _number(value: float, unit: Unit) -> str:
    shown = unit.from_si(value)
    for digits in range(17):
        text = f"{shown:.{digits}f}"
        if unit.to_si(float(text)) == value:
            return text
    return f"{shown!r}"
