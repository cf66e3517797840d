"""Declarations of observations and actions: names, units, shapes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rossmarie.guard import Declared, MappingError
from support.c_compiler import needs_c
from support.policy_rules import ACT, OBSERVE, RULES, guard_of

MODE = 'input mode = topic /mode : std_msgs/String;\nrule m: if mode == "a" then { slow; };\n'


def refusal(folder: Path, observe: Any = OBSERVE, act: Any = ACT, more: str = "") -> str:
    with pytest.raises(MappingError) as caught:
        guard_of("python", folder, rules=RULES + more, observe=observe, act=act)
    return str(caught.value)


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"sped": 0}, "no rule reads `sped`; did you mean `speed`?"),
        ({"speed": (0, "mm")}, "`speed` is in m/s, not in mm"),
        ({"speed": (0, "furlong")}, "`speed`: there is no unit `furlong`"),
        ({"speed": (0, "meter")}, "`speed`: there is no unit `meter`; did you mean `m`?"),
        ({"held": (1, "m")}, "`held` is in 1, not in m"),
        ({"scan": 2}, "`scan` is an array: give a slice, such as slice(0, 7)"),
        ({"scan.ranges": slice(2, 4)}, "`scan` and `scan.ranges` are the same field"),
    ],
)
def test_observations_are_refused(tmp_path: Path, changed: Any, words: str) -> None:
    assert refusal(tmp_path, observe={**OBSERVE, **changed}) == words


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"linear.w": 1}, "no rule bounds `linear.w`; did you mean `linear.z`?"),
        ({"x": 1}, "no rule bounds `x`"),
        ({"linear.x": (0, "rad/s")}, "`linear.x` is in m/s, not in rad/s"),
        ({"/cmd_vel.linear.x": 1}, "`linear.x` and `/cmd_vel.linear.x` are the same field"),
    ],
)
def test_actions_are_refused(tmp_path: Path, changed: Any, words: str) -> None:
    assert refusal(tmp_path, act={**ACT, **changed}).startswith(words)


def test_what_rules_read_has_to_be_declared(tmp_path: Path) -> None:
    words = "rules read `held`, `scan`, which `observe` lacks (None: it is never observed)"
    assert refusal(tmp_path, observe={"speed": 0}) == words


def test_what_rules_bound_has_to_be_declared(tmp_path: Path) -> None:
    words = "rules bound `/cmd_vel.linear.x`, which `act` lacks"
    assert refusal(tmp_path, act={"angular.z": 0}).startswith(words)


def test_a_text_is_no_number(tmp_path: Path) -> None:
    text = refusal(tmp_path, observe={**OBSERVE, "mode": 4}, more=MODE)
    assert text == "`mode` is a string, which an array cannot contain"


@needs_c
def test_indexes_count_from_the_end_and_slices_have_steps(tmp_path: Path) -> None:
    observe: Declared = {"speed": -1, "held": 1, "scan": slice(None, None, 3)}
    guard = guard_of("native", tmp_path, observe=observe, act={"linear.x": -1})
    decision = guard.step(0, np.array([2.0, 0.0, 0.0, 0.3, 1.5]), np.array([9.0, 0.8]))
    assert decision.active == ("fast", "near")
    assert decision.action.tolist() == [9.0, -0.1]


@needs_c
def test_units_are_converted(tmp_path: Path) -> None:
    guard = guard_of(
        "native",
        tmp_path,
        observe={**OBSERVE, "speed": (0, "mm/s"), "scan": (slice(2, 4), "cm")},
        act={"linear.x": (0, "km/h"), "angular.z": (1, "deg/s")},
    )
    decision = guard.step(0, np.array([1100, 0, 200, 200.0]), np.array([3.6, 10.0]))
    assert decision.active == ("fast",)
    assert decision.action.tolist() == pytest.approx([0.72, 10.0])
    decision = guard.step(1, np.array([900, 0, 200, 600.0]), np.array([0.0, 0.0]))
    assert decision.active == ("far",)
    assert decision.action[1] == pytest.approx(np.rad2deg(0.5))


EFFORTS = """
input efforts = topic /effort_states : std_msgs/Float64MultiArray .data
    names ["shoulder", "elbow", "wrist"] in Nm;
