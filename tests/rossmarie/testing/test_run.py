"""Tests of rules: what arrives, and what comes of what is expected."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from rossmarie.driver.testing import UnknownTestError, run_test_file
from rossmarie.interpreter import Interpreter
from rossmarie.ir import FieldKind, Slot
from rossmarie.ir.carried import raw_of
from rossmarie.native import load_native
from rossmarie.targets import c99
from rossmarie.testing.findings import differences
from rossmarie.testing.play import steps_of
from rossmarie.testing.run import run
from rossmarie.testing.unread import unread
from support.testing import INPUTS, compiled, notes, run_text

STEEP = "rule steep: if orientation.pitch() > 10 deg for 1.0 sec then { slow; };\n"
FAST = "rule fast: if speed > 1 m/s then { slow; };\n"
LATCHED = "rule near: if min(ranges) < 0.5 m then { stop; } latched until reset;\n"


def test_expectations_that_are_met(tmp_path: Path) -> None:
    text = """test "a" {
        every 0.1 s from 0 s to 5 s orientation;
        at 2 s orientation.pitch = 12 deg;
        at 4 s orientation.pitch = 5 deg;
        expect steep inactive from 0 s until 3 s;
        expect steep active from 3 s until 4 s;
        expect steep inactive from 4 s to 5 s;
    }"""
    found = run_text(tmp_path, STEEP + text)
    assert notes(found) == []
    assert found.has_c


@pytest.mark.parametrize(
    ("expected", "title", "note"),
    [
        ("active at 2.5 s", "inactive at 2.5 s", "it became active at 3 s, because"),
        ("inactive at 3 s", "active at 3 s", "orientation.pitch() = 12 deg, > 10 deg for 1.0 sec"),
        ("active from 3 s to 5 s", "inactive at 4 s", "it was cleared at 4 s, because"),
        ("inactive from 0 s to 3 s", "active at 3 s", "it became active at 3 s"),
        ("active from 1 s until 3 s", "inactive at 1 s", "it became active at 3 s"),
    ],
)
def test_an_expectation_that_is_not_met_tells_what_happened_instead(
    tmp_path: Path, expected: str, title: str, note: str
) -> None:
    text = f"""test "a" {{
        every 0.1 s from 0 s to 5 s orientation;
        at 2 s orientation.pitch = 12 deg;
        at 4 s orientation.pitch = 5 deg;
        expect steep {expected};
    }}"""
    ((found, why),) = notes(run_text(tmp_path, STEEP + text))
    assert found == f"`steep` is {title}"
    assert note in why


def test_a_rule_that_never_became_active(tmp_path: Path) -> None:
    text = 'test "a" { at 0 s speed = 0 m/s; expect fast active at 0.1 s; }'
    assert notes(run_text(tmp_path, FAST + text)) == [
        ("`fast` is inactive at 0.1 s", "it never became active")
    ]


def test_an_input_that_falls_silent_is_stale(tmp_path: Path) -> None:
    text = """test "a" {
        every 0.1 s from 0 s to 1 s speed = 0 m/s;
        expect fast inactive from 0 s until 1.5 s;
        expect fast active from 1.5 s to 2 s;
    }"""
    assert notes(run_text(tmp_path, FAST + text)) == []


def test_a_test_begins_at_zero_without_any_message(tmp_path: Path) -> None:
    text = 'test "a" { at 1 s speed = 0 m/s; expect fast active from 0 s until 1 s; }'
    assert notes(run_text(tmp_path, FAST + text)) == []


def test_a_reset_comes_after_the_messages_of_its_instant(tmp_path: Path) -> None:
    text = """test "a" {
        every 0.1 s from 0 s to 5 s ranges;
        at 0 s ranges = [5, 6] m;
        at 1 s ranges[1] = 0.4 m;
        at 2 s reset;
        at 3 s ranges[1] = 6 m, ranges[0] = 4 m;
        at 4 s reset near;
        expect near inactive from 0 s until 1 s;
        expect near active from 1 s until 4 s;
        expect near inactive from 4 s to 5 s;
    }
    test "b" {
        at 0 s ranges = [0.1] m;
        at 0.1 s ranges = [5] m;
        at 0.1 s reset;
        expect near active at 0 s;
        expect near inactive at 0.1 s;
    }"""
    assert notes(run_text(tmp_path, LATCHED + text)) == []


def test_strings_flags_and_unknown_values(tmp_path: Path) -> None:
    rule = 'rule odd: if state == "stuck" and not ok then { slow; };\n'
    text = """test "a" {
        at 0 s state = "fine", ok = true;
        at 0.1 s state = "stuck";
        at 0.2 s ok = false;
        at 0.3 s ok = unknown, state = "fine";
        at 0.4 s state = "stuck";
        expect odd inactive from 0 s until 0.2 s;
        expect odd active from 0.2 s until 0.3 s;
        expect odd inactive from 0.3 s until 0.4 s;
        expect odd active at 0.4 s;
    }"""
    assert notes(run_text(tmp_path, rule + text)) == []


def test_what_nobody_set_is_what_a_new_message_holds(tmp_path: Path) -> None:
    rules = """
