"""The fields that messages in tests set, and their values."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from dslkit.diagnostics import Diagnostic, Remark
from rossmarie.check.actions.whole_numbers import is_whole
from rossmarie.check.expressions.infer import infer
from rossmarie.check.model import CheckedInput
from rossmarie.check.names.fields import members, select, unit_of
from rossmarie.check.names.parts import MessagePart, part_at
from rossmarie.check.operations.indexes import element_of, no_element
from rossmarie.check.operations.operands import require_constant
from rossmarie.check.operations.sectors import checked_sector, report_no_sectors
from rossmarie.check.scopes.context import Context
from rossmarie.check.tests.errors import NotSettable, SettingMismatch, UnknownTestInput
from rossmarie.check.units.errors import MisplacedUnit
from rossmarie.check.units.quantities import ANGLE, read_unit
from rossmarie.check.wording.describe import describe, is_plain
from rossmarie.ir.path import Path, Sector
from rossmarie.ir.script import FieldValue, SettingValue
from rossmarie.syntax import ast
from rossmarie.types import (
    Array,
    Boolean,
    List,
    Message,
    Quantity,
    Quaternion,
    Text,
    Type,
    Unknown,
    Vector,
    message_value,
)
from rossmarie.units import DIMENSIONLESS, Unit, parse_unit

Step: TypeAlias = ast.Name | ast.Position | ast.Arc
_ANGLES = ("roll", "pitch", "yaw")
_RADIANS = Quantity(parse_unit("rad"))


def settings_of(written: Sequence[ast.Setting], context: Context) -> tuple[FieldValue, ...] | None:
    """The settings of messages; None after reporting an error. A vector is set component by
    component.
    """
    found: list[FieldValue] = []
    is_right = True
    for setting in written:
        checked = _SettingChecker(setting, context).check()
        is_right = is_right and checked is not None
        found += checked or ()
    return tuple(found) if is_right else None


class _SettingChecker:
    """Checks one setting."""

    def __init__(self, setting: ast.Setting, context: Context) -> None:
        self._setting = setting
        self._context = context
        self._text = setting.path.span.text

    def check(self) -> tuple[FieldValue, ...] | None:
        """The settings; None after reporting an error."""
        type_ = self._input_type()
        if type_ is None or isinstance(type_, Unknown):
            if isinstance(self._setting.value, ast.Bracket):
                return None
            if self._setting.value is not None:
                infer(self._setting.value, self._context)
            return None
        found = self._field(type_)
        if found is None:
            return None
        type_, path, angle = found
        if isinstance(type_, List) and type_.is_of_beams and self._sets():
            self._report_whole(type_)
            return None
        if self._setting.is_unknown:
            return self._unknown(type_, path, angle)
        if self._setting.value is None:
            return () if len(self._setting.path.steps) == 1 else self._without_value()
        is_sector = bool(path) and isinstance(path[-1], Sector)
        is_each = is_sector and not isinstance(self._setting.value, ast.Bracket)
        value = self._value(self._setting.value, _each_of(type_) if is_each else type_)
        if value is None:
            return None
        if isinstance(type_, Vector) and isinstance(value, tuple):
            parts = zip("xyz", value, strict=True)
            return tuple(self._made((*path, name), number, None) for name, number in parts)
        return (self._made(path, value, angle),)

    def _sets(self) -> bool:
        return self._setting.is_unknown or self._setting.value is not None

    def _made(self, path: Path, value: SettingValue, angle: str | None) -> FieldValue:
        name = self._setting.path.steps[0]
        assert isinstance(name, ast.Name)
        topic = self._context.reported[name.text].topic
        return FieldValue(name.text, topic, path, value, angle, span=self._setting.span)

    # --- fields ------------------------------------------------------------------------------

    def _input_type(self) -> Type | None:
        name = self._setting.path.steps[0]
        assert isinstance(name, ast.Name)
        found = self._context.reported.get(name.text)
        if found is not None:
            return found.type
        if self._context.declarations.is_whole:
            finding = UnknownTestInput(identifier=name.text)
            self._context.report_unknown(finding, name, self._context.reported)
        return None

    def _field(self, type_: Type) -> tuple[Type, Path, str | None] | None:
        """The type of the field, the path from the message, and the angle; None after reporting an
        error.
        """
        first, *rest = self._setting.path.steps
        assert isinstance(first, ast.Name)
        used = self._context.reported[first.text]
        if _names_header(rest, type_):
            type_, part = self._message(used, type_)
        else:
            type_, part = self._whole_scan(used, type_, rest)
        text, before = first.text, first.span
        for step in rest:
            if isinstance(step, ast.Arc):
                sector = self._sector(step, type_, text)
                return None if sector is None else (type_, part.sector(sector).path, None)
            if isinstance(type_, List) and type_.is_of_beams:
                self._report_whole(type_)
                return None
            if isinstance(step, ast.Position):
                element = _element_of(type_, step.index)
                if element is None:
                    self._add(no_element(type_, step.index, step.span, text, step.span))
                    return None
                type_, part = element, part.element(step.index, type_)
                continue
            if isinstance(type_, Quaternion) and step.text in _ANGLES and step is rest[-1]:
                return _RADIANS, part.path, step.text
            found = members(type_).get(step.text)
            if found is None:
                found = select(type_, step, text, before, self._context.collector)
            if isinstance(found, Unknown):
                return None
            type_, text, before = found, f"{text}.{step.text}", step.span
            part = part.field(step.text, type_)
        return type_, part.path, None

    def _sector(self, arc: ast.Arc, type_: Type, text: str) -> Sector | None:
        infer(arc.first, self._context)
        infer(arc.last, self._context)
        if isinstance(type_, Array) and type_.has_sectors:
            return checked_sector(arc, self._context)
        report_no_sectors(type_, arc, text, self._context)
        return None

    def _whole_scan(
        self, used: CheckedInput, type_: Type, steps: Sequence[Step]
    ) -> tuple[Type, MessagePart]:
        """The scan, if a setting names a field of the scan outside the part that the input reads:
        readings of a scan depend on all of its fields.
        """
        first = steps[0] if steps else None
        is_of_beams = isinstance(type_, List) and type_.is_of_beams
        is_of_scan = is_of_beams or (isinstance(type_, Array) and type_.has_sectors)
        messages = self._context.messages
        if is_of_scan and isinstance(first, ast.Name) and messages is not None:
            scan: Type | None = messages.find(used.message_type)
            for name in used.path[:-1]:
                scan = None if scan is None else members(scan).get(name)
            if scan is not None:
                return scan, MessagePart(used.path[:-1])
        return type_, part_at(used.base, type_)

    def _message(self, used: CheckedInput, type_: Type) -> tuple[Type, MessagePart]:
        """The whole message of an input, and the start of the path in it. A number of a skill has
        no message.
        """
        messages = self._context.messages
        found = None if messages is None else messages.find(used.message_type)
        if found is None or used.query is not None:
            return type_, part_at(used.base, type_)
        whole = message_value(found)
        return whole, part_at((), whole)

    def _unknown(self, type_: Type, path: Path, angle: str | None) -> tuple[FieldValue, ...] | None:
        parts = "xyz" if isinstance(type_, Vector) else "xyzw"
        if angle is not None or isinstance(type_, Vector | Quaternion):
            return tuple(self._made((*path, part), None, None) for part in parts)
        if isinstance(type_, Message):
            self._report_whole(type_)
            return None
        if isinstance(type_, Array) and not isinstance(path[-1], Sector):
            return (self._made(path, (), None),)
        return (self._made(path, None, None),)  # also for a list: the list is unknown

    def _without_value(self) -> tuple[FieldValue, ...] | None:
        first = self._setting.path.steps[0]
        assert isinstance(first, ast.Name)
        finding = NotSettable(field=self._text, found="a field without a value")
        self._add(finding.at(self._setting.span, help=finding.NoValue(name=first.text)))
        return None

    def _report_whole(self, type_: Type) -> None:
        finding = NotSettable(field=self._text, found=describe(type_))
        inside = [f"`{self._text}.{name}`" for name in members(type_)][:8]
        help: Remark = finding.NoFields()
        if isinstance(type_, Quaternion):
            help = finding.Angle(field=self._text)
        elif isinstance(type_, List) and type_.is_of_beams:
            help = finding.Beams()
        elif isinstance(type_, List):
            help = finding.Elements(field=self._text)
        elif inside:
            help = finding.Fields(fields=", ".join(inside))
        self._add(finding.at(self._setting.path.span, help=help))

    # --- values ------------------------------------------------------------------------------

    def _value(self, value: ast.Expression, type_: Type) -> SettingValue:
        if isinstance(type_, Message | Quaternion):
            self._report_whole(type_)
            return None
        if isinstance(type_, List):
            return self._no_elements(value, type_)
        if isinstance(type_, Vector | Array):
            return self._list(value, type_)
        if isinstance(value, ast.Bracket):
            self._mismatch(value, type_, "a list")
            return None
        return self._scalar(value, type_, None)

    def _no_elements(self, value: ast.Expression, type_: List) -> tuple[()] | None:
        """The value of a list without elements. A list is set element by element; only an empty
        list can be set as a whole.
        """
        if isinstance(value, ast.Bracket) and not value.elements:
            return ()
        self._report_whole(type_)
        return None

    def _list(self, value: ast.Expression, type_: Vector | Array) -> tuple[float, ...] | None:
        if not isinstance(value, ast.Bracket):
            infer(value, self._context)
            self._mismatch(value, type_, "one value")
            return None
        unit = None if value.unit is None else read_unit(value.unit, self._context.collector)
        if value.unit is not None and unit is None:
            return None
        count = len(value.elements)
        if isinstance(type_, Vector) and count != 3:
            self._mismatch(value, type_, f"a list of {count}")
            return None
        element = type_.element
        fits = unit is None or self._fits_list(value, Quantity(unit), element)
        if not fits:
            return None
        found = [self._scalar(each, element, unit) for each in value.elements]
        numbers = tuple(float(each) for each in found if isinstance(each, float | bool))
        return numbers if len(numbers) == len(found) else None

    def _scalar(
        self, node: ast.Expression, type_: Type, around: Unit | None
    ) -> float | bool | str | None:
        """The value in SI. `around` is the unit of the list around the value."""
        found = infer(node, self._context)
        if isinstance(found, Unknown):
            return None
        if not require_constant(node, f"the value of `{self._text}`", self._context):
            return None
        value = self._context.values[node]
        if isinstance(type_, Boolean) and isinstance(found, Boolean):
            return value.boolean
        if isinstance(type_, Text) and isinstance(found, Text):
            return value.text
        if not (isinstance(type_, Quantity) and isinstance(found, Quantity)):
            self._mismatch(node, type_, describe(found))
            return None
        number = value.numbers[0]
        if around is None:
            return self._held(node, number, type_) if self._fits(node, found, type_) else None
        if not is_plain(found):
            twice = MisplacedUnit(reason="both this element and the whole list have a unit")
            self._add(twice.at(node.span, help=twice.OnceInList(unit=around.symbol)))
            return None
        return self._held(node, around.to_si(number), type_)

    def _held(self, node: ast.Expression, number: float, type_: Quantity) -> float | None:
        """The number, if a message can carry it."""
        if type_.limits is None:
            return number
        held = type_.unit, type_.limits
        return number if is_whole(node, number, self._text, held, self._context) else None

    def _fits_list(self, value: ast.Bracket, found: Quantity, element: Type) -> bool:
        if isinstance(element, Quantity):
            return self._fits(value, found, element)
        self._mismatch(value, element, describe(found))
        return False

    def _fits(self, node: ast.Expression, found: Quantity, type_: Quantity) -> bool:
        if type_.unit is None or found.unit is None:
            return True
        if found.unit.dimension == type_.unit.dimension:
            return True
        self._mismatch(node, type_, describe(found))
        return False

    def _mismatch(self, node: ast.Expression, type_: Type, found: str) -> None:
        unit = unit_of(type_)
        symbol = "" if unit is None or unit == DIMENSIONLESS else f" {unit.symbol}"
        if unit is not None and unit.dimension == ANGLE:
            symbol = " deg"
        examples = {Boolean: "true", Text: '"..."', Vector: f"[0, 0, 1]{symbol}"}
        example = examples.get(type(type_), f"[1, 2]{symbol}" if isinstance(type_, Array) else "")
        finding = SettingMismatch(
            field=self._text,
            expected=describe(type_),
            found=found,
            example=example or f"1{symbol}",
        )
        self._add(finding.at(node.span))

    def _add(self, finding: Diagnostic) -> None:
        self._context.collector.add(finding)


def _names_header(steps: Sequence[Step], type_: Type) -> bool:
    """Say whether a setting names the header of a message, although the input selects another
    part.
    """
    first = steps[0] if steps else None
    is_header = isinstance(first, ast.Name) and first.text == "header"
    return is_header and "header" not in members(type_)


def _element_of(owner: Type, index: int | str) -> Type | None:
    """The type of an element. A test sets elements of lists by their index."""
    if isinstance(owner, List) and isinstance(index, int):
        return owner.element
    return element_of(owner, index)


def _each_of(type_: Type) -> Type:
    """The type of one reading of a sector. All its beams are set to the same value."""
    return type_.element if isinstance(type_, Array) else type_
