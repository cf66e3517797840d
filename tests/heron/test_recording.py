"""Episodes as recordings: whoever replays them, hears what was said."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from support.parts import MUJOCO, require

require(MUJOCO)

from rosbags.highlevel import AnyReader
from typer.testing import CliRunner

from heron.cli.main import app
from heron.experiments import EpisodeFacts, run_contact, run_human, run_navigation
from heron.rules import FOLDER
from heron.variants import Encounter, ExperimentArm, Person, Terrain
from rossmarie.cli.main import app as rossmarie

PLACING = ["record", "place", "--seed", "3", "--out"]


def recorded(name: str, path: Path, *more: str) -> None:
    found = CliRunner().invoke(app, ["record", name, "--seed", "3", "--out", str(path), *more])
    assert found.exit_code == 0, found.output


def replayed(rules: str, path: Path, report: Path) -> list[tuple[float, str]]:
    """The instants and changes of the verdicts."""
    replay = ["replay", str(FOLDER / rules), str(path), "--out", str(report)]
    found = CliRunner().invoke(rossmarie, replay)
    assert found.exit_code == 0, found.output
    lines = map(json.loads, (report / "verdicts.jsonl").read_text(encoding="utf-8").splitlines())
    return [
        (line["at_ns"] * 1e-9, f"{line['rule']} {line['change']}")
        for line in lines
        if line["type"] == "verdict"
    ]


def changes(episode: EpisodeFacts) -> list[tuple[float, str]]:
    return [(at_s, words.partition(":")[0]) for at_s, words in episode.reported]


@pytest.mark.deep
def test_a_recording_is_replayed_with_the_verdicts_of_the_episode(tmp_path: Path) -> None:
    path = tmp_path / "new" / "room.mcap"
    recorded("human", path)
    assert [entry.name for entry in path.parent.iterdir()] == ["room.mcap"]
    reported = changes(run_human(ExperimentArm.ROSSMARIE, Person.INSIDE, 3))
    assert len(reported) > 2
    assert replayed("human.ross", path, tmp_path / "report") == reported


@pytest.mark.deep
def test_a_drive_is_recorded_until_the_block_is_picked_up(tmp_path: Path) -> None:
    path = tmp_path / "drive.mcap"
    recorded("nav", path)
    episode = run_navigation(ExperimentArm.ROSSMARIE, Terrain.GENTLE, 3)
    arrived_s = next(one.spans[0].end for one in episode.tree if one.label == "Drive(Target)")
    assert arrived_s is not None
    instants: dict[str, list[float]] = {}
    with AnyReader([path]) as reader:
        for connection, at_ns, data in reader.messages():
            instants.setdefault(connection.topic, []).append(at_ns * 1e-9)
            if connection.topic == "/joint_states":
                message: Any = reader.deserialize(data, connection.msgtype)
                stamp_s = message.header.stamp.sec + message.header.stamp.nanosec * 1e-9
                assert instants["/joint_states"][-1] == pytest.approx(stamp_s, abs=0.02)
    over_s = episode.measures.duration
    for topic in ("/imu/data", "/odom", "/joint_states"):
        assert instants[topic][-1] == pytest.approx(over_s, abs=0.05)
    assert instants["/joint_states"][0] == pytest.approx(arrived_s, abs=0.05)
    found = replayed("navigation.ross", path, tmp_path / "report")
    # A guard waits until all sensors have spoken for the first time, a replay does not.
    assert [one for one in found if one[0] > 2.0] == changes(episode)


@pytest.mark.deep
def test_exemptions_are_replayed_as_they_were_used(tmp_path: Path) -> None:
    path = tmp_path / "contact.mcap"
    recorded("contact", path, "--arm", "skill_aware")
    reported = changes(run_contact(ExperimentArm.SKILL_AWARE, Encounter.COLLISION, 3))
    assert {words for _, words in reported} >= {
        "back_off_on_contact activated",
        "back_off_on_contact_doing_Push activated",
        "back_off_on_contact_doing_Wipe activated",
    }
    found = replayed("contact_skills.ross", path, tmp_path / "report")
    assert [one for one in found if one[0] > 2.0] == reported


def test_all_topics_are_in_it_with_the_definitions_of_their_types(tmp_path: Path) -> None:
    path = tmp_path / "place.mcap"
    CliRunner().invoke(app, [*PLACING, str(path), "--variant", "expected"])
    with AnyReader([path]) as reader:
        topics = {one.topic: (one.msgtype, one.msgcount) for one in reader.connections}
        assert topics["/wrench"][0] == "geometry_msgs/msg/WrenchStamped"
        assert "/arm/stop" in topics
        (wrench,) = (one for one in reader.connections if one.topic == "/wrench")
        messages = list(reader.messages([wrench]))
        stamps = [at_ns for _, at_ns, _ in messages]
        assert len(stamps) > 500
        assert stamps == sorted(stamps)
        first: Any = reader.deserialize(messages[0][2], wrench.msgtype)
        assert first.header.frame_id == "wrist"


def test_a_trace_has_the_stamps_of_the_recording(tmp_path: Path) -> None:
    path, trace = tmp_path / "place.mcap", tmp_path / "place.jsonl"
    variant = ["--variant", "expected", "--begin", "1000", "--trace", str(trace)]
    recorded("place", path, *variant)
    with AnyReader([path]) as reader:
        assert reader.start_time >= 1000 * 10**9
        assert reader.duration < 60 * 10**9
    events = list(map(json.loads, trace.read_text(encoding="utf-8").splitlines()))
    ends = [events[index] for index in (0, -1)]
    assert [each["event"] for each in ends] == ["started", "succeeded"]
    assert (ends[0]["tick"], ends[0]["time"], ends[0]["at_ns"]) == (1, 0.0, 1001 * 10**9)
    assert ends[1]["at_ns"] == ends[0]["at_ns"] + round(ends[1]["time"] * 1e9)
    assert ends[1]["tick"] == 1 + round(ends[1]["time"] / 0.04)


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (["record", "fly", "--out", "a.mcap"], "there is no experiment fly"),
        (
            ["record", "place", "--variant", "low", "--out", "a.mcap"],
            "no variant low; there are high",
        ),
        (["record", "place", "--out", "a.bag"], "must end in .mcap"),
        (["record", "place", "--out", "there.mcap"], "is there, and heron did not write it"),
        (["record", "place", "--out", "a.mcap", "--trace", "a.mcap"], "must end in .jsonl"),
        (
            ["record", "place", "--out", "a.mcap", "--trace", "there.jsonl"],
            "is there, and heron did not write it",
        ),
    ],
)
def test_what_cannot_be_recorded_is_reported_before_it_is_run(
    arguments: list[str], reason: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("there.mcap", "there.jsonl"):
        (tmp_path / name).write_text("mine", encoding="utf-8")
    found = CliRunner().invoke(app, arguments)
    assert found.exit_code == 2
    assert reason in found.output
    assert (tmp_path / "there.mcap").read_text(encoding="utf-8") == "mine"
