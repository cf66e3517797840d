"""Rules files that ask for too much of lists and of the past are refused, and soon."""

from __future__ import annotations

from pathlib import Path

import pytest

from rossmarie.driver import check_file
from rossmarie.driver.build import build_files

INPUTS = """\
action stop;
input speed = topic /speed : std_msgs/Float64 .data in m/s timeout 1 sec;
input ok = topic /ok : std_msgs/Bool .data timeout 1 sec;
input path = topic /plan : nav_msgs/Path .poses up to {bound} timeout 3 sec;
rule all_used: if ok or speed > 1 m/s or any(p in path: p.pose.position.x > 1 m) then {{ stop; }};
"""
DEEP = 10_000

CONDITIONS = {
    "deep lists": ("any(p in path: " * DEEP + "ok" + ")" * DEEP, "ROSS013"),
    "deep once": ("once " * 500 + "ok" + " within 1 sec" * 500, "ROSS012"),
    "deep edges": ("count(edges of " * 500 + "ok" + " within 1 sec) > 1" * 500, "ROSS012"),
    "a window of less than a nanosecond": ("mean(speed, 0.1 ns) > 1 m/s", "ROSS307"),
    "a window of 300 years": ("once ok within 1e10 sec", "ROSS307"),
    "more edges than memory": ("count(edges of ok within 1 sec) > 2147483648", "ROSS235"),
    "fewer edges than none": ("count(edges of ok within 1 sec) > -1", "ROSS235"),
}
BOUNDS = ("0", "1.5", str(2**31), str(2**40), str(10**30))


def codes(folder: Path, text: str) -> list[str]:
    path = folder / "hostile.ross"
    path.write_text(text, encoding="utf-8")
    return [found.code for found in check_file(path).diagnostics]


@pytest.mark.parametrize("name", CONDITIONS)
def test_conditions_beyond_a_limit_are_refused(name: str, tmp_path: Path) -> None:
    condition, code = CONDITIONS[name]
    rule = f"rule hostile: if {condition} then {{ stop; }};\n"
    assert codes(tmp_path, INPUTS.format(bound=16) + rule) == [code]


@pytest.mark.parametrize("bound", BOUNDS)
def test_bounds_that_are_no_number_of_elements_are_refused(bound: str, tmp_path: Path) -> None:
    assert codes(tmp_path, INPUTS.format(bound=bound)) == ["ROSS239"]


NAMES = {
    "*/ int main(void) {": "*/ int main(void) {",
    "%s%n": "%s%n",
    "a\\": "a\\134",
    "??/": "\\077\\077/",
}
"""Names of joints, and how C writes them."""


@pytest.mark.parametrize("name", NAMES)
def test_names_of_elements_stay_names_in_generated_code(name: str, tmp_path: Path) -> None:
    rules = tmp_path / "names.ross"
    rules.write_text(
        "system arm { unit sensor_msgs/JointState.effort = Nm; }\n"
        "action stop { block /cmd_vel : geometry_msgs/Twist; }\n"
        "input joints = topic /joint_states : sensor_msgs/JointState timeout 1 sec;\n"
        f'rule heavy: if joints["{name}"].effort > 1 Nm then {{ stop; }};\n',
        encoding="utf-8",
    )
    build_files(rules, "ros1", tmp_path / "built")
    text = (tmp_path / "built" / "src" / "rules.cpp").read_text("utf-8")
    assert f'place_of("{NAMES[name]}", message.name, message.effort)' in text
