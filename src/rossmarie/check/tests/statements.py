"""Tests: the check of names, fields, units and instants, and the conversion to data."""

from __future__ import annotations

from rossmarie.check.actions.commands import CommandChecker
from rossmarie.check.expressions.infer import infer
from rossmarie.check.operations.operands import duration_ns, require_constant
from rossmarie.check.rules.rule_names import report_undeclared, rule_names
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.declarations import report_second
from rossmarie.check.tests.errors import (
    InstantOutOfOrder,
    InstantOutOfRange,
    NothingExpected,
    TooManyMessages,
)
from rossmarie.check.tests.running import DOING, repeats_skills, running_of
from rossmarie.check.tests.settings import settings_of
from rossmarie.check.units.quantities import SECOND
from rossmarie.check.wording.describe import describe
from rossmarie.ir import script
from rossmarie.syntax import ast
from rossmarie.types import Quantity, Unknown


def check_tests(
    commands: CommandChecker, context: Context, *, is_parsed: bool
) -> tuple[script.Script, ...]:
    """All tests, in the order of the files, without tests that have errors. If some files could not
    be parsed, they may declare a name that a test does not find.
    """
    names = rule_names(context.declarations.rules)
    rules = {name: index for index, name in reversed(list(enumerate(names)))}
    first: dict[str, ast.Test] = {}
    found = []
    for test in context.declarations.items:
        if not isinstance(test, ast.Test):
            continue
        earlier = first.setdefault(test.name.value, test)
        if earlier is not test:
            reason = "two tests of one name could not be distinguished in a report"
            report_second(test.name, earlier.name, "test", reason, context.collector)
        checked = _TestChecker(rules, commands, context, is_parsed).check(test)
        found += [] if checked is None else [checked]
    return tuple(found)


