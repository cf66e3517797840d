"""`rossmarie.load`: a rules file as a monitor, native and interpreted."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import rossmarie
from rossmarie import Monitor, RulesError
from rossmarie.ir import Event

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


@pytest.fixture(params=["native", "interpreter"])
def monitor(
    request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Monitor:
    if request.param == "interpreter":
        monkeypatch.setenv("CC", "no-such-compiler")
    (tmp_path / "rules.ross").write_text(RULES)
    loaded = rossmarie.load(tmp_path / "rules.ross")
    assert loaded.kind == request.param
    return loaded


def told(monitor: Monitor, events: list[Event]) -> list[str]:
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


def test_silence_is_told(monitor: Monitor) -> None:
    monitor.update(0, {"speed": 0.0, "mode": "auto", "at.x": 0.0, "at.y": 0.0, "at.z": 1.0})
    assert told(monitor, monitor.advance(2 * SECOND)) == [
        "fast activated: input speed (/odom) is older than its timeout"
    ]


def test_an_operator_resets_a_latched_rule(monitor: Monitor) -> None:
    monitor.update(0, {"speed": 0.0, "at.x": 9.0, "at.y": 0.0, "at.z": 1.0})
    monitor.update(1, {"at.x": 0.0, "at.y": 0.0, "at.z": 1.0})
    before = monitor.active
    monitor.reset(2, "out")
    assert (before, monitor.active) == (("out",), ())


def test_a_mistaken_name_is_told(monitor: Monitor) -> None:
    with pytest.raises(KeyError, match="did you mean `speed`"):
        monitor.update(0, {"sped": 1.0})
    with pytest.raises(TypeError, match="a text is wanted"):
        monitor.update(0, {"mode": 1.0})
    with pytest.raises(ValueError, match="not in"):
        monitor.reset(0, "nothing")


NUMBERS = """
action slow;
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 1 sec
input blocked = topic /bumper : std_msgs/Bool timeout 1 sec
rule fast: if speed > 1 m/s for 0.05 sec or blocked then { slow; };
"""


def test_whole_columns_say_the_same_in_both(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "rules.ross"
    path.write_text(NUMBERS)
    random = np.random.default_rng(1)
    times = np.cumsum(random.integers(1, SECOND // 20, 500))
    columns = {
        "speed": np.where(random.random(500) < 0.05, np.nan, random.random(500) * 2),
        "blocked": random.random(500) < 0.1,
    }
    native = rossmarie.load(path).run(times, columns)
    monkeypatch.setenv("CC", "no-such-compiler")
    interpreted = rossmarie.load(path).run(times, columns)
    assert native.active.shape == (500, 1)
    assert 0 < native.active.sum() < 500
    np.testing.assert_array_equal(native.active, interpreted.active)
    assert repr(native.events) == repr(interpreted.events)


def test_the_fast_call(tmp_path: Path) -> None:
    (tmp_path / "rules.ross").write_text(NUMBERS)
    monitor = rossmarie.load(tmp_path / "rules.ross")
    assert monitor.fields("/odom") == ("speed",)
    bumper, odometry = monitor.update_call("/bumper"), monitor.update_call("/odom")
    assert bumper(0, False) == 1  # the speed has not come yet
    assert odometry(1, 0.5) == 1
    assert len(monitor.take_events()) == 2
    assert monitor.active == ()
    with pytest.raises(ValueError, match="not in"):
        monitor.update_call("/elsewhere")


def test_mistakes_in_the_rules_are_raised_all_at_once(tmp_path: Path) -> None:
    (tmp_path / "rules.ross").write_text("rule a: if x then { y; };")
    with pytest.raises(RulesError) as caught:
        rossmarie.load(tmp_path / "rules.ross")
    assert [found.code for found in caught.value.diagnostics] == ["ROSS101", "ROSS104"]
    assert "`x` is not declared" in str(caught.value)
