"""Rules that set each other off by publishing: a replay shows it, and without their messages it
does not happen.
"""

from __future__ import annotations

import itertools
from collections import Counter
from pathlib import Path

import pytest

from rossmarie.analysis.finding import Finding
from rossmarie.analysis.queries import ask_all
from rossmarie.analysis.witness import Witness, as_csv, views
from rossmarie.driver import compile_file
from rossmarie.driver.replay import replay_file
from rossmarie.ir import Change, Machine, Verdict

INPUTS = """
system base {
    topic /cmd_vel : geometry_msgs/Twist;
    node planner { publishes /cmd_vel; }
}
input asked = topic /cmd_vel : geometry_msgs/Twist .linear.x
input mode = topic /mode : std_msgs/String
input lamp = topic /lamp : std_msgs/Bool
input beat = topic /beat : std_msgs/Empty
input level = topic /level : std_msgs/Int32 .data
input heat = topic /heat : sensor_msgs/Temperature .temperature timeout 1 sec
input joints = topic /joints : sensor_msgs/JointState .position
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec
input wheel = topic /wheel : std_msgs/Float64 in m/s
action tell { call /operator/tell : std_srvs/Trigger within 1 sec; }
action eco { publish /mode : std_msgs/String { data = "eco"; }; }
action sport { publish /mode : std_msgs/String { data = "sport"; }; }
action plain { publish /mode : std_msgs/String { data = "plain"; }; }
action light { publish /lamp : std_msgs/Bool { data = true; } at 2 Hz; }
action dark { publish /lamp : std_msgs/Bool {}; }
action knock { publish /beat : std_msgs/Empty {}; }
action one { publish /level : std_msgs/Int32 { data = 1; }; }
action nine { publish /level : std_msgs/Int32 { data = 9; }; }
action cool { publish /heat : sensor_msgs/Temperature { temperature = 20 degC; } at 5 Hz; }
action warm { publish /heat : sensor_msgs/Temperature { temperature = 60 degC; } at 5 Hz; }
action fold { publish /joints : sensor_msgs/JointState { position = [0, 0.1]; }; }
action stretch { publish /joints : sensor_msgs/JointState { position = [0, 2]; }; }
action back { publish /cmd_vel { linear.x = -0.1 m/s; } at 10 Hz; }
"""

FOUND = {
    "texts": """
        rule a: if mode == "sport" then { eco; };
        rule b: if mode == "eco" then { sport; };
    """,
    "a flag that is not named": """
        rule a: if lamp then { dark; };
        rule b: if not lamp for 1 sec then { light; } clear for 2 sec;
    """,
    "three in a circle": """
        rule a: if mode == "sport" then { eco; };
        rule b: if mode == "eco" then { plain; };
        rule c: if mode == "plain" then { sport; };
    """,
    "with something from outside": """
        rule a: if level > 5 and speed > 1 m/s then { one; };
        rule b: if level < 5 and speed > 0.5 m/s then { nine; };
    """,
    "units": """
        rule a: if heat > 50 degC then { cool; };
        rule b: if heat < 30 degC then { warm; };
    """,
    "elements": """
        rule a: if joints[1] > 1 then { fold; };
        rule b: if joints[1] < 1 and joints[0] < 1 then { stretch; };
    """,
    "where a sensor is missing": """
        rule a: if level > 5 and speed > 1 m/s then { one; };
        rule b: if level < 5 and speed < 1 m/s then { nine; };
    """,
    "after an answer": """
        rule a: if level > 5 then { tell; one; };
        rule b: if level < 5 then { nine; };
    """,
    "after a failure": """
        rule a: if level > 5 then { tell else one; };
        rule b: if level < 5 then { nine; };
    """,
    "only the first needs a message": """
        rule a: if level > 5 then { one; nine; };
    """,
    "silence": """
        rule a: if age(beat) > 1 sec then { knock; };
    """,
    "in the place of the planner": """
        rule a: if asked > 1 m/s then { back; };
    """,
}


