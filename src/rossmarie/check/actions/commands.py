"""Limits, scales and blocks: the effects on a command topic that passes through the safety
filter.
"""

from __future__ import annotations

from collections.abc import Sequence

from dslkit.diagnostics import Diagnostic, Remark
from dslkit.source import Span
from rossmarie.check.actions.errors import (
    BoundWithoutZero,
    DoesNothing,
    FactorOutOfRange,
    FieldGivenTwice,
    FieldNotBounded,
    NotAnInterval,
    NothingToBound,
    PartlyRamped,
    RampMismatch,
    RepeatedRamp,
    ZeroIsAPose,
)
from rossmarie.check.actions.numbers import fits
from rossmarie.check.actions.paths import EffectField, field_of, leaf_unit, symbol_of
from rossmarie.check.actions.targets import SentMessage, TargetResolver
from rossmarie.check.effects import CheckedEffect, CheckedLimit, CheckedScale
from rossmarie.check.expressions.frequencies import is_positive
from rossmarie.check.expressions.infer import infer
from rossmarie.check.operations.operands import require_constant
from rossmarie.check.units.quantities import SECOND
from rossmarie.check.wording.describe import describe, is_plain
from rossmarie.ir import reactions
from rossmarie.syntax import ast
from rossmarie.types import Interval, Quantity, Unknown
from rossmarie.units import DIMENSIONLESS, Unit, divide, multiply, parse_unit

_FLOATS = frozenset({"float32", "float64"})
_POSES = (parse_unit("m").dimension, parse_unit("rad").dimension)

Ramps = list[tuple[ast.Expression, Unit, float]]
"""Ramps, each with the unit of the quantity that it lifts and its value in SI."""


def command_of(sent: SentMessage, span: Span, targets: TargetResolver) -> reactions.CommandTopic:
    """The topic in the form that the safety filter uses, without the numbers of headers."""
    fields = tuple(
        reactions.CommandField(leaf.path, leaf.is_array, symbol_of(leaf_unit(leaf, sent, targets)))
        for leaf in targets.model.messages.leaves(sent.message)
        if leaf.base in _FLOATS
    )
    return reactions.CommandTopic(sent.name, sent.type, fields, span)


