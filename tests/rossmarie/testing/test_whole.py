"""Generated tests set what messages can carry: whole numbers where a field holds only those."""

from __future__ import annotations

from pathlib import Path

import pytest

from rossmarie.driver.generating import generate_tests
from rossmarie.driver.testing import RanTests, run_test_file
from rossmarie.testing.goals import Aspect

INPUTS = """
action stop;
input gear = topic /gear : std_msgs/UInt8 timeout 0.5 sec;
input level = topic /level : std_msgs/UInt8 .data in % timeout 0.5 sec;
input heat = topic /heat : std_msgs/UInt8 .data in degC timeout 0.5 sec;
input ticks = topic /ticks : std_msgs/Int32 timeout 0.5 sec;
input wheel = topic /wheel : std_msgs/UInt16 .data in mm timeout 0.5 sec;
input far = topic /far : std_msgs/Int64 .data in mm timeout 0.5 sec;
input joy = topic /joy : sensor_msgs/Joy timeout 0.5 sec;
input value = topic /value : rcl_interfaces/ParameterValue timeout 0.5 sec;
"""


def written(folder: Path, condition: str) -> tuple[str, RanTests]:
    """The generated tests of one rule, and what comes of them."""
    path = folder / "rules.ross"
    path.write_text(f"{INPUTS}rule r: if {condition} then {{ stop; }};\n", encoding="utf-8")
    found = generate_tests(path)
    found.path.write_text(found.text, encoding="utf-8")
    ran = run_test_file(path, in_c=False)
    assert not any(each.found for each in ran.ran)
    return found.text, ran


def uncovered(outcome: RanTests) -> list[Aspect]:
    return [goal.aspect for goal in outcome.coverage.goals if goal not in outcome.coverage.reached]


@pytest.mark.parametrize(
    ("condition", "around"),
    [
        ("gear > 3", ["gear = 2;", "gear = 3;", "gear = 4;"]),
        ("gear > 254", ["gear = 253;", "gear = 254;", "gear = 255;"]),
        ("level > 7 %", ["level = 6 %;", "level = 7 %;", "level = 8 %;"]),
        ("heat > 40 degC", ["heat = 39 degC;", "heat = 40 degC;", "heat = 41 degC;"]),
        ("far > 5.5 m", ["far = 5.499 m;", "far = 5.5 m;", "far = 5.501 m;"]),
        ("gear + ticks > 300", ["ticks = 299;", "ticks = 300;", "ticks = 301;"]),
        ("joy.buttons[0] == 1", ["joy.buttons[0] = 1;", "joy.buttons[0] = 2;"]),
        ("any(value.integer_array_value > 3)", ["= [2];", "= [3];", "= [4];"]),
        ("any(value.bool_array_value)", ["= [false];", "= [true];"]),
        ("gear - previous(gear) > 3", ["gear = 3;", "gear = 0;", "gear = 4;"]),
        ("oscillates(gear, 3 times, within 2 sec, by 200)", ["gear = 250;", "gear = 0;"]),
    ],
)
def test_the_values_beside_a_threshold_are_its_neighbors(
    tmp_path: Path, condition: str, around: list[str]
) -> None:
    text, outcome = written(tmp_path, condition)
    assert [each for each in around if each not in text] == []
    assert uncovered(outcome) == []


@pytest.mark.parametrize(
    ("condition", "impossible"),
    [
        ("gear >= 255", [Aspect.OVER]),
        ("level >= 97.5 %", [Aspect.AT]),
        ("gear > 0", [Aspect.UNDER]),
    ],
)
def test_what_no_message_can_carry_is_known_to_be_out_of_reach(
    tmp_path: Path, condition: str, impossible: list[Aspect]
) -> None:
    _, outcome = written(tmp_path, condition)
    assert uncovered(outcome) == impossible
    assert {goal.aspect for goal in outcome.reasons} == set(impossible)


def test_a_rate_of_a_counter_rises_by_whole_steps(tmp_path: Path) -> None:
    text, outcome = written(tmp_path, "abs(rate(wheel)) > 55 mm/s for 0.3 sec")
    assert "wheel = 4 mm;" in text
    assert Aspect.TRUE not in uncovered(outcome)
    assert Aspect.FALSE not in uncovered(outcome)


def test_a_step_beyond_the_range_of_a_double_is_no_step(tmp_path: Path) -> None:
    _, ran = written(tmp_path, "gear * 1e200 * 1e200 + gear > 3")
    assert not any(each.found for each in ran.ran)


def test_of_a_silence_that_is_longer_than_a_test_may_be_only_the_beginning_is_tested(
    tmp_path: Path,
) -> None:
    """A mode that is reported when it changes has the longest timeout that there is."""
    path = tmp_path / "rules.ross"
    path.write_text(
        "action stop;\n"
        "input mode = topic /mode : std_msgs/UInt8 timeout 1e9 sec;\n"
        "input gear = topic /gear : std_msgs/UInt8 timeout 0.5 sec;\n"
        "rule r: if mode == 3 and gear == 1 then { stop; };\n"
    )
    found = generate_tests(path)
    found.path.write_text(found.text, encoding="utf-8")
    ran = run_test_file(path, in_c=False)
    assert [each.title for one in ran.ran for each in one.found] == []
    assert uncovered(ran) == []
    assert "gear falls silent" in found.text
    assert "mode has not come yet" in found.text
    assert "mode falls silent" not in found.text
