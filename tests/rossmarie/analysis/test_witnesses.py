"""Witnesses show what findings say, also when they are written as recordings and replayed."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import pytest

from rossmarie.analysis.finding import Finding
from rossmarie.analysis.queries import ask_all
from rossmarie.analysis.shrink import cost
from rossmarie.analysis.witness import Sending, Witness, as_csv, views
from rossmarie.driver import compile_file
from rossmarie.driver.replay import replay_file
from rossmarie.ir import Change, ChannelValues, InputState, Machine, Verdict
from support.drafts import SECOND

INPUTS = """
system base {
    topic /cmd_vel : geometry_msgs/Twist;
    node planner { publishes /cmd_vel; }
}
input orientation = topic /imu/data : sensor_msgs/Imu .orientation timeout 0.2 sec
input force = topic /wrench : geometry_msgs/Wrench .force timeout 0.1 sec
input turning = topic /imu/data : sensor_msgs/Imu .angular_velocity timeout 0.2 sec
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec
input ranges = topic /scan : sensor_msgs/LaserScan .ranges timeout 0.5 sec
input mode = topic /mode : std_msgs/String
input bumped = topic /bumped : std_msgs/Bool
action low { set /planner.speed to 0.2; }
action lower { set /planner.speed to 0.1; }
action back { publish /cmd_vel { linear.x = -0.1 m/s; } at 10 Hz; }
action slow { limit /cmd_vel { linear.x in [0, 0.2] m/s; }; }
"""

PAIRS = {
    "angle": ("orientation.pitch() > 10 deg for 4 sec", "orientation.pitch() > 20 deg for 4 sec"),
    "angles": ("orientation.pitch() < -10 deg", "orientation.roll() > 170 deg"),
    "length": ("norm(force) > 15 N", "force.y > 5 N"),
    "array": ("min(ranges) < 0.4 m", "any(ranges > 5 m) for 1 sec"),
    "count": ("count(ranges < 1 m) >= 2", "all(ranges < 4 m)"),
    "slope": ("rate(speed) < -1.5 m/s^2", "speed > 1 m/s"),
    "step": ("previous(speed) > 2 m/s", "speed < 0 m/s"),
    "age": ("age(speed) > 2 sec", "orientation.pitch() > 20 deg for 1 sec"),
    "text": ('mode == "driving" and speed > 1 m/s', 'mode != "docked"'),
    "flag": ("bumped for 3 sec", "not bumped or speed > 2 m/s"),
    "swing": (
        "oscillates(turning.y, 4 times, within 2.0 sec, by 0.2 rad/s)",
        "turning.y > 0 rad/s",
    ),
    "product": ("speed * speed > 4 m^2/s^2", "speed < 0 m/s"),
}


@dataclass(frozen=True)
class Asked:
    rules: Path
    machine: Machine
    findings: list[Finding]

    def shown(self, code: str) -> list[Finding]:
        return [found for found in self.findings if found.diagnostic.code == code]


def ask(folder: Path, rules: str, *, thorough: bool = False) -> Asked:
    path = folder / "rules.ross"
    path.write_text(INPUTS + rules, encoding="utf-8")
    machine = compile_file(path).machine
    return Asked(path, machine, list(ask_all(machine, thorough=thorough, within_ns=10**9)))


def active_at_the_end(asked: Asked, finding: Finding, folder: Path) -> set[str]:
    """The rules that are active when a witness, written as a recording, has been replayed."""
    assert finding.witness is not None
    recording = folder / "witness.csv"
    recording.write_text(as_csv(asked.machine, finding.witness), encoding="utf-8")
    replay, _ = replay_file(asked.rules, recording, topic_map={})
    active: set[str] = set()
    for event in replay.events:
        if isinstance(event, Verdict):
            name = asked.machine.rules[event.rule].name
            (active.discard if event.change is Change.CLEARED else active.add)(name)
    return active


@pytest.mark.parametrize("pair", PAIRS)
def test_a_conflict_is_shown_by_a_replay_with_all_sensors_at_work(
    pair: str, tmp_path: Path
) -> None:
    one, two = PAIRS[pair]
    rules = f"rule one: if {one} then {{ low; }};\nrule two: if {two} then {{ lower; }};"
    asked = ask(tmp_path, rules)
    (conflict,) = asked.shown("ROSS700")
    assert conflict.witness is not None
    if pair != "age":
        assert conflict.witness.is_calm
        note = next(text for text in conflict.diagnostic.notes if text.startswith("example"))
        last = note.removesuffix(".").rpartition("; until")[0] or note
        assert "unknown" not in last.rpartition("; at")[2]
    assert {"one", "two"} <= active_at_the_end(asked, conflict, tmp_path)
    last_view = list(views(asked.machine, conflict.witness))[-1]
    assert last_view.active == (True, True)


def test_messages_of_which_nothing_is_known_are_replayed_as_well(tmp_path: Path) -> None:
    rules = """
    input beat = topic /beat : std_msgs/Empty
    rule one: if age(beat) > 1 sec then { low; };
    rule two: if age(beat) > 2 sec then { lower; };
    """
    asked = ask(tmp_path, rules)
    (conflict,) = asked.shown("ROSS700")
    assert conflict.witness is not None
    assert as_csv(asked.machine, conflict.witness).startswith("time_ns,/beat\n0,1\n")
    assert active_at_the_end(asked, conflict, tmp_path) == {"one", "two"}


def test_a_message_with_an_empty_array_has_a_column(tmp_path: Path) -> None:
    rules = "rule one: if min(ranges) < 1 m then { low; };"
    asked = ask(tmp_path, rules)
    sent = {0: ChannelValues({}, {0: []})}
    text = as_csv(asked.machine, Witness((Sending(0, sent),), SECOND, is_calm=False))
    assert text == f"time_ns,/scan,/scan.ranges[0]\n0,1,\n{SECOND},,\n"
    recording = tmp_path / "witness.csv"
    recording.write_text(text, encoding="utf-8")
    replay, _ = replay_file(asked.rules, recording, topic_map={})
    (stale,) = (event for event in replay.events if isinstance(event, Verdict))
    assert stale.inputs == (InputState.FRESH,)


RATES = """
system rates { topic /battery : std_msgs/Float32 in V at 1 Hz; }
input volts = topic /battery timeout 0.5 sec
"""


def test_an_input_that_is_stale_between_messages_is_shown_by_a_replay(tmp_path: Path) -> None:
    asked = ask(tmp_path, RATES + "rule one: if volts < 11 V then { low; };")
    (stale,) = asked.shown("ROSS714")
    recording = tmp_path / "witness.csv"
    assert stale.witness is not None
    recording.write_text(as_csv(asked.machine, stale.witness), encoding="utf-8")
    replay, _ = replay_file(asked.rules, recording, topic_map={})
    seen = [(event.at_ns, event.change) for event in replay.events if isinstance(event, Verdict)]
    assert seen == [(5 * 10**8, Change.ACTIVATED_STALE), (10**9, Change.CLEARED)]


def test_one_message_fulfils_a_for_that_is_over_before_the_next(tmp_path: Path) -> None:
    asked = ask(tmp_path, RATES + "rule one: if volts < 11 V for 0.4 sec then { low; };")
    (enough,) = asked.shown("ROSS715")
    assert enough.witness is not None
    assert [event.at_ns for event in enough.witness.events] == [0]
    assert active_at_the_end(asked, enough, tmp_path) == {"one"}


def test_the_numbers_of_a_witness_are_round(tmp_path: Path) -> None:
    rules = """
    rule one: if orientation.pitch() > 10 deg for 4 sec then { low; };
    rule two: if orientation.pitch() > 20 deg for 4 sec then { lower; };
    """
    (conflict,) = ask(tmp_path, rules).shown("ROSS700")
    (note,) = (text for text in conflict.diagnostic.notes if text.startswith("example"))
    shown = re.fullmatch(r"example: at 0 s orientation\.pitch\(\) = (\d+) deg; until 4 s", note)
    assert shown is not None, note
    assert 20 < int(shown[1]) <= 45
    assert cost(float(shown[1]))[0] <= 2


def test_rules_that_exclude_each_other_meet_where_an_input_is_missing(tmp_path: Path) -> None:
    rules = """
    rule one: if speed > 1 m/s then { low; };
    rule two: if speed < 0 m/s then { lower; };
    """
    asked = ask(tmp_path, rules)
    (conflict,) = asked.shown("ROSS700")
    assert conflict.witness is not None
    assert not conflict.witness.is_calm
    assert active_at_the_end(asked, conflict, tmp_path) == {"one", "two"}


def test_a_rule_that_stays_active_meets_what_excludes_its_condition(tmp_path: Path) -> None:
    rules = """
    input wheel = topic /wheel : nav_msgs/Odometry .twist.twist.linear.x
    rule one: if wheel > 1 m/s then { low; } clear for 2 sec;
    rule two: if wheel < 0 m/s then { lower; };
    """
    asked = ask(tmp_path, rules)
    (conflict,) = asked.shown("ROSS700")
    assert conflict.witness is not None
    assert conflict.witness.is_calm
    assert active_at_the_end(asked, conflict, tmp_path) == {"one", "two"}


def test_a_rule_that_chatters_is_seen_to(tmp_path: Path) -> None:
    asked = ask(tmp_path, "rule one: if speed > 1 m/s then { low; };", thorough=True)
    (chattering,) = asked.shown("ROSS708")
    assert chattering.witness is not None
    active = [view.active[0] for view in views(asked.machine, chattering.witness)]
    starts = sum(now and not before for before, now in zip([False, *active], active, strict=False))
    assert starts == 2
    assert chattering.witness.end_ns <= 10**9


def test_a_recovery_that_another_rule_blocks_is_shown(tmp_path: Path) -> None:
    rules = """
    rule one: if speed > 1 m/s then { slow; };
    rule two: if orientation.pitch() > 20 deg then { back; };
    """
    asked = ask(tmp_path, rules)
    (blocked,) = asked.shown("ROSS709")
    assert active_at_the_end(asked, blocked, tmp_path) == {"one", "two"}