class CommandChecker:
    """Checks the effects on command topics. `commands` are the topics found so far."""

    def __init__(
        self, targets: TargetResolver, commands: dict[str, reactions.CommandTopic]
    ) -> None:
        self._targets = targets
        self._context = targets.context
        self._commands = commands

    def check(self, effect: ast.Limit | ast.Scale | ast.Block) -> CheckedEffect | None:
        """The checked effect; None after reporting an error."""
        sent = self._targets.topic(effect.target)
        command = self._command(sent, effect.target)
        found: CheckedLimit | CheckedScale | None = None
        match effect:
            case ast.Limit():
                for bound in effect.bounds:
                    infer(bound.range, self._context)
                ramps = self._ramps(effect.ramps)
                if sent is not None and command is not None:
                    found = self._limit(effect, sent, command, ramps)
            case ast.Scale():
                infer(effect.factor, self._context)
                found = self._scale(effect, command, self._ramps(effect.ramps))
            case ast.Block():
                ramps = self._ramps(effect.ramps)
                if command is not None:
                    found = self._block(effect, command, ramps)
        return None if found is None else CheckedEffect(found, effect.span, found.topic)

    def _command(
        self, sent: SentMessage | None, target: ast.Target
    ) -> reactions.CommandTopic | None:
        if sent is None:
            return None
        command = command_of(sent, target.name.span, self._targets)
        if not command.fields:
            self._add(NothingToBound(type=sent.type).at(target.span))
            return None
        return self._commands.setdefault(sent.name, command)

    def expected(
        self, topic: ast.Name, path: ast.FieldPath, range_: ast.Expression
    ) -> tuple[reactions.CommandTopic, int, float, float] | None:
        """The field about which a test has an expectation, by index, and the limits in the unit of
        the message. None after reporting an error.
        """
        infer(range_, self._context)
        if not self._targets.is_commanded(topic):
            return None
        target = ast.Target(topic, None, topic.span)
        sent = self._targets.topic(target)
        command = self._command(sent, target)
        field = None if sent is None else field_of(path, sent, self._targets)
        if command is None or field is None:
            return None
        bound = ast.FieldBound(path, range_, path.span)
        index, ends = self._index(field, bound, command), self._interval(bound, field)
        return None if index is None or ends is None else (command, index, ends[0], ends[1])

    # --- limits ------------------------------------------------------------------------------

    def _limit(
        self, effect: ast.Limit, sent: SentMessage, command: reactions.CommandTopic, ramps: Ramps
    ) -> CheckedLimit | None:
        if not effect.bounds:
            empty = DoesNothing(what="limit")
            self._add(empty.at(effect.span, help=empty.Limit()))
        first: dict[reactions.FieldPath, ast.FieldBound] = {}
        found: list[tuple[int, Unit, tuple[float, ...], str]] = []
        for bound in effect.bounds:
            field = field_of(bound.path, sent, self._targets)
            index = None if field is None else self._index(field, bound, command)
            if field is None or index is None:
                continue
            earlier = first.setdefault(field.path, bound)
            if earlier is not bound:
                finding = FieldGivenTwice(field=field.text)
                place = finding.First().at(earlier.path.span)
                self._add(finding.at(bound.path.span, place))
            ends = self._ends(bound, field)
            if ends is not None:
                found.append((index, field.unit or DIMENSIONLESS, ends, field.text))
        by_field = self._by_field([(each[1], each[3]) for each in found], ramps, effect)
        if len(found) < len(effect.bounds) or len(first) < len(effect.bounds) or by_field is None:
            return None
        bounds = (
            reactions.Bound(index, ends[0], ends[1], ramp)
            for (index, _, ends, _), ramp in zip(found, by_field, strict=True)
        )
        return CheckedLimit(command.topic, tuple(bounds))

    def _index(
        self, field: EffectField, bound: ast.FieldBound, command: reactions.CommandTopic
    ) -> int | None:
        """The index of a field among the fields of the command; None after reporting an error."""
        paths = [one.path for one in command.fields]
        if field.leaf is not None and field.leaf.path in paths and not field.is_element:
            return paths.index(field.leaf.path)
        whole = [".".join(map(str, path)) for path in paths]
        kind = FieldNotBounded
        help: Remark
        reason, help = "not a floating-point number", kind.OneOf(fields=_quoted(whole[:8]))
        if field.is_element:
            reason, help = "a bound holds for each element of an array", kind.NoIndex()
        elif inside := [path for path in whole if path.startswith(f"{field.text}.")]:
            reason, help = "not a number, but several", kind.Inside(fields=_quoted(inside[:8]))
        self._add(kind(field=field.text, reason=reason).at(bound.path.span, help=help))
        return None

    def _ends(self, bound: ast.FieldBound, field: EffectField) -> tuple[float, ...] | None:
        """The result of `_interval` for a bound, which has to contain zero."""
        ends = self._interval(bound, field)
        if ends is not None and not ends[0] <= 0 <= ends[1]:
            self._add(BoundWithoutZero().at(bound.range.span))
            return None
        return ends

    def _interval(self, bound: ast.FieldBound, field: EffectField) -> tuple[float, ...] | None:
        """The two ends in the unit of the message; None after reporting an error."""
        type_ = self._context.type_of(bound.range)
        if isinstance(type_, Unknown):
            return None
        if not isinstance(type_, Interval):
            self._add(NotAnInterval(found=describe(type_)).at(bound.range.span))
            return None
        unit = field.unit or DIMENSIONLESS
        if not fits(bound.range, type_.element, field, self._context):
            return None
        low, high = self._context.values[bound.range].numbers
        return unit.from_si(low) + 0.0, unit.from_si(high) + 0.0

    # --- scales and blocks -------------------------------------------------------------------

    def _scale(
        self, effect: ast.Scale, command: reactions.CommandTopic | None, ramps: Ramps
    ) -> CheckedScale | None:
        type_ = self._context.type_of(effect.factor)
        is_factor = isinstance(type_, Quantity) and is_plain(type_)
        factor = None
        if not is_factor and not isinstance(type_, Unknown):
            self._add(FactorOutOfRange(found=describe(type_)).at(effect.factor.span))
        elif is_factor and require_constant(effect.factor, "a factor", self._context):
            factor = self._context.values[effect.factor].numbers[0]
            if not 0 <= factor <= 1:
                self._add(FactorOutOfRange(found=f"{factor * 100:g} %").at(effect.factor.span))
                factor = None
        by_field = self._by_field([(DIMENSIONLESS, "the factor")], ramps, effect)
        if command is None or factor is None or by_field is None:
            return None
        if self._is_pose(effect.target, command):
            return None
        return CheckedScale(command.topic, factor, by_field[0])

    def _block(
        self, effect: ast.Block, command: reactions.CommandTopic, ramps: Ramps
    ) -> CheckedLimit | None:
        if self._is_pose(effect.target, command):
            return None
        units = [
            (parse_unit(each.unit) if each.unit else DIMENSIONLESS, ".".join(map(str, each.path)))
            for each in command.fields
        ]
        by_field = self._by_field(units, ramps, effect)
        if by_field is None:
            return None
        bounds = (reactions.Bound(index, 0.0, 0.0, ramp) for index, ramp in enumerate(by_field))
        return CheckedLimit(command.topic, tuple(bounds))

    def _is_pose(self, target: ast.Target, command: reactions.CommandTopic) -> bool:
        for field in command.fields:
            if field.unit and parse_unit(field.unit).dimension in _POSES:
                text = ".".join(map(str, field.path))
                self._add(ZeroIsAPose(field=text, unit=field.unit).at(target.span))
                return True
        return False

    # --- ramps -------------------------------------------------------------------------------

    def _ramps(self, ramps: Sequence[ast.Expression]) -> Ramps:
        """The ramps that are numbers."""
        found = []
        for ramp in ramps:
            type_ = infer(ramp, self._context)
            if isinstance(type_, Quantity) and type_.unit is not None:
                if require_constant(ramp, "a ramp", self._context) and is_positive(
                    ramp, "a ramp", self._context
                ):
                    value = self._context.values[ramp].numbers[0]
                    found.append((ramp, multiply(type_.unit, SECOND), value))
            elif not isinstance(type_, Unknown):
                finding = RampMismatch(found=describe(type_))
                self._add(finding.at(ramp.span, help=finding.Number()))
        return found

    def _by_field(
        self,
        fields: Sequence[tuple[Unit, str]],
        ramps: Ramps,
        effect: ast.Limit | ast.Scale | ast.Block,
    ) -> list[float | None] | None:
        """The ramp of each field in its unit; None after reporting ramps without a field."""
        if len(ramps) < len(effect.ramps):
            return None
        is_right = True
        for number, (ramp, lifted, _) in enumerate(ramps):
            if any(lifted.dimension == other.dimension for _, other, _ in ramps[:number]):
                self._add(RepeatedRamp().at(ramp.span))
                is_right = False
            elif fields and all(lifted.dimension != unit.dimension for unit, _ in fields):
                self._report_ramp(ramp, lifted, fields)
                is_right = False
        found = [_ramp_for(unit, ramps) for unit, _ in fields]
        unramped = [field for field, ramp in zip(fields, found, strict=True) if ramp is None]
        if is_right and ramps and unramped:
            unit, text = unramped[0]
            example = f"1 {divide(unit, SECOND).symbol}"
            self._add(PartlyRamped(field=text, example=example).at(ramps[0][0].span))
        return found if is_right else None

    def _report_ramp(
        self, ramp: ast.Expression, lifted: Unit, fields: Sequence[tuple[Unit, str]]
    ) -> None:
        unit, text = fields[0]
        wanted = divide(unit, SECOND).symbol
        found = f"the ramp needs a bound in {lifted.symbol}, but `{text}` is in {unit.symbol}"
        if unit == DIMENSIONLESS:
            found = f"the ramp needs a bound in {lifted.symbol}, but {text} is a plain number"
        finding = RampMismatch(found=found)
        self._add(finding.at(ramp.span, help=finding.Unit(unit=wanted)))

    def _add(self, finding: Diagnostic) -> None:
        self._context.collector.add(finding)


def _quoted(paths: Sequence[str]) -> str:
    return ", ".join(f"`{path}`" for path in paths)


def _ramp_for(unit: Unit, ramps: Ramps) -> float | None:
    fitting = (value for _, lifted, value in ramps if lifted.dimension == unit.dimension)
    value = next(fitting, None)
    return None if value is None else value / unit.scale
