"""The file that tells other programs of rules."""

from __future__ import annotations

import hashlib
import json
import typing
from pathlib import Path
from typing import Any

import pytest

from rossmarie.driver.rules_file import WORDS
from rossmarie.ir import reactions
from support import command_line

RULES = """
import "rossmarie/deros.ross";
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec;
hazard crash "it hits somebody";
action halt { block /arm/cmd : geometry_msgs/Twist; }
action back { send actionlib/TwoInts { a = 1; } to /retract within 1 sec else halt; }
'''Nobody drives so fast.'''
rule fast: if speed > 1 m/s unless faster then { lowSpeed; } category human mitigates crash;
rule faster: if speed > 2 m/s then { back; };
"""


def export(rules: Path, out: Path) -> int:
    """The exit code."""
    return command_line.run("rossmarie", "export", rules, "-o", out).returncode


@pytest.fixture
def written(tmp_path: Path) -> Any:
    (tmp_path / "drive.ross").write_text(RULES)
    (tmp_path / "out").mkdir()
    out = tmp_path / "out" / "rules.json"
    assert export(tmp_path / "drive.ross", out) == 0
    return json.loads(out.read_text())


def test_it_tells_what_rules_read_and_do(written: Any) -> None:
    (read,) = written["inputs"]
    assert (read["name"], read["topic"], read["timeout"]) == ("speed", "/odom", 0.5)
    fast, faster = written["rules"]
    assert fast["unless"] == ["faster"]
    assert (fast["hazards"], fast["categories"]) == (["crash"], ["human"])
    assert [(each["kind"], each["name"]) for each in faster["effects"]] == [
        ("send", "/retract"),
        ("block", "/arm/cmd"),
    ]


def test_places_are_those_of_the_sources(written: Any, tmp_path: Path) -> None:
    place = written["rules"][0]["place"]
    line = (tmp_path / "out" / place["path"]).read_text().splitlines()[place["line"] - 1]
    assert line[place["column"] - 1 : place["end_column"] - 1] == "fast"


def test_sources_are_listed_with_their_digests(written: Any, tmp_path: Path) -> None:
    paths = [each["path"] for each in written["sources"]]
    assert paths == ["../drive.ross", "rossmarie/deros.ross"]
    content = (tmp_path / "drive.ross").read_bytes()
    assert written["sources"][0]["sha256"] == hashlib.sha256(content).hexdigest()


def test_the_digest_changes_with_the_sources(written: Any, tmp_path: Path) -> None:
    rules, out = tmp_path / "drive.ross", tmp_path / "out" / "rules.json"
    first = out.read_bytes()
    assert export(rules, out) == 0
    assert out.read_bytes() == first
    rules.write_text(RULES.replace("2 m/s", "3 m/s"))
    assert export(rules, out) == 0
    assert json.loads(out.read_text())["digest"] != written["digest"]


def test_nothing_is_written_over_rules_or_of_rules_with_errors(tmp_path: Path) -> None:
    rules = tmp_path / "drive.ross"
    rules.write_text(RULES)
    assert export(rules, rules) == 2
    assert rules.read_text() == RULES
    rules.write_text(RULES.replace("2 m/s", "2 m"))
    out = tmp_path / "rules.json"
    assert export(rules, out) == 1
    assert not out.exists()


def test_each_effect_has_a_word() -> None:
    assert WORDS.keys() == {*typing.get_args(reactions.Effect)} - {reactions.Limit}


def test_exemptions_are_reported_with_what_they_rest_on(tmp_path: Path) -> None:
    rules = Path(__file__).parents[3] / "examples" / "whiteboard" / "whiteboard.ross"
    out = tmp_path / "rules.json"
    assert export(rules, out) == 0
    reported = {each["name"]: each for each in json.loads(out.read_text())["rules"]}
    assert reported["contact_doing_Wipe"]["exempts"]["rule"] == "contact"
    assert reported["contact_doing_Wipe"]["exempts"]["doing"] == "doing Wipe"
    assert (
        "force with office.Whiteboard up to 20 N"
        in reported["contact_doing_Wipe"]["exempts"]["permits"]
    )
    assert [name for name, each in reported.items() if each["always"]] == ["too_hard"]
