"""Episodes as recordings: whoever replays them, hears what was said."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("mujoco", reason="the simulation needs MuJoCo, which needs Python 3.11")

from rosbags.highlevel import AnyReader
from typer.testing import CliRunner

from heron.cli.main import app
from heron.experiments import run_human
from heron.rules import FOLDER
from heron.variants import Arm, Person
from rossmarie.cli.main import app as rossmarie

PLACING = ["record", "place", "--seed", "3", "--out"]


def test_a_recording_is_replayed_with_the_verdicts_of_the_episode(tmp_path: Path) -> None:
    path = tmp_path / "new" / "room.mcap"
    found = CliRunner().invoke(app, ["record", "human", "--seed", "3", "--out", str(path)])
    assert found.exit_code == 0, found.output
    assert [entry.name for entry in path.parent.iterdir()] == ["room.mcap"]
    rules, report = FOLDER / "human.ross", tmp_path / "report"
    replay = ["replay", str(rules), str(path), "--out", str(report)]
    replayed = CliRunner().invoke(rossmarie, replay)
    assert replayed.exit_code == 0, replayed.output
    lines = map(json.loads, (report / "verdicts.jsonl").read_text(encoding="utf-8").splitlines())
    again = [
        (line["at_ns"] * 1e-9, f"{line['rule']} {line['change']}")
        for line in lines
        if line["type"] == "verdict"
    ]
    told = [
        (at_s, words.partition(":")[0])
        for at_s, words in run_human(Arm.ROSSMARIE, Person.INSIDE, 3).told
    ]
    assert len(told) > 2
    assert again == told


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


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (["record", "fly", "--out", "a.mcap"], "there is no experiment fly"),
        (
            ["record", "place", "--variant", "low", "--out", "a.mcap"],
            "no variant low; there are high",
        ),
        (["record", "place", "--out", "a.bag"], "has to end in .mcap"),
        (["record", "place", "--out", "there.mcap"], "is there already"),
    ],
)
def test_what_cannot_be_recorded_is_told_before_it_is_run(
    arguments: list[str], reason: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "there.mcap").write_text("mine", encoding="utf-8")
    found = CliRunner().invoke(app, arguments)
    assert found.exit_code == 2
    assert reason in found.output
    assert (tmp_path / "there.mcap").read_text(encoding="utf-8") == "mine"