rule upright: if orientation.w == 1 and norm(acceleration) == 0 m/s^2 then { slow; };
rule empty: if min(ranges) < 1 m then { slow; };
"""
    text = """test "a" {
        at 0 s orientation, ranges;
        expect upright active at 0 s;
        expect empty active at 0 s;
    }"""
    assert notes(run_text(tmp_path, rules + text)) == []


def test_messages_of_one_topic_are_one_message(tmp_path: Path) -> None:
    rule = "rule tilted: if orientation.pitch() > 10 deg then { slow; };\n"
    text = """test "a" {
        every 0.1 s from 0 s to 1 s acceleration;
        expect tilted inactive from 0 s to 1 s;
    }"""
    assert notes(run_text(tmp_path, rule + text)) == []


def test_a_number_in_another_unit_arrives_as_the_rules_mean_it(tmp_path: Path) -> None:
    rule = "rule quick: if speed >= 30 km/h then { slow; };\n"
    text = """test "a" {
        at 0 s speed = 30 km/h;
        at 0.1 s speed = 29.99 km/h;
        expect quick active at 0 s;
        expect quick inactive at 0.1 s;
    }"""
    assert notes(run_text(tmp_path, rule + text)) == []


@pytest.mark.parametrize("scale", [0.001, math.pi / 180, 1 / 3.6, 1000.0])
def test_a_number_in_the_unit_of_its_message_arrives_bit_for_bit(scale: float) -> None:
    slot = Slot(0, ("data",), FieldKind.REAL, scale, 0.0, "")
    written = [count / 10 for count in range(1, 2000)]
    assert [raw_of(slot, each * scale) * scale for each in written] == [
        each * scale for each in written
    ]


def test_statements_of_one_instant_are_one_update_in_their_order(tmp_path: Path) -> None:
    text = """test "a" {
        every 1 s from 0 s to 2 s speed = 0 m/s;
        at 1 s speed = 2 m/s;
        expect fast inactive at 0 s;
    }"""
    found = compiled(tmp_path, FAST + text)
    steps = list(steps_of(found.machine, found.tests[0]))
    assert [(step.at_ns, step.messages[0].slots[0]) for step in steps] == [
        (0, 0.0),
        (1_000_000_000, 2.0),
        (2_000_000_000, 0.0),
    ]


# --- files -----------------------------------------------------------------------------------


def test_the_file_of_tests_beside_the_rules_is_run_as_well(tmp_path: Path) -> None:
    rules, beside = tmp_path / "rules.ross", tmp_path / "rules.tests.ross"
    own = 'test "own" { at 0 s speed = 2 m/s; expect fast active at 0 s; }'
    rules.write_text(INPUTS + FAST + own, encoding="utf-8")
    other = 'test "other" { at 0 s speed = 0 m/s; expect fast active at 0 s; }'
    beside.write_text(f'import "rules.ross";\n{other}', encoding="utf-8")
    for path in (rules, beside):
        found = run_test_file(path)
        assert [ran.script.name for ran in found.ran] == ["own", "other"]
        assert [bool(ran.found) for ran in found.ran] == [False, True]


def test_tests_are_chosen_by_name(tmp_path: Path) -> None:
    path = tmp_path / "rules.ross"
    text = "".join(
        f'test "{name}" {{ expect fast active at 0 s; }}\n' for name in ("a1", "a2", "b")
    )
    path.write_text(INPUTS + FAST + text, encoding="utf-8")
    assert [ran.script.name for ran in run_test_file(path, ["a*"]).ran] == ["a1", "a2"]
    with pytest.raises(UnknownTestError, match="there is no test `c`"):
        run_test_file(path, ["b", "c"])


REPORTED = 'test "a" { at 0 s speed = 2 m/s; expect fast active at 0 s; }'


def test_engines_that_differ_are_distinguished(tmp_path: Path) -> None:
    found = compiled(tmp_path, FAST + REPORTED)
    (script,) = found.tests
    verdicts = run(Interpreter(found.machine), found.machine, script)
    assert list(differences(found.machine, script, verdicts, list(verdicts))) == []
    (finding,) = differences(found.machine, script, verdicts, [])
    assert finding.code == "ROSS761"
    assert finding.primary.text == "interpreter: fast activated at 0 s; C: nothing more"


def test_c_that_differs_fails_a_test(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    other = compiled(tmp_path, FAST.replace("> 1 m/s", "> 3 m/s")).machine
    native = load_native(other, c99.generate_loadable(other))
    monkeypatch.setattr("rossmarie.driver.testing._native", lambda _: native)
    (ran,) = run_text(tmp_path, FAST + REPORTED).ran
    assert [finding.code for finding in ran.found] == ["ROSS761"]


EFFORTS = """
input efforts = topic /effort_states : std_msgs/Float64MultiArray .data
    names ["shoulder", "elbow", "wrist"] in Nm timeout 0.1 sec;
