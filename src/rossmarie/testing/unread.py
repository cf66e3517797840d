"""Fields that tests set although no rule and no other part of a machine reads them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from dslkit.diagnostics import Diagnostic
from dslkit.source import Span
from rossmarie import ir
from rossmarie.ir import EACH, Listed, Path, path_text
from rossmarie.ir.beams import scan_path
from rossmarie.ir.script import FieldValue, Script, ScriptedArrival
from rossmarie.testing.errors import SettingUnread
from rossmarie.testing.scans import FIELDS


def unread(machine: ir.Machine, scripts: Sequence[Script]) -> Iterator[Diagnostic]:
    """A finding for each statement that sets no field that is read. A vector has several fields."""
    fields = read_fields(machine)
    for script in scripts:
        written: dict[Span, list[FieldValue]] = {}
        for event in script.events:
            for setting in event.settings if isinstance(event, ScriptedArrival) else ():
                if setting.span is not None:
                    written.setdefault(setting.span, []).append(setting)
        for span, settings in written.items():
            topic = settings[0].topic
            if not any(_is_read(setting, fields.get(topic, ())) for setting in settings):
                finding = SettingUnread(
                    topic=topic,
                    read=_listed(fields.get(topic, ())),
                    input=settings[0].input,
                )
                yield finding.at(span)


def read_fields(machine: ir.Machine) -> dict[str, list[Path]]:
    """The paths of the fields that a machine reads, by topic."""
    found: dict[str, list[Path]] = {}
    carried = [(each.input, each.path) for each in machine.slots]
    carried += [(each.input, each.path) for each in machine.arrays]
    for used, path in carried:
        topic = machine.channels[machine.inputs[used].channel].topic
        found.setdefault(topic, []).append(path)
    return found


def _is_read(setting: FieldValue, fields: Sequence[Path]) -> bool:
    """Say whether a rule reads the field, a field around it, or a field inside it: an element or
    all of an array, or an angle. An element with a declared name depends on all elements, because
    of the length of the array. A sector depends on all fields of its scan.
    """
    path = tuple(step.place if isinstance(step, Listed) else step for step in setting.path)
    read = (each[:-1] if each and isinstance(each[-1], Listed) else each for each in fields)
    scans = {scan for each in fields if (scan := scan_path(each)) is not None}
    if any(path[: len(scan)] == scan and path[len(scan)] in FIELDS for scan in scans):
        return True
    return any(
        all(step in (other, EACH) for step, other in zip(field, path, strict=False))
        for field in read
    )


def _listed(fields: Sequence[Path]) -> str:
    names = dict.fromkeys(path_text(field) or "data" for field in fields)
    return ", ".join(f"`{name.lstrip('.')}`" for name in names) or "only that it arrives"
