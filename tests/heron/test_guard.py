"""The guard in this process does what the generated nodes do."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest

from heron import messages
from heron.guard import InProcessGuard, UnsupportedEffectError
from heron.topics import Topic
from rossmarie.ir import TaskCommandKind
from rossmarie.ir.skills import RunningSkill, SkillArgument, SkillContext
from support.guarding import UNFILTERED, Guarded

SECOND = 1_000_000_000
SKILLFUL = Path(__file__).parents[1] / "fixtures" / "skillful"
_TYPES = {"scan": "sensor_msgs/LaserScan", "mode": "std_msgs/String", "lamp": "std_msgs/Bool"}
HEAD = """
system robot {
    topic /cmd_vel : geometry_msgs/Twist;
    node planner { publishes /cmd_vel; }
}
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec;
action slow { limit /cmd_vel { linear.x in [-0.2, 0.2] m/s; } ramp 0.3 m/s^2; }
action back { publish /cmd_vel { linear.x = -0.1 m/s; } at 10 Hz; }
action push { publish /drive/boost : std_msgs/Bool { data = true; } at 10 Hz; }
action stop { block /cmd_vel; } latched until reset;
"""


def started(tmp_path: Path, rules: str) -> tuple[Guarded, InProcessGuard]:
    path = tmp_path / "rules.ross"
    path.write_text(HEAD + rules, encoding="utf-8")
    guarded = Guarded()
    return guarded, guarded.start(path)


def test_no_command_passes_before_all_inputs_have_arrived(tmp_path: Path) -> None:
    guarded, guard = started(tmp_path, "rule r: if speed > 1 m/s then { slow; };")
    guarded.command(0.5)
    assert guarded.sent[-1][1] == 0.0
    guarded.speed(0.0)
    guarded.command(0.5)
    assert guarded.sent[-1][1] == 0.5
    assert not guard.active


def test_inputs_that_only_start_are_not_stale(tmp_path: Path) -> None:
    rules = """
    input tilt = topic /imu/data : sensor_msgs/Imu .linear_acceleration.x timeout 0.2 sec;
    rule r: if speed > 1 m/s or tilt > 1 m/s^2 then { stop; };
    """
    guarded, guard = started(tmp_path, rules)
    guarded.speed(0.0)
    assert not guard.verdicts


def test_after_some_patience_an_input_that_is_missing_counts_as_stale(tmp_path: Path) -> None:
    guarded, guard = started(tmp_path, "rule r: if speed > 1 m/s then { stop; };")
    guarded.pass_time(guard, 4 * SECOND, lambda: None)
    assert not guard.active
    guarded.pass_time(guard, 6 * SECOND, lambda: guarded.command(0.5))
    assert guard.active == ("r",)
    assert {speed for _, speed in guarded.sent} == {0.0}


def test_a_limit_holds_at_once_and_is_lifted_along_its_ramp(tmp_path: Path) -> None:
    guarded, guard = started(tmp_path, "rule r: if speed > 1 m/s then { slow; };")
    guarded.speed(0.0)
    guarded.command(0.5)
    assert not guard.is_restricting
    guarded.speed(2.0)
    assert guarded.sent[-1][1] == 0.2, "the last command is sent again, bounded"
    assert guard.is_restricting
    guarded.speed(0.0)
    guarded.now_ns = SECOND // 4
    guarded.command(0.5)
    assert guarded.sent[-1][1] == pytest.approx(0.275)


def test_a_command_of_a_rule_takes_the_place_of_the_program(tmp_path: Path) -> None:
    guarded, guard = started(tmp_path, "rule r: if speed > 1 m/s then { back; };")
    guarded.speed(0.0)
    guarded.speed(2.0)
    guarded.sent.clear()
    guarded.pass_time(guard, SECOND, lambda: guarded.speed(2.0))
    guarded.command(0.5)
    assert {speed for _, speed in guarded.sent} == {-0.1}
    assert len(guarded.sent) >= 9
    guarded.speed(0.0)
    guarded.command(0.5)
    assert guarded.sent[-1][1] == 0.5


def test_what_is_published_at_a_rate_ends_with_its_rule(tmp_path: Path) -> None:
    guarded, guard = started(tmp_path, "rule r: if speed > 1 m/s then { push; };")
    guarded.speed(2.0)
    guarded.pass_time(guard, SECOND, lambda: guarded.speed(2.0))
    assert len(guarded.boosts) == 11
    guarded.speed(0.0)
    guarded.pass_time(guard, 2 * SECOND, lambda: guarded.speed(0.0))
    assert len(guarded.boosts) == 11


def test_an_input_that_falls_silent_acts_without_a_message(tmp_path: Path) -> None:
    guarded, guard = started(tmp_path, "rule r: if speed > 1 m/s then { push; };")
    guarded.speed(0.0)
    guarded.pass_time(guard, SECOND, lambda: None)
    (verdict,) = guard.verdicts
    assert verdict.at_ns == SECOND // 2
    assert "timeout" in guard.explain(verdict) or "older" in guard.explain(verdict)


def test_a_latched_rule_waits_for_its_operator(tmp_path: Path) -> None:
    guarded, guard = started(tmp_path, "rule r: if speed > 1 m/s then { stop; };")
    guarded.speed(2.0)
    guarded.speed(0.0)
    guarded.command(0.5)
    assert guard.latched == ("r",)
    assert guarded.sent[-1][1] == 0.0
    guard.reset()
    guarded.command(0.5)
    assert not guard.latched
    assert guarded.sent[-1][1] == 0.5
    assert [each.kind for each in guard.occurrences] == [
        TaskCommandKind.START,
        TaskCommandKind.STOP,
    ]


def test_a_command_that_is_not_finite_stops_the_base(tmp_path: Path) -> None:
    guarded, _ = started(tmp_path, "rule r: if speed > 1 m/s then { slow; };")
    guarded.speed(0.0)
    guarded.publish(UNFILTERED, messages.twist(0.1, np.nan))
    assert guarded.sent[-1][1] == 0.0


def test_what_it_cannot_do_is_refused_at_the_start(tmp_path: Path) -> None:
    rules = "action call_it { call /s : std_srvs/Trigger within 1 sec; }\n"
    with pytest.raises(UnsupportedEffectError, match="Call"):
        started(tmp_path, rules + "rule r: if speed > 1 m/s then { call_it; };")


def test_elements_of_an_array_are_read_and_a_missing_one_fails_closed(tmp_path: Path) -> None:
    rules = """
    input effort = topic /joints : sensor_msgs/JointState .effort in Nm timeout 1 sec;
    rule strong: if effort[1] > 5 Nm or effort[0] > 7 Nm then { slow; };
    """
    guarded, guard = started(tmp_path, rules + "rule r: if speed > 1 m/s then { slow; };")
    state = messages.new_message("sensor_msgs/JointState")
    guarded.speed(0.0)
    for efforts, active in (([6, 4], ()), ([6, 6], ("strong",)), ([6, 4], ()), ([6], ("strong",))):
        state.effort = np.array(efforts, dtype=np.float64)
        guarded.publish(Topic("/joints", "sensor_msgs/JointState"), state)
        assert guard.active == active


def test_arrays_elements_texts_and_instants_are_read(tmp_path: Path) -> None:
    rules = """
    input scan = topic /scan : sensor_msgs/LaserScan timeout 1 sec;
    input mode = topic /mode : std_msgs/String;
    input lamp = topic /lamp : std_msgs/Bool;
    rule near: if any(scan.ranges < 0.5 m) then { slow; };
    rule ahead: if scan.ranges[2] > 5 m then { slow; };
    rule late: if scan.header.stamp > 7.5 s then { slow; };
    rule service: if mode == "service" then { slow; };
    rule silent: if age(lamp) > 2 s then { slow; };
    """
    guarded, guard = started(tmp_path, rules + "rule r: if speed > 1 m/s then { slow; };")
    scan = messages.new_message("sensor_msgs/LaserScan")
    scan.header.stamp = messages.Time(7, 0)
    scan.ranges = np.array([1.0, 1.0])
    text = messages.new_message("std_msgs/String")
    topics = {name: Topic(f"/{name}", kind) for name, kind in _TYPES.items()}
    guarded.speed(0.0)
    guarded.publish(topics["lamp"], messages.Bool(False))
    guarded.publish(topics["mode"], text)
    guarded.publish(topics["scan"], scan)
    assert set(guard.active) <= {"ahead"}, "an element that is not there is unknown"
    scan.header.stamp = messages.Time(7, 600_000_000)
    scan.ranges = np.array([0.3, 1.0, 6.0])
    text.data = "service"
    guarded.publish(topics["scan"], scan)
    guarded.publish(topics["mode"], text)
    assert set(guard.active) == {"near", "ahead", "late", "service"}
    guarded.pass_time(guard, 3 * SECOND, lambda: guarded.publish(topics["scan"], scan))
    assert "silent" in guard.active


def test_points_of_a_scan_are_seen_in_zones_and_sectors(tmp_path: Path) -> None:
    rules = """
    input scan = topic /scan : sensor_msgs/LaserScan up to 4 timeout 1 sec;
    zone ahead in base_link { box [0, 1, -0.5, 0.5] m; }
    rule inside: if count(p in scan.points: p in ahead) >= 2 then { slow; };
    rule near: if min(scan.ranges[-5 deg .. 5 deg]) < 0.5 m then { slow; };
    """
    guarded, guard = started(tmp_path, rules + "rule r: if speed > 1 m/s then { slow; };")
    guarded.speed(0.0)
    topic = Topic("/scan", "sensor_msgs/LaserScan")
    for ranges, active in (
        ([2.0, 2.0, 2.0, 2.0], set()),
        ([0.7, 0.7, 0.8, 0.0], {"inside"}),
        ([0.0, 0.4, 0.0, 2.0], {"near"}),
    ):
        scan = messages.laser_scan(0, (-0.1, 0.2, 0.1), (0.1, 10.0), np.array(ranges))
        scan.header.frame_id = "base_link"
        guarded.publish(topic, scan)
        assert set(guard.active) == active
    scan.header.frame_id = "camera"
    guarded.publish(topic, scan)
    assert set(guard.active) == {"inside", "near"}, "of points elsewhere nothing is known"


def test_a_message_that_starts_a_time_is_followed_when_that_is_over(tmp_path: Path) -> None:
    guarded, guard = started(tmp_path, "rule r: if speed > 1 m/s for 0.03 sec then { slow; };")
    guarded.speed(0.0)
    guarded.pass_time(guard, SECOND // 5, lambda: None)
    guarded.speed(2.0)
    guarded.pass_time(guard, SECOND // 4, lambda: None)
    assert [verdict.at_ns for verdict in guard.verdicts] == [SECOND // 5 + 30_000_000]
    assert guard.active == ("r",)
    assert guard.due_ns > guarded.now_ns


def test_rules_know_which_skills_run(tmp_path: Path) -> None:
    shutil.copytree(SKILLFUL, tmp_path, dirs_exist_ok=True)
    rules = """
    skills "skills.json" timeout 1 sec;
    rule r: if speed > 1 m/s then { stop; } unless doing Push(Object: Fragile) then { slow; };
    """
    guarded, guard = started(tmp_path, rules)
    context = Topic("/skill_context", "skill_context_msgs/SkillContext")
    glass = SkillArgument("Object", type="skiros.Glass")
    running = (RunningSkill("Push", (glass,)),)
    guarded.publish(context, SkillContext(f"c0ffee{'0' * 58}", running))
    guarded.speed(2.0)
    assert guard.active == ("r_doing_Push",)
    guarded.pass_time(guard, SECOND // 2, lambda: guarded.speed(2.0))
    guarded.publish(context, SkillContext("", running))
    assert "r" in guard.active