class _TestChecker:
    """Checks one test. `rules` contains the numbers of rules by name."""

    def __init__(
        self, rules: dict[str, int], commands: CommandChecker, context: Context, is_parsed: bool
    ) -> None:
        self._rules = rules
        self._commands = commands
        self._is_parsed = is_parsed
        self._context = context
        self._is_right = True

    def check(self, test: ast.Test) -> script.Script | None:
        """The test as data; None after reporting an error."""
        events: list[script.ScriptedArrival | script.ScriptedReset] = []
        expectations: list[script.Expectation | None] = []
        commands: list[script.CommandExpectation | None] = []
        before: ast.Arrival | ast.OperatorReset | None = None
        now_ns = 0
        for statement in test.statements:
            self._context.enter(None)
            if isinstance(statement, ast.Expectation):
                expectations.append(self._expectation(statement))
                continue
            if isinstance(statement, ast.CommandExpectation):
                commands.append(self._command_expectation(statement))
                continue
            event = self._event(statement)
            if event is None:
                continue
            start_ns = event.at_ns if isinstance(event, script.ScriptedReset) else event.first_ns
            if before is not None and start_ns < now_ns:
                self._report_order(statement, before)
            before, now_ns = statement, max(start_ns, now_ns)
            events.append(event)
        if not (expectations or commands) and self._is_parsed:
            self._context.collector.add(NothingExpected().at(test.name.span))
        if not self._is_right:
            return None
        known = tuple(expected for expected in expectations if expected is not None)
        reported = tuple(expected for expected in commands if expected is not None)
        return script.Script(test.name.value, tuple(events), known, test.span, reported)

    def _event(
        self, statement: ast.Arrival | ast.OperatorReset
    ) -> script.ScriptedArrival | script.ScriptedReset | None:
        if isinstance(statement, ast.OperatorReset):
            at_ns = self._instant(statement.at)
            rule = None if statement.rule is None else self._rule(statement.rule)
            return None if at_ns is None else script.ScriptedReset(at_ns, rule)
        written = [each for each in statement.settings if isinstance(each, ast.Setting)]
        repeated = [each for each in written if repeats_skills(each, self._context)]
        written = [each for each in written if each not in repeated]
        skills = [each for each in statement.settings if isinstance(each, ast.Doing)]
        settings = settings_of(written, self._context)
        running = running_of(skills, self._context) if skills else None
        times = self._times(statement)
        if settings is None or times is None or (skills and running is None):
            self._is_right = False
            return None
        inputs = tuple(dict.fromkeys(map(_input, written)))
        topics = [self._context.reported[name].topic for name in inputs]
        reported = () if self._context.skills is None else (self._context.skills.file.topic,)
        topics += reported if repeated or skills else ()
        names = (*inputs, DOING) if repeated else inputs
        known = tuple(dict.fromkeys(topics))
        return script.ScriptedArrival(*times, names, known, settings, running)

    def _times(self, statement: ast.Arrival) -> tuple[int, int, int | None] | None:
        """The first and the last instant, and the period, in ns."""
        if statement.at is not None:
            at_ns = self._instant(statement.at)
            return None if at_ns is None else (at_ns, at_ns, None)
        assert statement.period is not None
        assert statement.stretch is not None
        infer(statement.period, self._context)
        period_ns = duration_ns(statement.period, "the time after `every`", self._context)
        ends = self._stretch(statement.stretch)
        if period_ns is None or ends is None:
            return None
        count = (ends[1] - ends[0]) // period_ns + 1
        if count > script.MOST_MESSAGES:
            finding = TooManyMessages(count=count, limit=script.MOST_MESSAGES)
            self._context.collector.add(finding.at(statement.span))
            return None
        return (*ends, period_ns)

    def _expectation(self, statement: ast.Expectation) -> script.Expectation | None:
        rule, ends = self._rule(statement.rule), self._ends(statement)
        if rule is None or ends is None:
            self._is_right = False
            return None
        return script.Expectation(rule, statement.is_active, *ends, statement.span)

    def _command_expectation(
        self, statement: ast.CommandExpectation
    ) -> script.CommandExpectation | None:
        found = self._commands.expected(statement.topic, statement.path, statement.range)
        ends = self._ends(statement)
        if found is None or ends is None:
            self._is_right = False
            return None
        command, index, low, high = found
        field = command.fields[index]
        values = field.path, low, high, field.unit
        return script.CommandExpectation(command.topic, *values, *ends, statement.span)

    def _ends(self, statement: ast.Expectation | ast.CommandExpectation) -> tuple[int, int] | None:
        """The first and the last instant of an expectation, in ns."""
        if statement.at is not None:
            at_ns = self._instant(statement.at)
            return None if at_ns is None else (at_ns, at_ns)
        assert statement.stretch is not None
        return self._stretch(statement.stretch)

    def _rule(self, name: ast.Name) -> int | None:
        if name.text in self._rules:
            return self._rules[name.text]
        self._is_right = False
        if self._context.declarations.is_whole:
            report_undeclared(name, self._rules, self._context)
        return None

    # --- time --------------------------------------------------------------------------------

    def _stretch(self, stretch: ast.Stretch) -> tuple[int, int] | None:
        """The first and the last instant, both inclusive, in ns."""
        first, last = self._instant(stretch.first), self._instant(stretch.last)
        if first is None or last is None:
            return None
        last -= stretch.is_open
        if last < first:
            self._is_right = False
            finding = InstantOutOfOrder(
                what="the ends of this interval are",
                before="the beginning",
            )
            place = finding.Beginning().at(stretch.first.span)
            help = finding.Ends()
            self._context.collector.add(finding.at(stretch.last.span, place, help=help))
            return None
        return first, last

    def _instant(self, node: ast.Expression) -> int | None:
        """An instant in ns; None, after reporting, if `node` is not an instant."""
        type_ = infer(node, self._context)
        seconds = self._seconds(node) if _is_time(type_) else None
        if seconds is not None and 0 <= seconds <= script.LATEST_NS / 1e9:
            return round(seconds * 1e9)
        self._is_right = False
        is_reported = isinstance(type_, Unknown) or (_is_time(type_) and seconds is None)
        if not is_reported:
            found = describe(type_) if seconds is None else f"{seconds:g} sec"
            self._context.collector.add(InstantOutOfRange(found=found).at(node.span))
        return None

    def _seconds(self, node: ast.Expression) -> float | None:
        if not require_constant(node, "an instant", self._context):
            return None
        return self._context.values[node].numbers[0]

    def _report_order(
        self,
        statement: ast.Arrival | ast.OperatorReset,
        before: ast.Arrival | ast.OperatorReset,
    ) -> None:
        self._is_right = False
        finding = InstantOutOfOrder(
            what="this statement is",
            before="the statement above it",
        )
        place = finding.Later().at(_start(before).span)
        help = finding.MoveUp()
        self._context.collector.add(finding.at(_start(statement).span, place, help=help))


def _start(statement: ast.Arrival | ast.OperatorReset) -> ast.Expression:
    """The instant at which a statement begins."""
    if statement.at is not None:
        return statement.at
    assert isinstance(statement, ast.Arrival)
    assert statement.stretch is not None
    return statement.stretch.first


def _is_time(type_: object) -> bool:
    return (
        isinstance(type_, Quantity)
        and type_.unit is not None
        and type_.unit.dimension == SECOND.dimension
    )


def _input(setting: ast.Setting) -> str:
    step = setting.path.steps[0]
    assert isinstance(step, ast.Name)
    return step.text
