"""Pictures of witnesses: which rules are active when."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

from rossmarie.driver.analyze import analyze_file
from rossmarie.driver.pipeline import compile_file
from rossmarie.report.safety.witness import witness_svg

RULES = """action on { set /drive.mode to 1; }
action off { set /drive.mode to 0; }
input speed = topic /speed : std_msgs/Float64 in m/s timeout 1 sec;
rule fast: if speed > 1 m/s then { on; };
rule faster: if speed > 2 m/s then { off; };
"""


def pictures(folder: Path, code: str) -> list[ET.Element]:
    path = folder / "rules.ross"
    path.write_text(RULES, encoding="utf-8")
    machine = compile_file(path).machine
    found = analyze_file(path, thorough=True).findings
    return [
        ET.fromstring(witness_svg(machine, each.witness))
        for each in found
        if each.diagnostic.code == code and each.witness is not None
    ]


def test_both_rules_of_a_conflict_are_active(tmp_path: Path) -> None:
    (picture,) = pictures(tmp_path, "ROSS700")
    names = [each.text for each in picture.iter("text") if each.get("class") == "rule"]
    assert names == ["fast", "faster"]
    assert len(list(picture.iter("rect"))) == 2


def test_a_rule_that_chatters_is_active_twice(tmp_path: Path) -> None:
    picture, _ = pictures(tmp_path, "ROSS708")
    places = [float(each.get("x", "")) for each in picture.iter("rect")]
    assert len(places) == len(set(places)) == 2
    instants = [each.text for each in picture.iter("text") if each.get("class") == "instant"]
    assert instants[0] == "0 s"
    assert instants[-1] == "0.3 s"
