"""`rossmarie.load`: a rules file as a monitor, native and in Python."""

from __future__ import annotations

from pathlib import Path

import pytest

import rossmarie
from rossmarie import Monitor, RulesError, ir
from rossmarie.ir import Event
from support.engines import ENGINES, load

SECOND = 1_000_000_000
RULES = """
action slow;
action stop;
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 1 sec
input mode = topic /mode : std_msgs/String
input at = topic /pose : geometry_msgs/Point timeout 5 sec
rule fast: if speed > 1 m/s for 0.5 sec and mode == "auto" then { slow; };
rule out: if at not in [-1, 1, -1, 1, 0, 2] m then { stop; } latched until reset;
"""


@pytest.fixture(params=ENGINES)
def engine(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture
def monitor(engine: str, tmp_path: Path) -> Monitor:
    return load(RULES, engine, tmp_path)


def reported(monitor: Monitor, events: list[Event]) -> list[str]:
    return [monitor.explain(event) for event in events]


def test_updates_go_by_name(monitor: Monitor) -> None:
    middle = {"at.x": 0.0, "at.y": 0.0, "at.z": 1.0}
    assert monitor.update(0, {"speed": 0.0, "mode": "auto", **middle}) == []
    assert monitor.update(SECOND // 10, {"speed": 2.0}) == []
    assert monitor.next_wake() == SECOND // 10 + SECOND // 2
    (event,) = monitor.advance(SECOND)
    assert monitor.explain(event).startswith("fast activated: ")
    assert monitor.active == ("fast",)
    (event,) = monitor.update(SECOND, {"mode": "manual"})
    assert monitor.explain(event).startswith("fast cleared: ")


def test_a_fresh_one_has_seen_nothing(monitor: Monitor) -> None:
    moving: dict[str, float | str] = {"speed": 2.0, "mode": "auto"}
    moving |= {"at.x": 0.0, "at.y": 0.0, "at.z": 1.0}
    monitor.update(0, moving)
    monitor.advance(SECOND // 2)
    fresh = monitor.fresh()
    assert (monitor.active, fresh.active) == (("fast",), ())
    assert fresh.update(SECOND // 2, moving) == []
    assert (monitor.active, fresh.active) == (("fast",), ())


def test_silence_is_reported(monitor: Monitor) -> None:
    monitor.update(0, {"speed": 0.0, "mode": "auto", "at.x": 0.0, "at.y": 0.0, "at.z": 1.0})
    assert reported(monitor, monitor.advance(2 * SECOND)) == [
        "fast activated: input speed (/odom) is older than its timeout"
    ]


def test_an_operator_resets_a_latched_rule(monitor: Monitor) -> None:
    monitor.update(0, {"speed": 0.0, "at.x": 9.0, "at.y": 0.0, "at.z": 1.0})
    monitor.update(1, {"at.x": 0.0, "at.y": 0.0, "at.z": 1.0})
    before = monitor.active
    monitor.reset(2, "out")
    assert (before, monitor.active) == (("out",), ())


def test_a_mistaken_name_is_reported(monitor: Monitor) -> None:
    with pytest.raises(KeyError, match="did you mean `speed`"):
        monitor.update(0, {"sped": 1.0})
    with pytest.raises(TypeError, match="expected a string"):
        monitor.update(0, {"mode": 1.0})
    with pytest.raises(ValueError, match="not in"):
        monitor.reset(0, "nothing")


NUMBERS = """
action slow;
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 1 sec
input blocked = topic /bumper : std_msgs/Bool timeout 1 sec
rule fast: if speed > 1 m/s for 0.05 sec or blocked then { slow; };
"""


def test_the_fast_call(engine: str, tmp_path: Path) -> None:
    monitor = load(NUMBERS, engine, tmp_path)
    assert monitor.fields("/odom") == ("speed",)
    bumper, odometry = monitor.update_call("/bumper"), monitor.update_call("/odom")
    assert bumper(0, False) == 1  # the speed has not come yet
    assert odometry(1, 0.5) == 1
    assert len(monitor.take_events()) == 2
    assert monitor.active == ()
    with pytest.raises(ValueError, match="not in"):
        monitor.update_call("/elsewhere")


AGES = """
action stop;
input fix = topic /fix : sensor_msgs/NavSatFix timeout 1 sec
rule blind: if age(fix) > 0.5 sec then { stop; };
"""


def test_an_input_with_only_an_age_arrives_by_its_name(engine: str, tmp_path: Path) -> None:
    monitor = load(AGES, engine, tmp_path)
    (never,) = reported(monitor, monitor.advance(0))
    assert never == "blind activated: input fix (/fix) has never been received"
    (cleared,) = monitor.update(1, {"fix": 0.0})
    assert monitor.explain(cleared).startswith("blind cleared")
    with pytest.raises(KeyError, match="did you mean `fix`"):
        monitor.update(2, {"fixx": 0.0})


ELEMENT = """
action stop;
input r = topic /scan : sensor_msgs/LaserScan .ranges timeout 1 sec
input r2 = topic /other : std_msgs/Float64 in m timeout 1 sec
rule near: if any(r < 0.5 m) or r[5] < 1 m or r2 < 1 m then { stop; };
"""


def test_an_array_keeps_its_name_beside_one_of_its_elements(engine: str, tmp_path: Path) -> None:
    monitor = load(ELEMENT, engine, tmp_path)
    monitor.update(0, {"r": [9.0, 0.1], "r.5": 9.0, "r2": 9.0})
    assert monitor.active == ("near",)
    assert monitor.fields("/scan") == ("r.5",)


def test_the_suggestion_for_an_input_with_several_fields_is_one_of_them(monitor: Monitor) -> None:
    with pytest.raises(KeyError, match=r"did you mean `at\.x`"):
        monitor.update(0, {"at": 1.0})


@pytest.mark.parametrize(
    ("blocked", "active"),
    [(float("nan"), ("fast",)), (float("inf"), ("fast",)), (0.0, ()), (0.25, ("fast",))],
)
def test_a_flag_is_one_of_three(
    engine: str, tmp_path: Path, blocked: float, active: tuple[str, ...]
) -> None:
    monitor = load(NUMBERS, engine, tmp_path)
    monitor.update(0, {"speed": 0.0, "blocked": blocked})
    assert monitor.active == active


@pytest.mark.parametrize("ranges", [1.0, "near", ["near"], [None], [[1.0]]])
def test_an_array_is_a_sequence_of_numbers(engine: str, tmp_path: Path, ranges: object) -> None:
    monitor = load(ELEMENT, engine, tmp_path)
    with pytest.raises(TypeError, match="array of numbers"):
        monitor.update(0, {"r": ranges})  # type: ignore[dict-item]
    assert monitor.next_wake() is None


def test_an_instant_is_an_integer(monitor: Monitor) -> None:
    with pytest.raises(TypeError, match="integer"):
        monitor.update(0.5, {"speed": 1.0})  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="integer"):
        monitor.advance(0.5)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="integer"):
        monitor.reset(0.5)  # type: ignore[arg-type]
    assert monitor.next_wake() is None


def test_mistakes_in_the_rules_are_raised_all_at_once(tmp_path: Path) -> None:
    (tmp_path / "rules.ross").write_text("rule a: if x then { y; };")
    with pytest.raises(RulesError) as caught:
        rossmarie.load(tmp_path / "rules.ross")
    assert [found.code for found in caught.value.diagnostics] == ["ROSS101", "ROSS104"]
    assert "`x` is not declared" in str(caught.value)


def test_rules_that_no_target_can_run_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rules = tmp_path / "rules.ross"
    rules.write_text(RULES, encoding="utf-8")
    monkeypatch.setattr(ir, "MOST_EVALUATIONS", 3)
    with pytest.raises(RulesError) as caught:
        rossmarie.load(rules)
    *_, found = caught.value.diagnostics  # behind the warnings
    assert (found.code, found.primary.span.text) == ("ROSS502", "speed > 1 m/s for 0.5 sec")
