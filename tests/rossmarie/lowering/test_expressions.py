"""Lowering of the user's expressions."""

import math

import pytest

from rossmarie import ir
from rossmarie.ir import Function
from support.compiled import (
    condition,
    constant,
    machine_of_condition,
    machine_of_rules,
    proposition_node,
    signal_node,
)

SECOND = 1_000_000_000


def test_constants_are_folded_and_converted() -> None:
    machine = machine_of_rules("""
        const fast = 36 km/h;
        rule it: if battery - 2 V > 3 * 5 V and odom.twist.twist.linear.x > fast / 2
            then { stop; };
    """)
    values = {s.node.value for s in machine.signals if isinstance(s.node, ir.Constant)}
    assert sorted(values) == [2.0, pytest.approx(5.0), 15.0]


def test_functions_of_constants_are_folded() -> None:
    machine, node = condition("battery > min(abs(-4 V), 5 V, 9 V)", ir.Compare)
    assert constant(machine, node.right) == 4.0


def test_a_comparison_of_constants_is_a_literal() -> None:
    machine = machine_of_rules("""
        const limit = 3 V;
        rule it: if limit > 2 V or battery > limit then { stop; };
    """)
    assert machine.propositions[machine.rules[0].condition].node == ir.Literal(True)


def test_what_is_true_goes_without_saying() -> None:
    machine = machine_of_rules("""
        const on = true;
        rule one: if on and battery > 3 V then { stop; };
        rule two: if battery > 3 V or not on then { stop; };
    """)
    first, second = machine.rules
    assert first.condition == second.condition
    assert isinstance(machine.propositions[first.condition].node, ir.Compare)


def test_chains_are_flat_and_equal_parts_once() -> None:
    machine, node = condition(
        "battery > 1 V and (battery > 2 V and estop) and battery > 1 V and battery < 9 V",
        ir.And,
    )
    assert [machine.propositions[operand].text for operand in node.operands] == [
        "battery > 1 V",
        "battery > 2 V",
        "estop",
        "battery < 9 V",
    ]


def test_equal_expressions_are_computed_once() -> None:
    machine = machine_of_condition(
        "norm(imu.angular_velocity) > 1 rad/s or 2 rad/s < norm(imu.angular_velocity)"
    )
    functions = [s.node.function for s in machine.signals if isinstance(s.node, ir.Apply)]
    assert functions == [Function.NORM]
    assert len(machine.slots) == 3


def test_arithmetic_keeps_its_order() -> None:
    machine, node = condition("battery - 1 V - battery / 2 > 0 V", ir.Compare)
    outer = signal_node(machine, node.left, ir.Apply)
    assert outer.function is Function.SUBTRACT
    left, right = (signal_node(machine, operand, ir.Apply) for operand in outer.operands)
    assert (left.function, right.function) == (Function.SUBTRACT, Function.DIVIDE)


def test_a_long_chain_is_no_recursion() -> None:
    machine = machine_of_condition(" + ".join(["battery"] * 240) + " > 5 V")
    assert sum(isinstance(s.node, ir.Apply) for s in machine.signals) == 239


def test_orientation() -> None:
    machine, node = condition("imu.orientation.pitch() > 10 deg", ir.Compare)
    pitch = machine.signals[node.left]
    assert pitch.node == ir.Apply(Function.PITCH, (0, 1, 2, 3))
    assert [slot.path[-1] for slot in machine.slots] == ["x", "y", "z", "w"]
    assert constant(machine, node.right) == math.radians(10)
    # Shown in the unit that the user compares it with.
    assert pitch.unit == "deg"
    assert pitch.scale == pytest.approx(180 / math.pi)


