"""Margins become signals behind all others, and those that do not learn go without them."""

from __future__ import annotations

import dataclasses
import math
import re
from pathlib import Path

import pytest

from rossmarie import ir
from rossmarie.driver import compile_file
from rossmarie.interpreter import Interpreter
from rossmarie.targets import c99

HEAD = """
input wall = topic /range : sensor_msgs/Range .range timeout 0.5 sec;
input scan = topic /scan : sensor_msgs/LaserScan .ranges timeout 0.5 sec;
action stop;
"""


def machine_of(folder: Path, *rules: str) -> ir.Machine:
    path = folder / "rules.ross"
    path.write_text(HEAD + "\n".join(rules), encoding="utf-8")
    return compile_file(path).with_margins


def margin_of(folder: Path, condition: str) -> str:
    """The signals of a margin in the words of the dump, without its numbers."""
    machine = machine_of(folder, f"if {condition} then {{ stop; }} feedback margin in mm;")
    bare = ir.without_margins(machine)
    lines = [line for line in ir.dump_text(machine).splitlines() if re.match(r"s\d", line)]
    return "; ".join(
        line.split(" = ")[1].split("|")[0].strip() for line in lines[len(bare.signals) :]
    )


@pytest.mark.parametrize(
    ("condition", "signals"),
    [
        ("wall < 1 m", "subtract s0, s1"),
        ("wall >= 1 m", "subtract s1, s0"),
        ("not (wall < 1 m)", "subtract s1, s0"),
        ("wall in [1, 2] m", "subtract s1, s0; subtract s0, s2; maximum s3, s4"),
        ("wall not in [1, 2] m for 3 sec", "subtract s0, s1; subtract s2, s0; minimum s3, s4"),
        ("wall < 1 m or wall > 2 m", "subtract s0, s1; subtract s2, s0; minimum s3, s4"),
        ("not (wall < 1 m or wall > 2 m)", "subtract s1, s0; subtract s0, s2; maximum s3, s4"),
        ("any(scan < 1 m)", "minimum over elements s0; subtract s2, s1"),
        ("all(scan < 1 m)", "maximum over elements s0; subtract s2, s1"),
        ("not all(scan < 1 m)", "maximum over elements s0; subtract s1, s2"),
        (
            "any(scan < 1 m or scan > 2 m)",
            "subtract s0, s1; subtract s2, s0; minimum s3, s4; minimum over elements s5",
        ),
        ("wall - 1 m < 1 m", "subtract s2, s1"),
    ],
)
def test_a_margin_is_made_of_differences(tmp_path: Path, condition: str, signals: str) -> None:
    assert margin_of(tmp_path, condition) == signals


@pytest.mark.parametrize(
    ("condition", "elements", "margin"),
    [
        ("any(scan < wall)", [math.inf, 3.0], 2.0),
        ("any(scan < wall)", [math.inf, 0.25], -0.75),
        ("any(scan < wall)", [math.inf], math.nan),
        ("any(wall > scan)", [], math.nan),
        ("all(wall >= scan)", [0.0, math.inf], math.nan),
        ("all(wall >= scan)", [0.0, 0.5], -0.5),
    ],
)
def test_elements_out_of_reach_leave_the_margin_to_others(
    tmp_path: Path, condition: str, elements: list[float], margin: float
) -> None:
    machine = machine_of(tmp_path, f"if {condition} then {{ stop; }} feedback margin in m;")
    interpreter = Interpreter(machine)
    wall, scan = (machine.inputs[each.input].channel for each in (*machine.slots, *machine.arrays))
    interpreter.update(0, {wall: ir.ChannelValues(slots={0: 1.0})})
    interpreter.update(1, {scan: ir.ChannelValues(arrays={0: elements})})
    (asked,) = ir.margins_of(machine)
    assert interpreter.signals[asked.signal] == pytest.approx(margin, abs=0.0, nan_ok=True)


def test_the_unit_is_that_of_the_rule(tmp_path: Path) -> None:
    machine = machine_of(tmp_path, "if wall < 1 m then { stop; } feedback margin in mm;")
    (margin,) = ir.margins_of(machine)
    assert (margin.unit, margin.scale) == ("mm", 1000.0)
    again = ir.machine_from_json(ir.machine_to_json(machine))
    assert ir.margins_of(again) == (margin,)
    assert "margin s2 in mm" in ir.dump_text(machine)


def test_those_that_do_not_learn_have_the_machine_without_them(tmp_path: Path) -> None:
    rules = "rule near: if wall < 1 m or any(scan < 1 m) then { stop; }"
    taught = machine_of(tmp_path, f"{rules} feedback margin in m;")
    operating = compile_file(tmp_path / "rules.ross").machine
    plain = machine_of(tmp_path, f"{rules};")
    assert ir.dump_text(operating) == ir.dump_text(ir.without_margins(taught))
    assert len(operating.signals) < len(taught.signals)
    assert c99.generate(operating) == c99.generate(plain)
    assert ir.without_margins(plain) is plain


def test_a_number_of_the_rules_may_be_a_margin_as_well(tmp_path: Path) -> None:
    machine = machine_of(
        tmp_path,
        "if wall < 1 m then { stop; } feedback margin in m;",
        "if wall - 1 m > 3 m then { stop; } feedback margin in m;",
    )
    first, _ = ir.margins_of(machine)
    operating = ir.without_margins(machine)
    assert operating.signals == machine.signals[: len(operating.signals)]
    assert first.signal < len(operating.signals)
    ir.verify(operating)


def test_a_number_of_a_memory_of_poses_stays(tmp_path: Path) -> None:
    machine = machine_of(tmp_path, "if wall < 1 m then { stop; } feedback margin in m;")
    (margin,) = ir.margins_of(machine)
    machine = dataclasses.replace(machine, readings=(margin.signal,))
    assert ir.without_margins(machine).signals == machine.signals


@pytest.mark.parametrize(
    ("margin", "words"),
    [
        (ir.Margin(99, "m", 1.0), "there is no signal 99"),
        (ir.Margin(2, "m", 1.0), "an elementwise margin"),
        (ir.Margin(0, "m", 0.0), r"a margin times 0\.0"),
        (ir.Margin(0, "m", float("inf")), "inf is not finite"),
    ],
)
def test_a_malformed_margin_is_refused(tmp_path: Path, margin: ir.Margin, words: str) -> None:
    machine = machine_of(tmp_path, "if wall < 1 m or any(scan < 2 m) then { stop; };")
    (rule,) = machine.rules
    wrong = dataclasses.replace(rule, feedback=ir.Feedback(margin=margin))
    with pytest.raises(ir.MalformedMachine, match=words):
        ir.verify(dataclasses.replace(machine, rules=(wrong,)))