def ask(folder: Path, rules: str) -> tuple[Path, Machine, list[Finding]]:
    path = folder / "rules.ross"
    path.write_text(INPUTS + rules, encoding="utf-8")
    machine = compile_file(path).machine
    found = ask_all(machine, thorough=False, within_ns=10**9)
    reported = [each for each in found if each.diagnostic.code in ("ROSS718", "ROSS729")]
    return path, machine, reported


def starts(machine: Machine, witness: Witness) -> list[int]:
    """The number of activations of each rule in a witness."""
    seen = [(False,) * len(machine.rules), *(view.active for view in views(machine, witness))]
    return [
        sum(now[rule] and not before[rule] for before, now in itertools.pairwise(seen))
        for rule in range(len(machine.rules))
    ]


@pytest.mark.parametrize("way", FOUND)
def test_each_rule_becomes_active_twice_in_a_replay(way: str, tmp_path: Path) -> None:
    rules, machine, (found,) = ask(tmp_path, FOUND[way])
    assert found.diagnostic.code == "ROSS718"
    assert all(f"`{rule.name}`" in found.diagnostic.title for rule in machine.rules)
    assert found.witness is not None
    recording = tmp_path / "witness.csv"
    recording.write_text(as_csv(machine, found.witness), encoding="utf-8")
    replay, _ = replay_file(rules, recording, topic_map={})
    verdicts = [each for each in replay.events if isinstance(each, Verdict)]
    often = Counter(each.rule for each in verdicts if each.change is not Change.CLEARED)
    assert [often[rule] for rule in range(len(machine.rules))] == starts(machine, found.witness)
    assert min(often.values()) >= 2


PUBLISHED = ("/mode", "/lamp", "/beat", "/level", "/joints", "/heat")


@pytest.mark.parametrize("way", [way for way in FOUND if way != "in the place of the planner"])
def test_without_the_messages_of_the_rules_none_is_active_twice(way: str, tmp_path: Path) -> None:
    _, machine, (found,) = ask(tmp_path, FOUND[way])
    assert found.witness is not None
    topics = {index for index, each in enumerate(machine.channels) if each.topic in PUBLISHED}
    first, *later = found.witness.events
    outside = [each for each in later if not topics & set(each.messages)]
    alone = Witness((first, *outside), found.witness.end_ns, is_calm=False)
    assert max(starts(machine, alone)) < 2


NOTHING = {
    "room between the conditions": """
        rule a: if level > 9 then { one; };
        rule b: if level < 1 then { nine; };
    """,
    "not at the same time from outside": """
        rule a: if level > 5 and wheel > 1 m/s then { one; };
        rule b: if level < 5 and wheel < 1 m/s then { nine; };
    """,
    "a latch": """
        rule a: if mode == "sport" then { eco; } latched until reset;
        rule b: if mode == "eco" then { sport; };
    """,
    "nobody reads it": """
        rule a: if level > 5 then { eco; };
        rule b: if level < 5 then { sport; };
    """,
    "only one reads it": """
        rule a: if level > 5 then { one; };
        rule b: if speed > 1 m/s then { nine; };
    """,
    "it stays active": """
        rule a: if level > 0 then { one; };
    """,
    "it stays inactive": """
        rule a: if level > 5 then { one; };
    """,
}


@pytest.mark.parametrize("way", NOTHING)
def test_of_rules_that_are_proved_not_to_alternate_nothing_is_said(
    way: str, tmp_path: Path
) -> None:
    *_, found = ask(tmp_path, NOTHING[way])
    assert [each.diagnostic.title for each in found] == []


def test_a_group_is_not_reported_again_with_a_rule_more(tmp_path: Path) -> None:
    rules = FOUND["texts"] + 'rule c: if mode == "sport" then { plain; eco; };'
    *_, found = ask(tmp_path, rules)
    titles = [each.diagnostic.title for each in found if each.diagnostic.code == "ROSS718"]
    assert not any(all(f"`{name}`" in title for name in "abc") for title in titles)


def test_what_toggles_without_the_messages_of_the_rules_is_not_reported(tmp_path: Path) -> None:
    *_, found = ask(tmp_path, "rule a: if age(speed) > 0.05 sec and level < 9 then { one; };")
    assert "ROSS718" not in {each.diagnostic.code for each in found}