def test_previous_and_rate() -> None:
    machine, node = condition(
        "distance(odom.pose.pose.position, previous(odom.pose.pose.position)) > 1 m"
        " or rate(imu.linear_acceleration.x) > 3 m/s^3",
        ir.Or,
    )
    nodes = [signal.node for signal in machine.signals]
    kinds = [node.function for node in nodes if isinstance(node, ir.Sampled)]
    assert (kinds.count(ir.Sampling.PREVIOUS), kinds.count(ir.Sampling.RATE)) == (3, 1)
    far = proposition_node(machine, node.operands[0], ir.Compare)
    norm = signal_node(machine, far.left, ir.Apply)
    assert norm.function is Function.NORM
    parts = [signal_node(machine, part, ir.Apply) for part in norm.operands]
    assert {part.function for part in parts} == {Function.SUBTRACT}


def test_elementwise_conditions() -> None:
    machine, node = condition(
        "any(abs(scan.ranges - 2 m) < 0.5 m) or count(scan.ranges < 1 m) > 3", ir.Or
    )
    some = proposition_node(machine, node.operands[0], ir.Quantified)
    many = proposition_node(machine, node.operands[1], ir.Compare)
    assert some.quantifier is ir.Quantifier.ANY
    arrays = ir.element_arrays(machine)
    count = signal_node(machine, many.left, ir.Count)
    assert (arrays.propositions[some.element], arrays.propositions[count.element]) == (0, 0)


def ends_of(machine: ir.Machine, proposition: int) -> list[float]:
    """The low and the high end of a range."""
    node = proposition_node(machine, proposition, ir.Between)
    return [constant(machine, node.low), constant(machine, node.high)]


def test_interval() -> None:
    machine, node = condition("battery not in [10, 14] V", ir.Not)
    assert machine.propositions[node.operand].text == "battery in [10, 14] V"
    assert ends_of(machine, node.operand) == [10.0, 14.0]


def test_box() -> None:
    machine, node = condition("odom.pose.pose.position in [-80, 10, 65, -20, 50, 130] cm", ir.And)
    ends = [ends_of(machine, operand) for operand in node.operands]
    assert ends == [[-0.8, 0.1], [-0.2, 0.65], [0.5, 1.3]]
    side = machine.propositions[node.operands[1]]
    assert side.text == "odom.pose.pose.position.y in [-20, 65] cm"


@pytest.mark.parametrize(
    ("text", "negated", "age_ns", "inner"),
    [
        ("age(imu) > 1 sec", False, SECOND + 1, "age(imu) > 1 sec"),
        ("age(imu) >= 1 sec", False, SECOND, "age(imu) >= 1 sec"),
        ("age(imu) < 1 sec", True, SECOND, "age(imu) >= 1 sec"),
        ("age(imu) <= 1 sec", True, SECOND + 1, "age(imu) > 1 sec"),
        ("1 sec < age(imu)", False, SECOND + 1, "age(imu) > 1 sec"),
    ],
)
def test_age(text: str, negated: bool, age_ns: int, inner: str) -> None:
    machine = machine_of_condition(text)
    node = machine.propositions[machine.rules[0].condition].node
    assert isinstance(node, ir.Not) == negated
    reached = (
        machine.propositions[node.operand] if isinstance(node, ir.Not) else machine.propositions[0]
    )
    assert reached.node == ir.AgeReaches(0, age_ns)
    assert reached.text == inner


