"""Names that an input declares for the elements of an array: `names ["shoulder", "elbow"]`."""

from __future__ import annotations

from dataclasses import replace

from dslkit.diagnostics import Collector, Remark, listed
from dslkit.source import Span
from rossmarie.check.names.fields import members
from rossmarie.check.system.errors import Here, MisplacedNames, RepeatedName
from rossmarie.check.wording.describe import describe
from rossmarie.syntax import ast
from rossmarie.types import Array, Type, Unknown


def with_names(type_: Type, field: str, declaration: ast.Input, collector: Collector) -> Type:
    """The type of an input with its declared names for elements; `Unknown` after reporting that
    such names are not possible.
    """
    names = declaration.names
    if names is None or isinstance(type_, Unknown):
        return type_
    if not isinstance(type_, Array) or type_.names is not None:
        _report_misplaced(type_, field, names.span, declaration.name.text, collector)
        return Unknown()
    first: dict[str, ast.Text] = {}
    for name in names.texts:
        if first.setdefault(name.value, name) is not name:
            place = Here(what="the first element with this name").at(first[name.value].span)
            collector.add(RepeatedName(identifier=name.value).at(name.span, place))
    if len(first) < len(names.texts):
        return Unknown()
    return replace(type_, names=tuple(first))


def _report_misplaced(type_: Type, field: str, span: Span, name: str, collector: Collector) -> None:
    if isinstance(type_, Array):
        reason = f"each message contains the names of its elements in `{type_.names}`"
        help: Remark = MisplacedNames.OfMessage(input=name)
    else:
        reason = f"it is {describe(type_)}, not an array of numbers or flags"
        arrays = [part for part, each in members(type_).items() if isinstance(each, Array)]
        fields = listed([f".{part}" for part in arrays])
        help = MisplacedNames.ChooseField(fields=fields) if fields else MisplacedNames.LeaveOut()
    collector.add(MisplacedNames(field=field, reason=reason).at(span, help=help))
