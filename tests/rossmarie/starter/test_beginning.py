"""First rules: valid as they are, and with all proposals; their inputs fit the recording."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dslkit.diagnostics import Diagnostic
from rossmarie.driver import check_file
from rossmarie.recordings.bag import BagRecording
from rossmarie.recordings.errors import RecordingError
from rossmarie.recordings.model import Recording, Rhythm
from rossmarie.recordings.opening import open_recording
from rossmarie.recordings.system_model import definition_path
from rossmarie.starter import Beginning, begin
from rossmarie.starter.kinds import KINDS
from rossmarie.starter.numbers import is_steady, rounded_down, rounded_up, timeout_s
from support.first_drives import ARM, BASE, PARTS, UPRIGHT, Spoken, drive, moving, scan
from support.recordings import ROS1, Reading, write_ros1

PROPOSED = re.compile(r"^//(?! \S|$)", re.MULTILINE)


def begun(found: Sequence[Reading], folder: Path) -> Beginning:
    with open_recording(write_ros1(folder / "drive.bag", found, 100_000)) as recording:
        return begin(recording)


def findings(beginning: Beginning, rules: str, folder: Path) -> Iterable[Diagnostic]:
    for name, text in beginning.definitions.items():
        path = folder / definition_path(name)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    (folder / "system.ross").write_text(beginning.model)
    (folder / "robot.ross").write_text(rules)
    return check_file(folder / "robot.ross").diagnostics


def inputs(rules: str) -> list[str]:
    return re.findall(r"^input (\w+)", rules, re.MULTILINE)


@pytest.mark.parametrize(
    "spoken",
    [BASE, ARM, PARTS, [*BASE, *ARM[:3], *PARTS], [*ARM[:2]], [*BASE[:3], *PARTS]],
    ids=["base", "arm", "parts", "all", "arm without commands", "base without commands"],
)
def test_rules_and_all_proposals_are_valid(spoken: Sequence[Spoken], tmp_path: Path) -> None:
    beginning = begun(drive(ROS1, spoken) + moving(ROS1), tmp_path)
    assert list(findings(beginning, beginning.rules, tmp_path)) == []
    proposed = PROPOSED.sub("", beginning.rules)
    assert proposed.count("\nrule ") > beginning.rules.count("\nrule ") == 1
    assert list(findings(beginning, proposed, tmp_path)) == []


def test_the_inputs_of_a_base(tmp_path: Path) -> None:
    rules = begun(drive(ROS1, BASE), tmp_path).rules
    assert "// 100 messages, 20 Hz; the longest gap is 0.05 s.\n" in rules
    assert "input odometry = topic /odom : nav_msgs/Odometry timeout 0.15 sec;\n" in rules
    assert "input imu = topic /imu/data : sensor_msgs/Imu timeout 0.06 sec;\n" in rules
    assert "input scan = topic /scan : sensor_msgs/LaserScan timeout 0.3 sec;\n" in rules
    assert 'import "rossmarie/deros.ross" with cmd_vel = /cmd_vel;\n' in rules
    assert "//rule near: if min(scan.ranges[-90 deg .. 90 deg]) < 0.5 m" in rules
    assert "// The fastest in the recording: 0.5 m/s.\n//rule too_fast:" in rules


def test_the_inputs_of_an_arm(tmp_path: Path) -> None:
    rules = begun(drive(ROS1, ARM), tmp_path).rules
    assert inputs(rules) == ["joints_position", "wrench", "wrench_flange"]
    assert "JointState .position in rad\n    timeout 0.05 sec;\n" in rules
    assert "//input joints_effort = topic /joint_states : sensor_msgs/JointState .effort" in rules
    assert 'elbow = "arm_joint_4"' in rules
    assert 'import "rossmarie/commands.ross" with commands = /servo/delta_twist_cmds;\n' in rules


def test_the_inputs_of_parts(tmp_path: Path) -> None:
    rules = begun(drive(ROS1, PARTS), tmp_path).rules
    assert inputs(rules) == ["battery", "temperature", "diagnostics"]
    assert "// No input reads /diagnostics, " in rules
    assert "input diagnostics = topic /hardware/diagnostics : " in rules
    assert "DiagnosticArray .status up to 16\n    timeout 1.5 sec;\n" in rules
    assert "//rule battery_low: if battery.percentage < 15 % for 5 sec" in rules
    assert "weakest = 20 V" in rules
    assert "The recording has no commands; /cmd_vel is the usual topic" in rules


def test_two_imus_have_names_of_their_own(tmp_path: Path) -> None:
    spoken = [
        Spoken(f"/{place}/imu/data", "sensor_msgs/Imu", 50, UPRIGHT) for place in ("front", "rear")
    ]
    beginning = begun(drive(ROS1, [*spoken, BASE[3]]), tmp_path)
    assert inputs(beginning.rules) == ["imu_front", "imu_rear"]
    proposed = PROPOSED.sub("", beginning.rules)
    assert "rule imu_rear_tilted: " in proposed
    assert " as imu_rear_tilt;" in proposed
    assert list(findings(beginning, proposed, tmp_path)) == []


def test_topics_of_the_same_words_have_names_of_their_own(tmp_path: Path) -> None:
    spoken = [Spoken(topic, "sensor_msgs/Imu", 50, UPRIGHT) for topic in ("/a/b", "/a_b")]
    beginning = begun(drive(ROS1, spoken), tmp_path)
    assert inputs(beginning.rules) == ["imu", "imu_2"]
    assert list(findings(beginning, PROPOSED.sub("", beginning.rules), tmp_path)) == []


def test_the_commands_that_reach_the_robot(tmp_path: Path) -> None:
    """They are on the topic with the usual name and the most messages."""
    others = [
        Spoken("/base/cmd_vel", "geometry_msgs/Twist", 40, {}),
        Spoken("/teleop_cmd_vel", "geometry_msgs/Twist", 80, {}),
        Spoken("/base/unfil_cmd_vel", "geometry_msgs/Twist", 90, {}),
    ]
    rules = begun(drive(ROS1, [*BASE, *others]), tmp_path).rules
    assert 'import "rossmarie/deros.ross" with cmd_vel = /base/cmd_vel;\n' in rules
    text = re.sub(r"\s+//\s+|\s+", " ", rules)
    assert "Also recorded: /cmd_vel, /teleop_cmd_vel." in text


def test_an_imu_without_orientation_and_one_that_is_mounted_turned(tmp_path: Path) -> None:
    turned = Spoken("/imu", "sensor_msgs/Imu", 50, {"orientation__x": 1.0})
    assert "begins tilted by 180 deg" in begun(drive(ROS1, [turned]), tmp_path).rules
    (tmp_path / "drive.bag").unlink()
    lacking = Spoken("/imu", "sensor_msgs/Imu", 50, {})
    rules = begun(drive(ROS1, [lacking, BASE[3]]), tmp_path).rules
    assert "This IMU tells no orientation." in rules
    assert "tilt.ross" not in rules


def test_a_battery_that_tells_percent_is_watched_by_its_voltage(tmp_path: Path) -> None:
    given = {"percentage": 60.0, "voltage": 12.5}
    spoken = Spoken("/battery", "sensor_msgs/BatteryState", 2, given)
    rules = begun(drive(ROS1, [spoken]), tmp_path).rules
    assert "//rule battery_low: if battery.voltage < 10 V for 5 sec" in rules
    assert "battery.ross" not in rules


def test_a_pause_of_the_recording_does_not_become_the_timeout(tmp_path: Path) -> None:
    rules = begun(drive(ROS1, BASE, seconds=20, pause=3.0), tmp_path).rules
    assert "/scan : sensor_msgs/LaserScan timeout 0.5 sec;" in rules
    text = re.sub(r"\s+//\s+|\s+", " ", rules)
    assert (
        "the longest gap is 3.1 s. That is a pause: a replay shows it by the rule `silent`." in text
    )


def test_what_comes_irregularly_is_a_proposal(tmp_path: Path) -> None:
    bursts = [
        reading
        for start in range(5)
        for reading in drive(ROS1, [PARTS[0]._replace(hz=100)], seconds=0.1)
        for reading in [(reading[0], reading[1] + start * 10**10, *reading[2:])]
    ]
    beginning = begun(sorted([*drive(ROS1, BASE), *bursts], key=lambda each: each[1]), tmp_path)
    assert "battery" not in inputs(beginning.rules)
    assert "//input battery = topic /battery" in beginning.rules
    assert list(findings(beginning, PROPOSED.sub("", beginning.rules), tmp_path)) == []


def test_images_are_not_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: set[str] = set()
    stored = BagRecording._stored

    def spied(self: BagRecording, topics: list[str], collector: object) -> object:
        asked.update(topics)
        return stored(self, topics, collector)  # type: ignore[arg-type]

    monkeypatch.setattr(BagRecording, "_stored", spied)
    image = Spoken("/camera", "sensor_msgs/Image", 30, {})
    beginning = begun([*drive(ROS1, [*BASE, image]), *moving(ROS1)], tmp_path)
    assert asked == {"/odom", "/imu/data", "/scan", "/cmd_vel", "/tf"}
    assert "topic /camera : sensor_msgs/Image;" in beginning.model
    assert "frame base_link in odom timeout 0.2 sec;" in beginning.model
    assert "topic /scan : sensor_msgs/LaserScan from sensor;" in beginning.model


def test_a_large_recording_is_read_in_part(tmp_path: Path) -> None:
    path = write_ros1(tmp_path / "drive.bag", drive(ROS1, BASE, seconds=60), 100_000)
    with open_recording(path) as recording:
        part, whole = begin(recording, seconds=0.0), begin(recording)
    assert re.search(r"of which the first \d+ s of 60 s\s+(// )?were read\.", part.rules)
    assert "were read" not in whole.rules
    assert inputs(part.rules) == inputs(whole.rules)


@pytest.mark.parametrize(
    ("spoken", "reason"),
    [
        (Spoken("/camera", "sensor_msgs/Image", 10, {}), "it holds none of the messages"),
        (BASE[0]._replace(hz=0.6), "no topic has 5 messages or more"),
    ],
)
def test_nothing_to_watch(spoken: Spoken, reason: str, tmp_path: Path) -> None:
    with pytest.raises(RecordingError) as caught:
        begun(drive(ROS1, [spoken]), tmp_path)
    assert caught.value.diagnostic.code == "ROSS625"
    assert reason in caught.value.diagnostic.title


TOPIC_PARTS = st.sampled_from(
    ["imu", "data", "rule", "not", "stop", "silent", "cmd_vel", "a-b", "2", "_x", "part", "m", "é"]
)
GIVEN: Mapping[str, Mapping[str, object]] = {
    "sensor_msgs/Imu": UPRIGHT,
    "sensor_msgs/LaserScan": scan(5),
    "sensor_msgs/JointState": {"name": ['"', "b"], "position": [0.0, 1.0]},
    "sensor_msgs/BatteryState": {"percentage": 1.0, "voltage": 0.4},
}


@settings(max_examples=25)
@given(
    st.lists(
        st.tuples(
            st.lists(TOPIC_PARTS, min_size=1, max_size=3).map("/".join),
            st.booleans(),
            st.sampled_from([*KINDS, "geometry_msgs/Twist", "geometry_msgs/TwistStamped"]),
            st.sampled_from([0.5, 7.0, 100.0]),
        ),
        min_size=1,
        max_size=6,
        unique_by=lambda each: each[0],
    )
)
def test_any_topics(drawn: list[tuple[str, bool, str, float]]) -> None:
    spoken = [
        Spoken(f"/{name}" if is_absolute else name, kind, hz, GIVEN.get(kind, {}))
        for name, is_absolute, kind, hz in drawn
    ]
    with TemporaryDirectory() as name:
        folder = Path(name)
        try:
            beginning = begun(drive(ROS1, spoken, seconds=3), folder)
        except RecordingError as error:
            if error.diagnostic.code != "ROSS625":
                raise
            return
        assert list(findings(beginning, beginning.rules, folder)) == []
        assert list(findings(beginning, PROPOSED.sub("", beginning.rules), folder)) == []


@given(st.floats(1e-6, 1e9))
def test_numbers_are_rounded_to_few_digits(number: float) -> None:
    above, below = rounded_up(number), rounded_down(number)
    assert number * (1 - 1e-8) <= above <= number * 1.5
    assert number / 1.5 <= below <= number * (1 + 1e-8)
    assert rounded_up(above) == above == rounded_down(above)


@given(st.integers(1, 10**9), st.integers(1, 10**11))
def test_a_timeout_is_longer_than_usual_gaps_and_shorter_than_pauses(
    median_ns: int, more_ns: int
) -> None:
    rhythm = Rhythm(100, median_ns, median_ns + more_ns, 0.0)
    assert is_steady(rhythm)
    found = timeout_s(rhythm)
    assert found >= 3 * median_ns / 1e9 * (1 - 1e-8)
    assert found <= max(0.05, 5 * median_ns / 1e9) * 1.5


def test_the_type_of_recording_is_a_protocol(tmp_path: Path) -> None:
    path = tmp_path / "drive.csv"
    path.write_text("time,a\n0,1\n1,2\n")
    opened: Recording = open_recording(path)
    with opened, pytest.raises(RecordingError) as caught:
        begin(opened)
    assert caught.value.diagnostic.code == "ROSS617"
