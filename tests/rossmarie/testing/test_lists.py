"""Lists in tests: the elements that are named make the list, and generated tests name them."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from rossmarie.driver.generating import generate_tests
from rossmarie.driver.pipeline import compile_file
from rossmarie.driver.testing import run_test_file
from rossmarie.testing.play import steps_of

RULES = """\
action stop;
input path = topic /plan : nav_msgs/Path .poses up to 3 timeout 1 sec;
input status = topic /diagnostics : diagnostic_msgs/DiagnosticArray .status up to 2 timeout 1 sec;
rule near: if any(p in path: p.pose.position.x > 1 m and p.pose.position.y > 1 m) then { stop; };
rule broken: if any(s in status: s.name == "motor" and s.level >= 2) then { stop; };
rule tilted: if max(p in path: p.pose.orientation.pitch()) > 10 deg then { stop; };
"""
X, Y, W = 0, 1, 7


def sent(folder: Path, *settings: str) -> list[dict[int, list[float]]]:
    """The columns of the messages on /plan that settings, one after the other, make."""
    statements = [f"at {second} s {each};" for second, each in enumerate(settings)]
    path = folder / "rules.ross"
    path.write_text(f'{RULES}test "a list" {{ {" ".join(statements)} expect near active at 9 s; }}')
    compiled = compile_file(path)
    (script,) = compiled.tests
    found = [step.messages[0].arrays for step in steps_of(compiled.machine, script)]
    return [{column: list(values) for column, values in arrays.items()} for arrays in found]


def test_the_elements_that_are_named_make_the_list(tmp_path: Path) -> None:
    found = sent(
        tmp_path,
        "path",
        "path[1].pose.position.x = 2 m",
        "path[0].pose.position = [3, 4, 5] m",
        "path = []",
        "path[0].pose.position.y = 6 m",
    )
    assert [arrays[X] for arrays in found] == [[], [0.0, 2.0], [3.0, 2.0], [], [0.0]]
    assert [arrays[Y] for arrays in found] == [[], [0.0, 0.0], [4.0, 0.0], [], [6.0]]


def test_an_element_stands_upright_until_it_is_turned(tmp_path: Path) -> None:
    before, after = sent(
        tmp_path, "path[0].pose.position.x = 1 m", "path[0].pose.orientation.pitch = 60 deg"
    )
    columns = [column for column, values in before.items() if values == [1.0]]
    (w,) = (column for column in columns if column != X)
    assert after[w] == [pytest.approx(math.cos(math.radians(30)))]


def test_a_list_is_not_known_while_it_is_so_or_too_long(tmp_path: Path) -> None:
    found = sent(tmp_path, "path = unknown", "path", "path[3].pose.position.x = 1 m", "path = []")
    assert [arrays.get(X) for arrays in found] == [None, None, None, []]


def test_an_unknown_field_leaves_the_others(tmp_path: Path) -> None:
    (found,) = sent(tmp_path, "path[0].pose.position.x = unknown, path[0].pose.position.y = 2 m")
    assert math.isnan(found[X][0])
    assert found[Y] == [2.0]


def test_generated_tests_name_elements_and_pass(tmp_path: Path) -> None:
    path = tmp_path / "rules.ross"
    path.write_text(RULES)
    written = generate_tests(path)
    assert "path[0].pose.position.x =" in written.text
    assert 'status[0].name = "motor"' in written.text
    written.path.write_text(written.text)
    outcome = run_test_file(path)
    assert [one.title for ran in outcome.ran for one in ran.found] == []
    missing = set(outcome.coverage.goals) - outcome.coverage.reached
    assert {goal.rule for goal in missing} <= {2}, "only an angle of an element is not proposed"