rule heavy: if efforts["elbow"] > 30 Nm then { stop; };
rule strained: if any(efforts > 90 Nm) then { stop; };
"""


def test_s55_declared_names_set_an_array_with_as_many_elements(tmp_path: Path) -> None:
    text = """test "a" {
        at 0 s efforts["elbow"] = 3 Nm, efforts["wrist"] = 91 Nm;
        every 0.05 s from 0 s to 5 s efforts;
        at 1 s efforts["elbow"] = 31 Nm, efforts["wrist"] = unknown;
        at 2 s efforts = [1, 29, 91] Nm;
        at 3 s efforts = [1, 2] Nm;
        at 4 s efforts = [1, 2, 3] Nm;
        at 4.51 s efforts[3] = 4 Nm;
        expect heavy inactive from 0 s until 1 s;
        expect heavy active from 1 s until 2 s;
        expect heavy inactive from 2 s until 3 s;
        expect heavy active from 3 s until 4 s;
        expect heavy inactive from 4 s until 4.51 s;
        expect heavy active from 4.51 s to 5 s;
        expect strained active from 0 s until 1 s;
        expect strained inactive from 3 s to 5 s;
    }"""
    found = run_text(tmp_path, EFFORTS + text)
    assert notes(found) == []
    assert found.has_c


def test_s55_an_element_that_is_set_by_its_name_makes_an_array_of_that_length(
    tmp_path: Path,
) -> None:
    text = """test "a" {
        at 0 s efforts["elbow"] = 3 Nm;
        at 0.05 s efforts["elbow"] = 31 Nm;
        expect heavy inactive from 0 s until 0.05 s;
        expect heavy active at 0.05 s;
    }"""
    assert notes(run_text(tmp_path, EFFORTS + text)) == []


def test_s55_all_elements_count_where_one_is_read_by_a_declared_name(tmp_path: Path) -> None:
    heavy = EFFORTS[: EFFORTS.index("rule strained")]
    text = """test "a" {
        at 0 s efforts[0] = 3 Nm, efforts["wrist"] = 3 Nm;
        expect heavy inactive at 0 s;
    }"""
    found = compiled(tmp_path, heavy + text)
    assert list(unread(found.machine, found.tests)) == []
