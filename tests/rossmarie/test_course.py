"""The course for guards of mobile bases: its shapes, what it measures, and guards on it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from support.benchmarks import imported
from support.parts import NAV2_MONITOR, needs

MODULES = (
    "course_shapes",
    "course_scenes",
    "course",
    "course_rules",
    "nav2_settings",
    "nav2_model",
    "course_node",
    "nav2_node",
    "rules_node",
    "beside_nav2",
)
METERS = st.floats(-3.0, 3.0).map(lambda number: round(number, 3))
WALLS = st.tuples(METERS, METERS, METERS, METERS).filter(
    lambda wall: math.dist(wall[:2], wall[2:]) > 0.01
)
PEOPLE = st.tuples(METERS, METERS, st.floats(0.1, 0.5))


@pytest.fixture(scope="module")
def modules() -> Iterator[dict[str, Any]]:
    with imported(MODULES) as found:
        yield found


def contender(modules: dict[str, Any], guard: Callable[..., Any]) -> Any:
    return modules["course"].Contender("a guard", lambda: nullcontext(guard))


def driven(modules: dict[str, Any], guard: Callable[..., Any], scene: str, seed: int = 0) -> Any:
    return modules["course"].run(scene, contender(modules, guard), seed)


# --- shapes --------------------------------------------------------------------------------------


def points_of(wall: Sequence[float]) -> Any:
    share = np.linspace(0.0, 1.0, 2001)[:, None]
    return np.array(wall[:2]) * (1 - share) + np.array(wall[2:]) * share


@given(wall=WALLS)
def test_the_gap_to_a_wall_is_that_of_its_closest_point(modules: dict[str, Any], wall: Any) -> None:
    shapes = modules["course_shapes"]
    outline = shapes.Outline(0.25, 0.2)
    beside = np.maximum(np.abs(points_of(wall)) - [0.25, 0.2], 0.0)
    found = shapes.gap(shapes.Around([wall], []), outline)
    assert found == pytest.approx(np.hypot(*beside.T).min(), abs=5e-3)


@given(wall=WALLS, people=st.lists(PEOPLE, max_size=2))
def test_the_free_way_ends_where_the_moved_outline_touches(
    modules: dict[str, Any], wall: Any, people: Any
) -> None:
    shapes = modules["course_shapes"]
    outline = shapes.Outline(0.25, 0.2)
    around = shapes.Around([wall], people)
    free = shapes.gap_ahead(around, outline)
    if 0.0 < free < math.inf:
        there = shapes.seen_from(shapes.Pose(free, 0.0, 0.0), around.walls, around.people)
        assert shapes.gap(there, outline) < 1e-6
    if shapes.gap(around, outline) > 0.0:
        assert free > 0.0
    if free > 0.02 and shapes.gap(around, outline) > 0.0:
        distance = min(free, 5.0) - 0.01
        before = shapes.seen_from(shapes.Pose(distance, 0.0, 0.0), around.walls, around.people)
        assert shapes.gap(before, outline) > 0.0


@given(wall=WALLS, person=PEOPLE)
def test_a_beam_ends_on_the_first_thing(modules: dict[str, Any], wall: Any, person: Any) -> None:
    shapes = modules["course_shapes"]
    assume(math.hypot(*person[:2]) > person[2])  # else the lidar is in it
    x, y, end_x, end_y = wall
    assume(abs(x * end_y - y * end_x) > 1e-3)  # a beam does not hit a wall that lies along it
    angles = np.linspace(-np.pi, np.pi, 90, endpoint=False)
    around = shapes.Around([wall], [person])
    for angle, far in zip(angles, shapes.ranges(around, angles), strict=True):
        if math.isfinite(far):
            x, y = far * math.cos(angle), far * math.sin(angle)
            tip = shapes.Outline(0.0, 0.0)
            there = shapes.seen_from(shapes.Pose(x, y, 0.0), around.walls, around.people)
            assert shapes.gap(there, tip) < 1e-6
            closer = shapes.seen_from(
                shapes.Pose(0.99 * x, 0.99 * y, 0.0), around.walls, around.people
            )
            assert shapes.gap(closer, tip) > 0.0


# --- what the course measures --------------------------------------------------------------------


def test_only_some_scenes_ask_for_a_guard(modules: dict[str, Any]) -> None:
    for name, make in modules["course_scenes"].SCENES.items():
        outcome = driven(modules, modules["course"].unguarded, name)
        is_passable = make(np.random.default_rng(0)).is_passable
        assert outcome.is_at_goal == is_passable, name
        assert (outcome.contact_speed == 0.0) == is_passable, name
        assert (outcome.stops, outcome.falsely_slow_s) == (0, 0.0)


def test_runs_are_the_same_each_time(modules: dict[str, Any]) -> None:
    guard = modules["nav2_model"].CollisionMonitor(modules["nav2_settings"].ZONES)
    one, other = (
        replace(driven(modules, guard, "person crosses", seed=3), cpu_ns_of_scan=0.0)
        for _ in range(2)
    )
    assert str(one) == str(other)
    third = driven(modules, guard, "person crosses", seed=4)
    assert str(replace(third, cpu_ns_of_scan=0.0)) != str(one)


def braking_at(modules: dict[str, Any], meters: float) -> Callable[..., Any]:
    """A guard that knows how far the wall is: it stops the base at a distance from the front."""
    course = modules["course"]

    def guard(scan: Any, odometry: Any, command: Any, at_ns: int) -> Any:
        if scan is None:
            return course.Command(0.0, 0.0)
        ahead = float(scan.ranges[len(scan.ranges) // 2]) - 0.25
        return course.Command(0.0, 0.0) if ahead < meters else command

    return guard


def test_the_reaction_counts_from_the_last_instant_for_the_brakes(modules: dict[str, Any]) -> None:
    early = driven(modules, braking_at(modules, 0.7), "wall ahead")
    late = driven(modules, braking_at(modules, 0.15), "wall ahead")
    assert early.contact_speed == 0.0
    assert early.reaction_s < 0.0 < late.reaction_s
    assert late.contact_speed > 0.0, "the brakes need 0.27 m"
    assert early.reaction_s == pytest.approx(-(0.7 - 0.8**2 / 2.4) / 0.8, abs=0.25)


def test_stops_are_false_while_nothing_is_near(modules: dict[str, Any]) -> None:
    course = modules["course"]

    def never(scan: Any, odometry: Any, command: Any, at_ns: int) -> Any:
        return course.Command(0.0, 0.0)

    outcome = driven(modules, never, "wall ahead")
    assert (outcome.stops, outcome.false_stops, outcome.distance_m) == (1, 1, 0.0)
    right = driven(modules, braking_at(modules, 0.7), "wall ahead")
    assert (right.stops, right.false_stops) == (1, 0)
    docking = driven(modules, braking_at(modules, 0.2), "docking station")
    assert docking.false_stops == docking.stops == 1


def test_a_stop_because_of_silence_is_right(modules: dict[str, Any]) -> None:
    course = modules["course"]

    def listening(scan: Any, odometry: Any, command: Any, at_ns: int) -> Any:
        is_old = scan is None or at_ns - scan.stamp_ns > 0.4 * course.NS
        return course.Command(0.0, 0.0) if is_old else command

    outcome = driven(modules, listening, "lidar falls silent")
    assert (outcome.stops, outcome.false_stops, outcome.contact_speed) == (1, 0, 0.0)
    assert 0.3 <= outcome.blind_s <= 0.45


# --- guards --------------------------------------------------------------------------------------


def test_rules_drive_the_course(modules: dict[str, Any], tmp_path: Path) -> None:
    rules = modules["course_rules"].RANGES.contender(tmp_path)
    outcome = modules["course"].run("wall ahead", rules, 0)
    assert outcome.contact_speed == 0.0
    assert outcome.stops == 1
    assert outcome.false_stops == 0
    assert outcome.cpu_ns_of_scan > 0.0
    behind = modules["course"].run("someone behind", rules, 0)
    assert behind.false_stops == 1, "the least of all readings is behind it"


@pytest.mark.parametrize("scene", ["person steps out", "narrow corridor", "docking station"])
@pytest.mark.parametrize("guard", ["zones", "approach"])
def test_rules_can_say_what_settings_of_nav2_say(
    modules: dict[str, Any], tmp_path: Path, guard: str, scene: str
) -> None:
    page, course = modules["beside_nav2"], modules["course"]
    (settings,) = (each for each in modules["nav2_settings"].ALL if each.name == f"Nav2: {guard}")
    (rules,) = (each for each in modules["course_rules"].ALL if each.name == f"rules: {guard}")
    found, wanted = (
        [course.run(scene, each, 1)]
        for each in (rules.contender(tmp_path), page.modelled(settings))
    )
    assert page.compared(found, wanted) == page.Comparison(1, 1)


@pytest.mark.parametrize("scene", ["wall ahead", "narrow corridor", "readings of 0"])
def test_a_base_that_keeps_its_way_of_stopping_stops_for_nothing_else(
    modules: dict[str, Any], tmp_path: Path, scene: str
) -> None:
    course = modules["course"]
    rules = modules["course_rules"].STOPPING.contender(tmp_path)
    outcome = course.run(scene, rules, 1)
    assert (outcome.contact_speed, outcome.false_stops, outcome.falsely_slow_s) == (0.0, 0, 0.0)


@needs(NAV2_MONITOR)
def test_the_node_of_nav2_does_what_its_model_does(modules: dict[str, Any], tmp_path: Path) -> None:
    page = modules["beside_nav2"]
    for settings in modules["nav2_settings"].ALL:
        node = modules["nav2_node"].Node(settings, tmp_path / "node")
        try:
            for scene in ("person steps out", "readings of 0", "lidar falls silent"):
                found, wanted = (
                    [modules["course"].run(scene, each, 1)]
                    for each in (node.contender, page.modelled(settings))
                )
                assert page.compared(found, wanted) == page.Comparison(1, 1), scene
        finally:
            node.end()


def test_a_row_tells_of_all_runs(modules: dict[str, Any]) -> None:
    page, course = modules["beside_nav2"], modules["course"]
    one = course.Outcome(-0.5, math.nan, 0.3, 0.0, 1, 0, 0.4, 4.0, True, 1e5)
    other = replace(one, reaction_s=0.25, least_gap_m=0.0, contact_speed=0.4, is_at_goal=False)
    unmoved = replace(one, reaction_s=math.nan)
    assert page.row("us", [one, other, unmoved]) == (
        "| us | 1/3 | -0.12, +0.25 | 0.00 | 1.0 | 0.0 | 0.4 | 4.0 | 2/3 |"
    )
    assert page.compared([one, unmoved], [replace(one, cpu_ns_of_scan=7.0), other]) == (
        page.Comparison(2, 1)
    )
