"""The reason why a rule changed, in the user's words."""

import math

import pytest
from hypothesis import given, settings

from rossmarie import ir
from rossmarie.interpreter import Interpreter
from rossmarie.ir import Change, ChannelValues, TruthValue, Verdict, explain
from rossmarie.ir.kleene import negation
from support.compiled import machine_of, machine_of_rules
from support.depth import examples
from support.machines import Case, cases, take

SECOND = 1_000_000_000

INPUTS = """
input x = topic /x : std_msgs/Float64 in m timeout 10 sec;
input y = topic /y : std_msgs/Float64 in m timeout 10 sec;
input on = topic /on : std_msgs/Bool;
input mode = topic /mode : std_msgs/String;
action stop;
"""


class Story:
    """Rules over x, y, on and mode; what their first verdict after a message says."""

    def __init__(self, rules: str) -> None:
        self.machine = machine_of(INPUTS + rules)
        self.monitor = Interpreter(self.machine)
        self.verdicts: list[Verdict] = []

    def send(self, seconds: float, **values: float) -> None:
        messages: dict[int, ChannelValues] = {}
        for slot, declared in enumerate(self.machine.slots):
            used = self.machine.inputs[declared.input]
            if used.name in values:
                messages[used.channel] = ChannelValues(slots={slot: values[used.name]})
        self._note(self.monitor.update(round(seconds * SECOND), messages))

    def advance(self, seconds: float) -> None:
        self._note(self.monitor.advance(round(seconds * SECOND)))

    def _note(self, events: list[ir.Event]) -> None:
        self.verdicts += [event for event in events if isinstance(event, Verdict)]

    def last(self) -> ir.Explanation:
        return explain(self.machine, self.verdicts[-1])


def lines_of_rule(condition: str, **values: float) -> tuple[str, ...]:
    """The explanation of a rule that becomes active with one update, at 1 s."""
    story = Story(f"rule it: if {condition} then {{ stop; }};")
    story.send(1, **values)
    assert story.verdicts[-1].change is not Change.CLEARED
    return story.last().lines()