def test_oscillates() -> None:
    shaking = "oscillates(imu.angular_velocity.x, 3 times, within 0.25 sec, by 180 deg/s)"
    assert condition(shaking, ir.Oscillates)[1] == ir.Oscillates(0, 3, SECOND // 4, math.pi)
    _, node = condition("oscillates(battery, 2 times, within 1 sec)", ir.Oscillates)
    assert node.swing == 0.0


@pytest.mark.parametrize(
    ("comparison", "nodes"),
    [
        ("{} > 3", [ir.Recurs(0, 4, SECOND)]),
        ("3 < {}", [ir.Recurs(0, 4, SECOND)]),
        ("{} >= 3", [ir.Recurs(0, 3, SECOND)]),
        ("{} < 3", [ir.Recurs(0, 3, SECOND), ir.Not(1)]),
        ("{} <= 3", [ir.Recurs(0, 4, SECOND), ir.Not(1)]),
        ("{} == 3", [ir.Recurs(0, 4, SECOND), ir.Not(1), ir.Recurs(0, 3, SECOND), ir.And((3, 2))]),
        ("{} != 3", [ir.Recurs(0, 3, SECOND), ir.Not(1), ir.Recurs(0, 4, SECOND), ir.Or((2, 3))]),
        ("{} == 0", [ir.Recurs(0, 1, SECOND), ir.Not(1)]),
        ("{} <= 0", [ir.Recurs(0, 1, SECOND), ir.Not(1)]),
        ("{} > 0", [ir.Recurs(0, 1, SECOND)]),
        ("{} != 0", [ir.Recurs(0, 1, SECOND)]),
    ],
)
def test_edges(comparison: str, nodes: list[ir.PropositionNode]) -> None:
    machine = machine_of_condition(comparison.format("count(edges of estop within 1 sec)"))
    found = [each.node for each in machine.propositions if not isinstance(each.node, ir.Literal)]
    assert found == [ir.Flag(0), *nodes]


def test_what_is_never_true_has_no_edges() -> None:
    machine = machine_of_condition("estop or count(edges of 1 > 2 within 1 sec) > 0")
    assert not any(isinstance(proposition.node, ir.Recurs) for proposition in machine.propositions)


def test_changed_is_a_comparison_with_the_sample_before() -> None:
    machine = machine_of_condition("changed(battery)")
    changed = machine.propositions[machine.rules[0].condition]
    assert changed.text == "changed(battery)"
    assert changed.node == ir.Compare(ir.Comparison.NOT_EQUAL, 0, 1)
    assert machine.signals[1].node == ir.Sampled(ir.Sampling.PREVIOUS, 0)
    machine = machine_of_condition("changed(imu.angular_velocity)")
    node = machine.propositions[machine.rules[0].condition].node
    assert isinstance(node, ir.Or)
    texts = [machine.propositions[each].text for each in node.operands]
    assert texts == [f"changed(imu.angular_velocity.{axis})" for axis in "xyz"]


def test_words_stand_on_one_line_without_comments() -> None:
    machine = machine_of_condition('battery // the main one\n   > 3 V and mode == "a  // b"')
    assert machine.propositions[-2].text == 'battery > 3 V and mode == "a  // b"'


def test_a_backslash_is_no_escape_in_a_text() -> None:
    condition = r"""mode == "C:\" or mode == "b // \""""
    machine = machine_of_condition(f"{condition}  // a comment\n")
    assert machine.propositions[machine.rules[0].condition].text == condition


def test_propositions_of_constants_are_folded() -> None:
    rules = """
        const docked = "docked"
        const guarded = not (1 < 2 and docked != "away")
        if guarded or estop then { stop; };
    """
    machine = machine_of_rules(rules)
    assert machine.propositions[machine.rules[0].condition].node == ir.Flag(0)


def test_constants_stay_apart_by_unit_and_sign_of_zero() -> None:
    machine = machine_of_condition(
        "battery > 3 V or odom.twist.twist.linear.x > 3 m/s or battery < 0 V or battery < -(0 V)"
    )
    found = [
        (s.unit, repr(s.node.value)) for s in machine.signals if isinstance(s.node, ir.Constant)
    ]
    assert found == [("V", "3.0"), ("m/s", "3.0"), ("V", "0.0"), ("V", "-0.0")]


def test_a_signal_is_shown_in_the_unit_that_it_is_first_compared_with() -> None:
    machine = machine_of_condition(
        "imu.orientation.yaw() > 90 deg and imu.orientation.yaw() < 3 rad"
    )
    units = [s.unit for s in machine.signals if isinstance(s.node, ir.Apply)]
    assert units == ["deg"]


def test_what_is_always_false_never_holds() -> None:
    assert condition("false for 2 sec or estop", ir.Flag)[1] == ir.Flag(0)
