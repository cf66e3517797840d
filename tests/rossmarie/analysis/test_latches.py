"""Rules that reset latched ones: what is found is borne out by a replay and a reset."""

from __future__ import annotations

from pathlib import Path

import pytest

from rossmarie.analysis.finding import Finding
from rossmarie.analysis.queries import ask_all
from rossmarie.analysis.witness import Witness, views
from rossmarie.driver import compile_file
from rossmarie.interpreter import Interpreter
from rossmarie.ir import Change, Machine, Verdict

INPUTS = """
import "rossmarie/deros.ross";
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec
input wheel = topic /wheel : std_msgs/Float64 in m/s
input force = topic /wrench : geometry_msgs/Wrench .force timeout 0.1 sec
input key = topic /key : std_msgs/Bool
action tell { call /operator/tell : std_srvs/Trigger within 1 sec; }
rule too_fast: if speed > 1 m/s then { stopMotor; };
"""


def ask(folder: Path, rules: str) -> tuple[Machine, list[Finding]]:
    """The findings on latches, and what is undecided."""
    path = folder / "rules.ross"
    path.write_text(INPUTS + rules, encoding="utf-8")
    machine = compile_file(path).machine
    found = ask_all(machine, thorough=False, within_ns=10**9)
    return machine, [each for each in found if each.diagnostic.code in ("ROSS716", "ROSS729")]


def released(machine: Machine, witness: Witness) -> set[str]:
    """The latched rules that a reset at the end of a witness clears."""
    monitor = Interpreter(machine)
    for sending in witness.events:
        monitor.update(sending.at_ns, sending.messages)
    events = monitor.reset(witness.end_ns)
    verdicts = [each for each in events if isinstance(each, Verdict)]
    return {machine.rules[v.rule].name for v in verdicts if v.change is Change.CLEARED}


FOUND = {
    "a duration": "if speed < 0.5 m/s for 2 sec then { controllerOk; };",
    "between two": "if speed > 0.5 m/s then { controllerOk; };",
    "another input": "if key then { controllerOk; };",
    "its loss": "if norm(force) < 0 N then { controllerOk; };",
    "escalation": "if key then { tell else controllerOk; };",
    "after an answer": "if wheel > 1 m/s then { tell; controllerOk; };",
    "unless another": "if key unless other then { controllerOk; };\n"
    "rule other: if wheel > 1 m/s then { tell; };",
}


@pytest.mark.parametrize("way", FOUND)
def test_a_reset_at_the_end_of_the_witness_releases_the_latch(way: str, tmp_path: Path) -> None:
    machine, (found,) = ask(tmp_path, f"rule clear: {FOUND[way]}")
    assert found.diagnostic.code == "ROSS716"
    assert found.witness is not None
    names = [rule.name for rule in machine.rules]
    last = list(views(machine, found.witness))[-1]
    assert last.active[names.index("too_fast")]
    assert last.active[names.index("clear")]
    assert released(machine, found.witness) == {"too_fast"}


@pytest.mark.parametrize("way", ["a duration", "another input", "its loss"])
def test_the_rule_becomes_active_at_the_end_if_nothing_delays_its_reset(
    way: str, tmp_path: Path
) -> None:
    machine, (found,) = ask(tmp_path, f"rule clear: {FOUND[way]}")
    assert found.witness is not None
    seen = list(views(machine, found.witness))
    names = [rule.name for rule in machine.rules]
    assert [view.active[names.index("clear")] for view in seen[-2:]] == [False, True]


NOTHING = {
    "excluded": "if speed > 2 m/s then { controllerOk; };",
    "excluded after an answer": "if speed > 2 m/s then { tell; controllerOk; };",
    "gives way": "if key unless too_fast then { controllerOk; };",
    "meant": "if key then { controllerOk; };\npriority clear over too_fast;",
    "meant by way of another": "if key then { controllerOk; };\n"
    "rule other: if wheel > 1 m/s then { tell; };\n"
    "priority clear over other over too_fast;",
    "no reset": "if key then { tell; };",
}


@pytest.mark.parametrize("way", NOTHING)
def test_nothing_is_said_where_no_reset_can_come_or_it_is_meant(way: str, tmp_path: Path) -> None:
    _, found = ask(tmp_path, f"rule clear: {NOTHING[way]}")
    assert found == []


def test_an_order_the_other_way_round_does_not_say_that_it_is_meant(tmp_path: Path) -> None:
    rules = "rule clear: if key then { controllerOk; };\npriority too_fast over clear;"
    _, found = ask(tmp_path, rules)
    assert [each.diagnostic.code for each in found] == ["ROSS716"]


def test_a_rule_resets_itself_once_its_call_is_answered(tmp_path: Path) -> None:
    rules = "rule own: if wheel > 1 m/s then { stopMotor; tell; controllerOk; };"
    machine, found = ask(tmp_path, rules + "\npriority own over too_fast;")
    assert [each.diagnostic.code for each in found] == ["ROSS716"]
    assert found[0].witness is not None
    assert "own" in released(machine, found[0].witness)


def test_a_reset_at_once_does_not_release_its_own_rule(tmp_path: Path) -> None:
    rules = "rule own: if wheel > 1 m/s then { stopMotor; controllerOk; };"
    _, found = ask(tmp_path, rules + "\npriority own over too_fast;")
    assert found == []