rule heavy: if efforts["elbow"] > 30 Nm then { slow; };
"""
WRIST = 'rule weak: if efforts["wrist"] > 9 Nm then { slow; };'
ANY = "rule strained: if any(efforts > 90 Nm) then { slow; };"


@pytest.mark.parametrize("more", [EFFORTS, EFFORTS + WRIST, EFFORTS + WRIST + ANY])
@pytest.mark.parametrize("name", ["efforts", "efforts.data"])
def test_an_array_with_declared_names_is_declared_as_a_whole(
    tmp_path: Path, more: str, name: str
) -> None:
    observe = {**OBSERVE, name: (slice(4, 10, 2), "N*mm")}
    guard = guard_of("python", tmp_path, rules=RULES + more, observe=observe)
    seen = np.array([0.0, 0, 2, 2, 9, 0, 31_000, 0, 9, 0])
    decision = guard.step(0, seen, np.array([0.8, 0.1]))
    assert decision.active == ("heavy",)


def test_an_element_with_a_declared_name_is_declared_by_itself(tmp_path: Path) -> None:
    observe = {**OBSERVE, "efforts.elbow": 4, "efforts.wrist": None}
    guard = guard_of("python", tmp_path, rules=RULES + EFFORTS + WRIST, observe=observe)
    decision = guard.step(0, np.array([0.0, 0, 2, 2, 31]), np.array([0.8, 0.1]))
    assert decision.active == ("heavy",)


@pytest.mark.parametrize(
    ("efforts", "words"),
    [
        ({"efforts": slice(2, 4)}, "`efforts` has 3 names, not 2"),
        ({"efforts": 2}, "no rule reads `efforts`; did you mean `efforts.elbow`?"),
        (
            {"efforts": slice(3), "efforts.elbow": 1},
            "`efforts` and `efforts.elbow` are the same field",
        ),
        ({"efforts.elbow": 1}, "rules read `efforts.wrist`, which `observe` lacks"),
    ],
)
def test_declared_names_need_an_array_of_their_length(
    tmp_path: Path, efforts: Any, words: str
) -> None:
    def run() -> None:
        observe = {**OBSERVE, **efforts}
        guard = guard_of("python", tmp_path, rules=RULES + EFFORTS + WRIST, observe=observe)
        guard.step(0, np.zeros(4), np.zeros(2))

    with pytest.raises(MappingError) as caught:
        run()
    assert str(caught.value).startswith(words)


LIST = """\
input path = topic /plan : nav_msgs/Path .poses up to 3;
rule p: if any(q in path: q.pose.position.x < 1 m and q.pose.position.y < 1 m) then { slow; };
"""


@pytest.mark.parametrize("y", [slice(6, 7), None])
def test_all_fields_of_a_list_are_observed_alike(tmp_path: Path, y: slice | None) -> None:
    observe: Any = {**OBSERVE, "path.x": slice(4, 6), "path.y": y}
    guard = guard_of("python", tmp_path, rules=RULES + LIST, observe=observe, act=ACT)
    with pytest.raises(MappingError, match="belong to one list"):
        guard.step(0, np.zeros(8), np.zeros(len(ACT)))


@needs_c
@pytest.mark.parametrize("engine", ["native", "python"])
def test_the_elements_of_a_list_are_observed(tmp_path: Path, engine: str) -> None:
    observe: Any = {**OBSERVE, "path.x": slice(4, 6), "path.y": slice(6, 8)}
    guard = guard_of(engine, tmp_path, rules=RULES + LIST, observe=observe, act=ACT)
    apart, together = [0.5, 9.0, 9.0, 0.5], [9.0, 0.5, 9.0, 0.5]
    for second, (elements, is_near) in enumerate(((apart, False), (together, True))):
        seen = np.array([0.0, 0.0, 5.0, 5.0, *elements])
        decision = guard.step(second * 1_000_000, seen, np.zeros(len(ACT)))
        assert ("p" in decision.active) is is_near


CLOUD = """
input cloud = topic /points : sensor_msgs/PointCloud2 .points up to 8;
rule p: if any(p in cloud: p.x < 1 m and p.z < 1 m) then { slow; };
rule q: if count(p in cloud: p.intensity < 1) > 1 then { slow; };
"""


@needs_c
@pytest.mark.parametrize("engine", ["native", "python"])
def test_points_without_a_place_are_left_out(tmp_path: Path, engine: str) -> None:
    columns = {"cloud.x": slice(4, 7), "cloud.z": slice(7, 10), "cloud.intensity": slice(10, 13)}
    observe: Any = {**OBSERVE, **columns}
    guard = guard_of(engine, tmp_path, rules=RULES + CLOUD, observe=observe, act=ACT)
    nan = np.nan
    for second, (x, z, active) in enumerate(
        (
            ([9.0, nan, 9.0], [9.0, 0.0, 9.0], ["q"]),
            ([0.0, 9.0, nan], [nan, nan, nan], []),
            ([9.0, nan, 0.5], [nan, 0.5, 0.5], ["p"]),
            ([nan, nan, 0.5], [0.5, 0.5, 9.0], []),
        )
    ):
        seen = np.array([0.0, 0.0, 5.0, 5.0, *x, *z, 0.0, 0.0, 0.0])
        decision = guard.step(second * 1_000_000, seen, np.zeros(len(ACT)))
        assert [name for name in decision.active if name in "pq"] == active
