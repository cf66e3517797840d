"""One rules file and one episode: the environment behind its rules, a replay of the recording, and
Heron's guard give the same log, byte for byte. The generated node is in `tests/live`.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from support.c_compiler import needs_c
from support.parts import MUJOCO, require

require(MUJOCO)

from heron.learning.arms import RULES
from heron.variants import LearningArm
from rossmarie.driver import compile_file
from rossmarie.ir import Change, Event, Machine, Verdict
from rossmarie.report.jsonl import event_lines
from support.insertions import (
    Policy,
    in_process,
    into_the_fragile_part,
    messages_of,
    recorded,
    scraping,
    wandering,
)

EPISODES: tuple[tuple[Policy, int], ...] = (
    (into_the_fragile_part, 1),
    (scraping, 1),
    (wandering(2), 2),
)


def replayed(recording: Path, folder: Path) -> bytes:
    """The verdicts file that `rossmarie replay` writes."""
    command = [sys.executable, "-m", "rossmarie", "replay", str(RULES), str(recording)]
    subprocess.run([*command, "--out", str(folder)], check=True, capture_output=True)
    return (folder / "verdicts.jsonl").read_bytes()


def log(machine: Machine, events: list[Event], end_ns: int) -> bytes:
    """The lines of that file after its header, of the events of a guard."""
    lines = event_lines(machine, events, 0, end_ns)
    return "".join(f"{line}\n" for line in lines).encode()


@needs_c
@pytest.mark.parametrize(("policy", "seed"), EPISODES)
@pytest.mark.parametrize("arm", [LearningArm.UNGUARDED, LearningArm.GUARD])
def test_all_uses_give_the_same_log(
    arm: LearningArm, policy: Policy, seed: int, tmp_path: Path
) -> None:
    recording = tmp_path / "episode.mcap"
    wrapped = recorded(arm, policy, seed, recording)
    header, _, wanted = replayed(recording, tmp_path).partition(b"\n")
    reported = json.loads(header)
    assert reported["start_ns"] == 0
    assert reported["notes"] == []
    machine = compile_file(RULES).machine
    assert log(machine, wrapped, reported["end_ns"]) == wanted
    own = in_process(machine, list(messages_of(recording)))
    assert log(machine, own, reported["end_ns"]) == wanted
    assert own == wrapped, "with all that verdicts rest on, whether it decides or not"
    assert len(activated(wrapped)) >= 4


def activated(events: list[Event]) -> set[int]:
    """The rules that became active."""
    verdicts = (event for event in events if isinstance(event, Verdict))
    return {each.rule for each in verdicts if each.change is Change.ACTIVATED}


def test_a_recording_has_readings_and_commands_at_their_instants(tmp_path: Path) -> None:
    recording = tmp_path / "episode.mcap"
    recorded(LearningArm.UNGUARDED, into_the_fragile_part, 1, recording)
    heard = list(messages_of(recording))
    instants: dict[str, list[int]] = {}
    for topic, at_ns, _ in heard:
        instants.setdefault(topic.name, []).append(at_ns)
    readings = list(range(0, 12_000_000_001, 8_000_000))
    steps = list(range(0, 12_000_000_000, 40_000_000))
    assert instants == {
        **dict.fromkeys(("/arm/pose", "/wrench", "/person/distance"), readings),
        **dict.fromkeys(("/arm/velocity", "/arm/push"), steps),
    }
    pushes = [message.force.z for topic, _, message in heard if topic.name == "/arm/push"]
    assert set(pushes) == {-5.0}
    stamps = [message.header.stamp for topic, _, message in heard if topic.name == "/wrench"]
    assert [stamp.sec * 1_000_000_000 + stamp.nanosec for stamp in stamps] == readings
