"""Clouds in tests: the points that are named make the cloud, those without a place are none."""

from __future__ import annotations

from pathlib import Path

from rossmarie.driver.generating import generate_tests
from rossmarie.driver.pipeline import compile_file
from rossmarie.driver.testing import run_test_file
from rossmarie.testing.goals import Aspect
from rossmarie.testing.play import steps_of

RULES = """\
action stop;
input cloud = topic /points : sensor_msgs/PointCloud2 .points up to 3 timeout 1 sec;
rule near: if any(p in cloud: p.x > 1 m and p.intensity > 1) then { stop; };
rule few: if count(p in cloud: true) < 2 then { stop; };
"""
X = 0


def sent(folder: Path, *settings: str) -> list[dict[int, list[float]]]:
    """The columns of the clouds that settings, one after the other, make."""
    statements = [f"at {second} s {each};" for second, each in enumerate(settings)]
    path = folder / "rules.ross"
    path.write_text(f'{RULES}test "a list" {{ {" ".join(statements)} expect near active at 9 s; }}')
    compiled = compile_file(path)
    (script,) = compiled.tests
    found = [step.messages[0].arrays for step in steps_of(compiled.machine, script)]
    return [{column: list(values) for column, values in arrays.items()} for arrays in found]


def test_points_without_a_place_are_left_out(tmp_path: Path) -> None:
    found = sent(
        tmp_path,
        "cloud[0] = [1, 2, 3] m, cloud[2].x = 5 m",
        "cloud[1].x = unknown",
        "cloud[0].z = unknown",  # no rule reads it, and it is a part of the place all the same
        "cloud[0].z = 0 m, cloud[1].x = 2 m, cloud[1].intensity = unknown",
        "cloud = unknown",
        "cloud[3].x = 1 m",
        "cloud = []",
    )
    assert [arrays.get(X) for arrays in found] == [
        [1.0, 0.0, 5.0],
        [1.0, 5.0],
        [5.0],
        [1.0, 2.0, 5.0],
        None,
        None,
        [],
    ]


def test_generated_tests_set_points_and_pass(tmp_path: Path) -> None:
    path = tmp_path / "rules.ross"
    path.write_text(RULES)
    written = generate_tests(path)
    assert "cloud[0].x =" in written.text
    assert "cloud[0].intensity =" in written.text
    written.path.write_text(written.text)
    outcome = run_test_file(path)
    assert [one.title for ran in outcome.ran for one in ran.found] == []
    missing = set(outcome.coverage.goals) - outcome.coverage.reached
    assert {goal.aspect for goal in missing} == {Aspect.AT}, "only a number of points is not solved"
