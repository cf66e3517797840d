"""Files with parameters, and under names, mean what they mean when written out: S85 to S87."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rossmarie.driver import check_file
from rossmarie.driver.pipeline import compile_file
from rossmarie.interpreter import Interpreter
from rossmarie.ir import ChannelValues, Constant, Machine, machine_to_json
from support.depth import examples
from support.rule_texts import NAMED, rules
from support.testing import INPUTS

SEPARATION = """\
parameter scan = topic /scan;
parameter gap in m;
parameter slow = gap / 2;
system scanners { topic shared = /shared/scan : sensor_msgs/LaserScan; }
action stop { block /cmd_vel : geometry_msgs/Twist; }
input ranges = topic scan : sensor_msgs/LaserScan .ranges timeout 0.3 sec;
input others = topic shared.ranges timeout 0.3 sec;
entity near {
    stop : min(ranges) < gap;
    both : stop and min(others) < slow;
}
rule tooNear: if near.both then { stop; };
rule first: if near.stop unless tooNear then { stop; };
priority tooNear over first;
"""
ARM = """\
parameter elbow = "elbow_joint";
parameter states = topic /joint_states;
parameter base = frame base_link;
parameter cell = frame "cell/floor";
action stop;
input joints = topic states : sensor_msgs/JointState timeout 1 sec;
input tip = topic /tip : geometry_msgs/PoseStamped .pose.position from cell in base timeout 1 sec;
zone beside in base { box [0, 1, 0, 1] m; }
rule fast: if abs(joints[elbow].velocity) > 2 or tip in beside then { stop; };
"""
CELL = """\
system cell {
    frame base_link in world timeout 1 sec;
    frame "cell/floor" in world;
    frame other = "b/base_link" in world timeout 1 sec;
}
"""
_SLOW = (HealthCheck.too_slow, HealthCheck.data_too_large)
_VALUE = re.compile(r"(?<![\w.\[-])\d+(?:\.\d+)? (?:m/s\^2|m/s|m|deg|sec|rad/s|Nm)(?![\w/^])")
_WRITTEN = {"span", "head", "text", "contract", "documentation"}


def machine_of(folder: Path, **files: str) -> Machine:
    """The machine of `main`; the other files are beside it."""
    for name, text in files.items():
        (folder / f"{name}.ross").write_text(text, encoding="utf-8")
    return compile_file(folder / "main.ross").machine


def meaning(machine: Machine) -> Any:
    """All of a machine but how it is written."""
    found = json.loads(machine_to_json(machine))["machine"]
    return {**_without_words(found), "name": ""}


def _without_words(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: _without_words(each) for name, each in value.items() if name not in _WRITTEN}
    return [_without_words(each) for each in value] if isinstance(value, list) else value


def numbers(machine: Machine) -> set[float]:
    """The numbers that are known when compiling."""
    found = (signal.node for signal in machine.signals)
    return {each.value for each in found if isinstance(each, Constant)}


def renamed(found: Any, prefix: str) -> Any:
    """The same with a prefix less in front of all names."""
    return json.loads(json.dumps(found).replace(prefix, ""))


@settings(max_examples=examples(0.5), deadline=None, suppress_health_check=_SLOW)
@given(rules())
def test_s85_an_instance_is_its_file_with_other_names(text: str) -> None:
    with TemporaryDirectory() as folder:
        whole = machine_of(Path(folder), main=INPUTS + NAMED + text)
        names = {"library": INPUTS + NAMED + text, "main": 'import "library.ross" as front;'}
        instance = machine_of(Path(folder), **names)
    assert {each.name for each in instance.rules} == {f"front_{each.name}" for each in whole.rules}
    assert renamed(meaning(instance), "front_") == meaning(whole)


@settings(max_examples=examples(0.5), deadline=None, suppress_health_check=_SLOW)
@given(rules())
def test_s86_a_parameter_is_its_value(text: str) -> None:
    values = {value: f"p{index}" for index, value in enumerate(dict.fromkeys(_VALUE.findall(text)))}
    open_text = _VALUE.sub(lambda found: values[found.group()], text)
    declared = "".join(
        f"parameter {name} in {value.split()[1]};\n" for value, name in values.items()
    )
    defaults = "".join(f"parameter {name} = {value};\n" for value, name in values.items())
    given_values = ", ".join(f"{name} = {value}" for value, name in values.items())
    written = f'import "library.ross"{" with " if values else ""}{given_values};'
    with TemporaryDirectory() as name:
        folder = Path(name)
        whole = meaning(machine_of(folder, main=INPUTS + NAMED + text))
        library = declared + INPUTS + NAMED + open_text
        handed = meaning(machine_of(folder, library=library, main=written))
        itself = meaning(machine_of(folder, main=defaults + INPUTS + NAMED + open_text))
    assert handed == whole
    assert itself == whole


def test_s85_names_of_instances_are_apart(tmp_path: Path) -> None:
    main = """
        import "separation.ross" with gap = 1 m, scan = /front/scan as front;
        import "separation.ross" with gap = 0.5 m, scan = /rear/scan as rear;
        rule either: if front.near.stop or rear.near.stop then { front.stop; };
    """
    machine = machine_of(tmp_path, separation=SEPARATION, main=main)
    names = [rule.name for rule in machine.rules]
    assert names == ["front_tooNear", "front_first", "rear_tooNear", "rear_first", "either"]
    topics = {each.name: machine.channels[each.channel].topic for each in machine.inputs}
    assert topics == {
        "front_ranges": "/front/scan",
        "front_others": "/shared/scan",
        "rear_ranges": "/rear/scan",
        "rear_others": "/shared/scan",
    }


def test_s85_an_instance_in_an_instance(tmp_path: Path) -> None:
    side = """
        parameter reach in m;
        parameter where = topic /scan;
        import "separation.ross" with gap = reach + 10 cm, scan = where as inner;
        rule also_near: if inner.near.stop then { inner.stop; };
    """
    main = """
        import "side.ross" with reach = 1 m, where = /left as left;
        rule outer: if left.inner.near.stop unless left.also_near then { left.inner.stop; };
    """
    machine = machine_of(tmp_path, separation=SEPARATION, side=side, main=main)
    assert [rule.name for rule in machine.rules] == [
        "left_inner_tooNear",
        "left_inner_first",
        "left_also_near",
        "outer",
    ]
    assert machine.channels[0].topic == "/left"
    assert 1.1 in numbers(machine)


def test_s85_a_file_without_a_name_keeps_its_names(tmp_path: Path) -> None:
    main = 'import "separation.ross" with gap = 1 m;\nrule more: if near.stop then { stop; };'
    machine = machine_of(tmp_path, separation=SEPARATION, main=main)
    assert [rule.name for rule in machine.rules] == ["tooNear", "first", "more"]


def test_s85_what_a_file_does_not_declare_is_of_the_whole_program(tmp_path: Path) -> None:
    library = "rule tooFast: if speed > fastest then { stop; };\n"
    main = f'import "library.ross" as one;\n{INPUTS}const fastest = 1 m/s;'
    machine = machine_of(tmp_path, library=library, main=main)
    assert [rule.name for rule in machine.rules] == ["one_tooFast"]
    assert [each.name for each in machine.inputs] == ["speed"]


def test_s85_what_a_file_declares_comes_before_names_of_other_files(tmp_path: Path) -> None:
    library = """
        input battery = topic /battery : sensor_msgs/BatteryState timeout 5 sec;
        entity cells { weak : battery.voltage < 20 V; }
        rule tell: if cells.weak then { };
    """
    other = "const voltage = 3 V;"
    main = 'import "library.ross" as cells;\nimport "other.ross" as battery;'
    machine = machine_of(tmp_path, library=library, other=other, main=main)
    assert [rule.name for rule in machine.rules] == ["cells_tell"]
    assert [each.name for each in machine.inputs] == ["cells_battery"]


def test_s85_hazards_of_a_file_are_there_once(tmp_path: Path) -> None:
    library = """
        parameter gap in m;
        input distance = topic /sonar : sensor_msgs/Range .range timeout 1 sec;
        hazard collision "it hits something";
        rule near: if distance < gap then { } mitigates collision;
    """
    imports = ("", " as front", " as rear")
    main = "\n".join(f'import "library.ross" with gap = 1 m{each};' for each in imports)
    machine = machine_of(tmp_path, library=library, main=main)
    assert [rule.name for rule in machine.rules] == ["near", "front_near", "rear_near"]
    assert [each.name for each in machine.hazards] == ["collision"]


def test_s86_values_are_of_the_importing_file(tmp_path: Path) -> None:
    library = """
        const a = 3 m;
        parameter gap in m;
        parameter twice = gap * 2;
        action stop;
        input ranges = topic /scan : sensor_msgs/LaserScan .ranges timeout 0.3 sec;
        rule tooNear: if min(ranges) < gap or max(ranges) < twice then { stop; };
    """
    main = 'const a = 0.25 m;\nimport "separation.ross" with gap = a as front;'
    machine = machine_of(tmp_path, separation=library, main=main)
    assert numbers(machine) == {0.25, 0.5}


def test_s86_an_alias_is_a_topic_of_the_importing_file(tmp_path: Path) -> None:
    main = """
        system robot { topic lidar = /front/scan : sensor_msgs/LaserScan; }
        import "separation.ross" with gap = 1 m, scan = lidar as front;
    """
    machine = machine_of(tmp_path, separation=SEPARATION, main=main)
    assert machine.channels[0].topic == "/front/scan"


def test_s86_a_frame_is_that_of_the_import(tmp_path: Path) -> None:
    main = """
        parameter mine = frame other;
        import "arm.ross" as a;
        import "arm.ross" with base = mine as b;
        import "arm.ross" with base = "b/base_link" as c;
    """
    found = meaning(machine_of(tmp_path, arm=ARM, system=CELL, main=main))
    written = ARM.replace("in base ", 'in "b/base_link" ')
    (tmp_path / "written").mkdir()
    main = 'import "arm.ross" as a;import "other.ross" as b;import "other.ross" as c;'
    files = {"arm": ARM, "other": written, "system": CELL, "main": main}
    assert meaning(machine_of(tmp_path / "written", **files)) == found


def test_s86_a_constant_names_an_element(tmp_path: Path) -> None:
    main = """
        const right = "right_elbow";
        import "arm.ross" with elbow = "left_elbow" as left;
        import "arm.ross" with elbow = right as right_arm;
    """
    machine = machine_of(tmp_path, arm=ARM, system=CELL, main=main)
    reported = machine_to_json(machine)
    assert "left_elbow" in reported
    assert "right_elbow" in reported
    assert not check_file(tmp_path / "main.ross").diagnostics


def test_s86_tests_of_a_file_are_about_its_defaults(tmp_path: Path) -> None:
    tested = SEPARATION.replace("gap in m", "gap = 1 m") + (
        'test "near" { at 1 s ranges = [0.1] m; expect first active at 1 s; }'
    )
    (tmp_path / "separation.ross").write_text(tested)
    (tmp_path / "main.ross").write_text('import "separation.ross" with gap = 2 m as front;')
    (tmp_path / "plain.ross").write_text('import "separation.ross";')
    counts = {}
    for name in ("separation", "main", "plain"):
        program = check_file(tmp_path / f"{name}.ross").program
        assert program is not None
        counts[name] = len(program.tests)
    assert counts == {"separation": 1, "main": 0, "plain": 1}


# --- parameters of the node ------------------------------------------------------------------

NODE = """\
parameter gap = 0.5 m tightens up;
parameter braking = 2 m/s^2 tightens down;
action stop;
input distance = topic /sonar : sensor_msgs/Range .range timeout 1 sec;
input speed = topic /speed : std_msgs/Float64 in m/s timeout 1 sec;
input ranges = topic /scan : sensor_msgs/LaserScan .ranges timeout 1 sec;
"""
_TIGHT = (
    "distance < gap",
    "not (distance >= 2 * gap)",
    "min(ranges) < gap + 0.2 m",
    "distance - gap < 0.1 m",
    "speed > braking * 0.5 sec",
    "distance < speed * speed / (2 * braking) + gap",
    "abs(speed) * 1 sec < max(gap, 0.3 m) or distance < -(0.1 m - gap)",
    "distance < gap for 0.2 sec",
    "distance < gap since speed > braking * 1 sec",
    "once distance < gap within 0.3 sec",
)
_LOOSE = (
    "distance > gap",
    "distance == gap",
    "speed < braking * 1 sec",
    "distance < speed * gap / (1 m/s)",
    "distance < abs(gap - 1 m)",
    "rate(gap) > 1 m/s",
    "count(edges of distance < gap within 1 sec) > 2",
    "after distance < gap, speed < 1 m/s within 1 sec",
    "oscillates(gap - distance, 3 times, within 1 sec)",
)
_TIGHT_VALUES = st.tuples(st.floats(0.5, 3), st.floats(0.1, 2))
_SEEN = st.lists(st.tuples(st.floats(0, 3), st.floats(-3, 3)), min_size=1, max_size=12)


def active_after(
    machine: Machine, given: dict[str, float], seen: Sequence[tuple[float, float]]
) -> list[bool]:
    """Say after each message, every 100 ms, if the rule is active."""
    monitor, found = Interpreter(machine), []
    topics = [channel.topic for channel in machine.channels]
    for index, (distance, speed) in enumerate(seen):
        values = {"/sonar": distance, "/speed": speed, **(given if index == 0 else {})}
        messages = {
            number: ChannelValues(
                {
                    slot: values[topic]
                    for slot, each in enumerate(machine.slots)
                    if machine.inputs[each.input].channel == number
                },
                {0: (distance, distance + 1)} if topic == "/scan" else {},
            )
            for number, topic in enumerate(topics)
            if topic in values or topic == "/scan"
        }
        monitor.update(index * 100_000_000, messages)
        found.append(monitor.active[0])
    return found


def node_machine(condition: str, folder: Path) -> Machine:
    return machine_of(folder, main=f"{NODE}rule it: if {condition} then {{ stop; }};")


@pytest.mark.parametrize(
    ("given", "gap"), [(0.8, 0.8), (0.3, 0.5), (math.nan, 0.5), (1e9, 0.5), (500.0, 500.0)]
)
def test_s87_only_a_tighter_value_counts(tmp_path: Path, given: float, gap: float) -> None:
    machine = node_machine("distance < gap", tmp_path)
    seen = [(gap - 0.01, 0.0), (gap + 0.01, 0.0)]
    assert active_after(machine, {"~gap": given}, seen) == [True, False]
    assert active_after(machine, {}, [(0.49, 0.0), (0.51, 0.0)]) == [True, False]


@settings(max_examples=examples(1), deadline=None)
@given(st.sampled_from(_TIGHT), _TIGHT_VALUES, _SEEN)
def test_s87_a_rule_is_active_whenever_it_was(
    condition: str, values: tuple[float, float], seen: list[tuple[float, float]]
) -> None:
    with TemporaryDirectory() as folder:
        machine = node_machine(condition, Path(folder))
    before = active_after(machine, {}, seen)
    after = active_after(machine, {"~gap": values[0], "~braking": values[1]}, seen)
    assert all(tight or not was for was, tight in zip(before, after, strict=True))


@pytest.mark.parametrize("condition", _LOOSE)
def test_s87_where_the_direction_is_not_known(tmp_path: Path, condition: str) -> None:
    main = tmp_path / "main.ross"
    main.write_text(f"{NODE}rule it: if {condition} then {{ stop; }};")
    assert "ROSS158" in {each.code for each in check_file(main).diagnostics}
