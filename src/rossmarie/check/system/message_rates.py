"""The message rates that system models declare with `at`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from rossmarie.check.expressions.errors import NotPositive
from rossmarie.check.expressions.frequencies import is_frequency
from rossmarie.check.expressions.infer import infer
from rossmarie.check.model import Gaps
from rossmarie.check.scopes.context import Context
from rossmarie.check.system.errors import Here, RateConflict
from rossmarie.check.system.model import full_name
from rossmarie.syntax import ast
from rossmarie.types import Interval

_RAREST_HZ, _FASTEST_HZ = 1e-9, 1e9


def message_gaps(context: Context) -> Mapping[str, Gaps]:
    """The times between messages of each topic with a declared rate. The values of constants are
    already known.
    """
    found: dict[str, tuple[Gaps, ast.Expression]] = {}
    for topic, rate in _rates(context):
        context.enter(None)
        gaps = _gaps(rate, context)
        if gaps is None:
            continue
        first, earlier = found.setdefault(topic, (gaps, rate))
        if gaps != first:
            finding = RateConflict(topic=topic, found=rate.span.text, expected=earlier.span.text)
            place = Here(what=earlier.span.text).at(earlier.span)
            context.collector.add(finding.at(rate.span, place))
    return {topic: gaps for topic, (gaps, _) in found.items()}


def _rates(context: Context) -> Iterator[tuple[str, ast.Expression]]:
    for system in context.declarations.systems:
        for member in system.members:
            if isinstance(member, ast.TopicDeclaration) and member.rate is not None:
                yield full_name(member.topic.text), member.rate


def _gaps(rate: ast.Expression, context: Context) -> Gaps | None:
    type_ = infer(rate, context)
    number = type_.element if isinstance(type_, Interval) else type_
    if not is_frequency(rate, type_, number, context):
        return None
    numbers = context.values[rate].numbers
    for hertz in (numbers[0], numbers[-1]):
        if not _RAREST_HZ <= hertz <= _FASTEST_HZ:
            is_fast = hertz > _FASTEST_HZ
            finding = NotPositive(
                what="a rate",
                bound="at most 1e9 Hz" if is_fast else "at least 1e-9 Hz",
                found=f"{hertz:g} Hz",
            )
            context.collector.add(finding.at(rate.span, help=finding.HowOften()))
            return None
    return round(1e9 / numbers[-1]), round(1e9 / numbers[0])
