"""The results of the checker: a type for every expression, a value for every constant
expression.
"""

from __future__ import annotations

import math

import pytest

from rossmarie.check import CheckedProgram
from rossmarie.syntax import ast
from rossmarie.syntax.walk import walk
from rossmarie.types import Array, Boolean, Box, Interval, Quantity, Vector
from rossmarie.units import DIMENSIONLESS, parse_unit
from support.programs import condition, program_of

RULES = """
action stop;
const half = limit / 2
const limit = 3 km/h
const hold = 500 ms
const tilt = [-10, 10] deg
const zone = [0.1, -0.8, -0.2, 0.65, 0.5, 1.3] m
const docked = "docked"
input odom = topic odom : nav_msgs/msg/Odometry timeout hold * 4
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x in km/h timeout 2 sec
input scan = topic /scan : sensor_msgs/LaserScan timeout 1 min
input mode = topic /mode : std_msgs/String timeout 1 sec
input force = topic /wrench : geometry_msgs/Wrench .force timeout 1 sec
entity drive {
    fast : speed > half for 2 * hold;
    inside : odom.pose.pose.position in zone and odom.pose.pose.orientation.pitch() in tilt;
    near : any(scan.ranges < 50 cm);
    parked : mode == docked and not fast;
    shaking : oscillates(force.z, 3 times, within hold, by 5 kN);
    old : age(scan) > hold;
}
rule all: if drive.fast or drive.inside or drive.near or drive.parked then { stop; }
    clear when drive.shaking or drive.old;
if drive.old then { stop; } clear for hold;
"""


@pytest.fixture(scope="module")
def program() -> CheckedProgram:
    return program_of(RULES)


def expressions(program: CheckedProgram) -> list[ast.Expression]:
    roots = [one.expression for one in program.symbols.conditions.values()]
    for rule in program.rules:
        roots.append(rule.condition)
        for contract in rule.contracts:
            if isinstance(contract, ast.ClearWhen):
                roots.append(contract.condition)
            elif isinstance(contract, ast.ClearFor):
                roots.append(contract.duration)
    return [part for root in roots for part in walk(root)]


def test_every_expression_has_a_type_but_names_of_entities(program: CheckedProgram) -> None:
    untyped = [part for part in expressions(program) if part not in program.types]
    assert {part.span.text for part in untyped} == {"drive"}


def test_constants_are_in_si_and_may_use_later_ones(program: CheckedProgram) -> None:
    constants = program.symbols.constants
    assert constants["limit"].numbers == pytest.approx((3 / 3.6,))
    assert constants["half"].numbers == pytest.approx((1.5 / 3.6,))
    assert constants["tilt"].numbers == pytest.approx((math.radians(-10), math.radians(10)))
    assert isinstance(constants["tilt"].type, Interval)
    assert constants["docked"].text == "docked"


def test_the_two_ends_of_a_box_may_stand_in_either_order(program: CheckedProgram) -> None:
    zone = program.symbols.constants["zone"]
    assert isinstance(zone.type, Box)
    assert zone.numbers == (-0.8, 0.1, -0.2, 0.65, 0.5, 1.3)


def test_references_to_constants_and_durations_have_values(program: CheckedProgram) -> None:
    held = condition(program, "drive.fast")
    assert isinstance(held, ast.Held)
    assert program.values[held.duration].numbers == (1.0,)
    shaking = condition(program, "drive.shaking")
    assert isinstance(shaking, ast.Oscillates)
    assert shaking.swing is not None
    values = [program.values[part] for part in (shaking.count, shaking.window, shaking.swing)]
    assert [value.numbers for value in values] == [(3.0,), (0.5,), (5000.0,)]
    (contract,) = program.rules[1].contracts
    assert isinstance(contract, ast.ClearFor)
    assert program.values[contract.duration].numbers == (0.5,)


def test_what_changes_has_no_value(program: CheckedProgram) -> None:
    texts = {part.span.text for part in expressions(program) if part in program.values}
    assert not {"speed", "speed > half", "fast", "drive.fast"} & texts
    assert {"half", "zone", "50 cm", "docked", "hold"} <= texts


def test_types_are_those_of_the_language(program: CheckedProgram) -> None:
    types = {part.span.text: program.types.get(part) for part in expressions(program)}
    assert types["speed"] == Quantity(parse_unit("km/h"))
    assert types["odom.pose.pose.position"] == Vector(Quantity(parse_unit("m")))
    assert types["odom.pose.pose.orientation.pitch()"] == Quantity(parse_unit("rad"))
    assert types["scan.ranges < 50 cm"] == Array(Boolean())
    assert types["any(scan.ranges < 50 cm)"] == Boolean()
    assert types["drive.fast"] == Boolean()
    assert types["3"] == Quantity(DIMENSIONLESS)


def test_inputs_are_resolved(program: CheckedProgram) -> None:
    odom, mode = program.symbols.inputs["odom"], program.symbols.inputs["mode"]
    assert (odom.topic, odom.message_type, odom.path) == ("/odom", "nav_msgs/Odometry", ())
    assert odom.timeout_ns == 2_000_000_000
    assert (mode.message_type, mode.path) == ("std_msgs/String", ("data",))
    assert program.symbols.inputs["scan"].timeout_ns == 60_000_000_000


def test_the_program_has_the_name_of_its_file(program: CheckedProgram) -> None:
    assert program.name == "rules"
    assert [rule.name.text if rule.name else None for rule in program.rules] == ["all", None]


@pytest.mark.parametrize(
    ("written", "value"),
    [
        ("not true", False),
        ("1 < 2", True),
        ("1 km/h >= 1 m/s", False),
        ("1 == 1 and 2 != 2", False),
        ("1 == 1 or 2 != 2", True),
        ('"a" == "a"', True),
        ('"a" != "a"', False),
        ("20 cm in [0, 1] m", True),
        ("20 cm not in [0, 1] m", False),
        ("(other)", True),
        ("not other or 3 m > 2 m", True),
    ],
)
def test_propositions_of_constants_are_worked_out(written: str, value: bool) -> None:
    program = program_of(f"const other = true\nconst proposition = {written}\n")
    assert program.symbols.constants["proposition"].boolean is value