def test_a_condition_with_value_unit_and_since_when() -> None:
    machine = machine_of_rules("""
        entity imu_ { steep : imu.orientation.pitch() not in [-20, 20] deg for 4 sec; }
        rule tilted: if imu_.steep then { stop; } clear for 2 sec;
    """)
    monitor = Interpreter(machine)
    half = math.radians(23.1) / 2
    raw = ChannelValues(slots={0: 0.0, 1: math.sin(half), 2: 0.0, 3: math.cos(half)})
    events = [
        event for tick in range(123, 170) for event in monitor.update(tick * SECOND // 10, {0: raw})
    ]
    (verdict,) = events
    assert isinstance(verdict, Verdict)
    explanation = explain(machine, verdict)
    assert explanation.line() == (
        "imu_.steep: imu.orientation.pitch() = 23.1 deg, not in [-20, 20] deg for 4 sec,"
        " true since 12.300 s"
    )
    assert (explanation.rule, explanation.at_ns) == ("tilted", 163 * SECOND // 10)
    assert explanation.contract == "clears when imu_.steep has been false for 2 sec"
    (cause,) = explanation.causes
    (reading,) = cause.readings
    assert reading.value == pytest.approx(23.1)
    assert reading.unit == "deg"
    assert cause.line(origin_ns=10 * SECOND).endswith("true since 2.300 s")


def test_of_a_true_and_all_operands() -> None:
    assert lines_of_rule("x > 1 m and y > 2 m", x=3.0, y=4.5) == (
        "x = 3 m, > 1 m, true since 1.000 s",
        "y = 4.5 m, > 2 m, true since 1.000 s",
    )


def test_of_a_true_or_the_true_ones() -> None:
    assert lines_of_rule("x > 1 m or y > 2 m", x=0.0, y=4.0) == (
        "y = 4 m, > 2 m, true since 1.000 s",
    )


def test_through_negations() -> None:
    assert lines_of_rule("not (x > 1 m or y > 2 m)", x=0.0, y=0.0) == (
        "x = 0 m, > 1 m, false since 1.000 s",
        "y = 0 m, > 2 m, false since 1.000 s",
    )
    assert lines_of_rule("not x > 1 m", x=0.0) == ("x = 0 m, not x > 1 m, true since 1.000 s",)


def test_a_comparison_of_two_signals_shows_both() -> None:
    assert lines_of_rule("x > y", x=3.0, y=2.0) == ("x = 3 m, y = 2 m, x > y, true since 1.000 s",)


def test_flags_and_texts_are_shown_as_such() -> None:
    assert lines_of_rule("on", on=1.0) == ("on, true since 1.000 s",)
    assert lines_of_rule("not on", on=0.0) == ("on, false since 1.000 s",)
    assert lines_of_rule('mode == "docked"', mode=0.0) == (
        'mode = "docked", == "docked", true since 1.000 s',
    )
    assert lines_of_rule('mode != "docked"', mode=-1.0) == (
        'mode = another string, != "docked", true since 1.000 s',
    )


def test_ages_show_no_value() -> None:
    story = Story("rule it: if age(on) > 3 sec then { stop; };")
    story.monitor.update(SECOND, {0: ChannelValues()})
    story.advance(9)
    assert story.last().lines() == ("age(on) > 3 sec, true since 4.000 s",)


def test_conditions_lend_their_name_to_their_parts() -> None:
    story = Story("""
        entity robot { far : x > 1 m and y > 1 m; stale : far or on; }
        rule it: if robot.stale and not on then { stop; };
    """)
    story.send(1, x=2.0, y=3.0, on=0.0)
    assert [cause.name for cause in story.last().causes] == ["robot.far", "robot.far", None]


def test_a_duration_around_several_conditions_is_reported_as_a_whole() -> None:
    story = Story("rule it: if (x > 1 m and (y > 1 m or on)) for 2 sec then { stop; };")
    story.send(1, x=2.0, y=3.0, on=0.0)
    story.advance(9)
    assert story.last().lines() == (
        "x = 2 m, y = 3 m, (x > 1 m and (y > 1 m or on)) for 2 sec, true since 1.000 s",
    )


def test_what_cleared_it() -> None:
    story = Story("rule it: if x > 1 m and y > 1 m then { stop; };")
    story.send(1, x=2.0, y=2.0)
    story.send(2, x=0.5)
    explanation = story.last()
    assert explanation.change is Change.CLEARED
    assert explanation.lines() == ("x = 0.5 m, > 1 m, false since 2.000 s",)


def test_a_stale_input_is_blamed_alone() -> None:
    story = Story("rule it: if x > 1 m for 5 sec and y > 1 m then { stop; };")
    story.send(1, y=2.0)
    explanation = story.last()
    assert explanation.change is Change.ACTIVATED_STALE
    assert explanation.lines() == ("input x (/x) has never been received",)
    story.send(2, x=0.0)
    story.advance(30)
    assert story.verdicts[-1].change is Change.ACTIVATED_STALE
    # At 11 s the message of y reaches its timeout; x, which is not true, decides until 12 s.
    assert story.last().at_ns == 12 * SECOND
    assert [stale.line() for stale in story.last().stale_inputs] == [
        "input x (/x) is older than its timeout",
        "input y (/y) is older than its timeout",
    ]


def test_an_input_that_sends_no_number() -> None:
    assert lines_of_rule("x > 1 m", x=math.nan)[0] == "input x (/x) has no usable value"


def test_an_input_that_was_stale_is_blamed_as_long_as_it_counts() -> None:
    story = Story("rule it: if count(edges of x > 1 m within 5 sec) > 1 and on then { stop; };")
    story.send(1, x=math.nan, on=0.0)
    story.send(2, x=2.0)
    story.send(3, on=1.0)
    assert story.last().lines() == ("input x (/x) was stale earlier",)


def test_inputs_that_arrive_are_not_blamed() -> None:
    story = Story("rule it: if x + y > 1 m then { stop; };")
    story.send(1, x=2.0)
    assert [stale.name for stale in story.last().stale_inputs] == ["y"]


def test_equal_causes_are_reported_once() -> None:
    story = Story("rule it: if x > 1 m and (x > 1 m or on) then { stop; };")
    story.send(1, x=2.0)
    assert len(story.last().causes) == 1


@settings(max_examples=examples(4))
@given(cases())
def test_causes_decide(case: Case) -> None:
    """The causes alone give the condition its value, for all values of the other leaves."""
    machine, trace = case
    monitor = Interpreter(machine)
    for step in trace:
        for event in take(monitor, step):
            if isinstance(event, Verdict):
                assert_causes_decide(machine, event)


def assert_causes_decide(machine: ir.Machine, verdict: Verdict) -> None:
    rule = machine.rules[verdict.rule]
    explanation = explain(machine, verdict)
    reported = dict(zip(rule.terms, verdict.truth_values, strict=True))
    causes = {cause.proposition: cause.value for cause in explanation.causes}
    assert explanation.line() == explain(machine, verdict).line()
    outcome = value_from(machine, rule.condition, causes)
    assert outcome is value_from(machine, rule.condition, reported)
    if verdict.change is Change.ACTIVATED_STALE:
        assert explanation.stale_inputs
        assert set(causes.values()) == {TruthValue.STALE}


def value_from(
    machine: ir.Machine, proposition: int, known: dict[int, TruthValue]
) -> TruthValue | None:
    """The value of a proposition where only some are known; None if these do not decide it."""
    if proposition in known:
        return known[proposition]
    match machine.propositions[proposition].node:
        case ir.Literal(value=value):
            return TruthValue(value)
        case ir.Not(operand=operand):
            inner = value_from(machine, operand, known)
            return None if inner is None else negation(inner)
        case ir.And(operands=operands) | ir.Or(operands=operands) as node:
            return junction(node, [value_from(machine, operand, known) for operand in operands])
        case _:
            return None


def junction(node: ir.And | ir.Or, values: list[TruthValue | None]) -> TruthValue | None:
    strong = TruthValue.FALSE if isinstance(node, ir.And) else TruthValue.TRUE
    if strong in values:
        return strong
    decided = [value for value in values if value is not None]
    if TruthValue.STALE in decided or len(decided) == len(values):
        return max(decided)
    return None


def test_what_looks_back_in_time_is_reported_as_it_was_written() -> None:
    story = Story("rule it: if not after on, x > 3 m within 2 sec then { stop; };")
    story.send(1, on=1.0, x=1.0)
    story.send(2, on=0.0)
    story.advance(3.5)
    reported = "on = false, x = 1 m, not after on, x > 3 m within 2 sec, true since 3.000 s"
    assert story.last().lines() == (reported,)
    story = Story(
        "entity e { near : x < 3 m; } rule it: if once e.near within 2 sec then { stop; };"
    )
    story.send(1, x=1.0)
    assert story.last().lines() == (
        "e.near: x = 1 m, once e.near within 2 sec, true since 1.000 s",
    )
    story = Story("rule it: if x < 3 m since on then { stop; };")
    story.send(1, on=1.0, x=1.0)
    assert story.last().lines() == ("x = 1 m, on = true, x < 3 m since on, true since 1.000 s",)


def test_a_verdict_has_no_parts_of_definitions() -> None:
    machine = machine_of_rules(
        "rule it: if not after estop, battery > 3 V within 2 sec "
        "or (once estop within 1 sec) and (estop since battery > 9 V) then { stop; };"
    )
    assert [machine.propositions[term].text for term in machine.rules[0].terms] == [
        "estop",
        "battery > 3 V",
        "after estop, battery > 3 V within 2 sec",
        "once estop within 1 sec",
        "battery > 9 V",
        "estop since battery > 9 V",
    ]


def test_what_misses_what_looks_back_is_blamed() -> None:
    lines = lines_of_rule("once x > 3 m within 2 sec", on=1.0)
    assert lines == ("input x (/x) has never been received",)
