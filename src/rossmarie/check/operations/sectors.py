"""Sectors of laser scans: `scan.ranges[-30 deg .. 30 deg]`."""

from __future__ import annotations

import math

from dslkit.diagnostics import Edit, Fix, Remark
from rossmarie.check.names.frames import is_left_in_its_frame
from rossmarie.check.operations.operands import require_constant
from rossmarie.check.operations.sector_errors import LongWay, NoSector, NoSectors
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import text_of
from rossmarie.check.units.quantities import ANGLE
from rossmarie.check.wording.describe import describe
from rossmarie.ir.path import Sector
from rossmarie.syntax import ast
from rossmarie.types import Array, List, Message, Quantity, Type, Unknown

_TURN = 2.0 * math.pi
_ROUNDING = 1e-9


def type_of_sector(node: ast.Sector, context: Context) -> Type:
    """The type of a sector whose scan and ends have types."""
    type_ = context.type_of(node.value)
    sector = checked_sector(node.arc, context)
    if not isinstance(type_, Array) or not type_.has_sectors:
        report_no_sectors(type_, node.arc, text_of(node.value), context)
        return Unknown()
    if sector is None or is_left_in_its_frame(node, type_, context):
        return Unknown()
    return Array(type_.element)


def checked_sector(arc: ast.Arc, context: Context) -> Sector | None:
    """The sector between two ends; None after reporting that there is no sector."""
    for end in (arc.first, arc.last):
        type_ = context.type_of(end)
        if isinstance(type_, Unknown):
            return None
        unit = type_.unit if isinstance(type_, Quantity) else None
        if unit is None or unit.dimension != ANGLE:
            found = f"this is {describe(type_)}"
            context.collector.add(NoSector(found=found).at(end.span))
            return None
        if not require_constant(end, "the end of a sector", context):
            return None
    first, last = (context.values[end].numbers[0] for end in (arc.first, arc.last))
    sector = sector_between(first, last)
    if sector is None:
        found = "this is more than a full turn" if last > first else "both angles are the same"
        context.collector.add(NoSector(found=found).at(arc.span))
    elif last < first and sector.width > math.pi:
        _warn_of_long_way(arc, sector, last, context)
    return sector


def sector_between(first: float, last: float) -> Sector | None:
    """The sector from one angle in rad counter-clockwise to another; None if there is none."""
    width = last - first
    if width < 0.0:
        width -= math.floor(width / _TURN) * _TURN
    if abs(width - _TURN) < _ROUNDING:
        width = _TURN
    if not 0.0 < width <= _TURN:
        return None
    turns = 0.0 if -math.pi <= first <= math.pi else math.floor((first + math.pi) / _TURN)
    return Sector(first - turns * _TURN, width)


def report_no_sectors(type_: Type, arc: ast.Arc, text: str, context: Context) -> None:
    """Report that a value has no sectors, unless another finding reports the value."""
    if isinstance(type_, Unknown):
        return
    finding = NoSectors(text=text, found=describe(type_))
    help: Remark | None = None
    ranges = type_.fields.get("ranges") if isinstance(type_, Message) else None
    if isinstance(ranges, Array) and ranges.has_sectors:
        help = finding.Ranges(text=text, sector=arc.span.text[1:-1].strip())
    elif isinstance(type_, List) and type_.is_of_beams:
        help = finding.Points(text=text)
    context.collector.add(finding.at(arc.span, help=help))


def _warn_of_long_way(arc: ast.Arc, sector: Sector, last: float, context: Context) -> None:
    first, second = text_of(arc.first), text_of(arc.last)
    finding = LongWay(
        width=f"{math.degrees(sector.width):.6g}",
        first=first,
        last=second,
        greater=f"{math.degrees(last + _TURN):.6g} deg",
    )
    edits = (Edit(arc.first.span, second), Edit(arc.last.span, first))
    fix = Fix(f"write `[{second} .. {first}]`", edits)
    context.collector.add(finding.at(arc.span, fix=fix))
