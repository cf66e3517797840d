"""`ezskiros run --context`: what it refuses, what it writes, and what it publishes and when not."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from support import command_line
from support.exports import export

EXAMPLES = Path(__file__).parents[3] / "examples"
WORDS = ("--scene", "office.turtle", "Robot=skiros:heron", "Gripper=gripper", "Board=glass")
ROSPY = """
import os, time

class core:
    is_initialized = staticmethod(lambda: False)

def init_node(*_names, **_options):
    pass

class Time:
    def __init__(self, secs=0, nsecs=0):
        self.secs, self.nsecs = secs, nsecs
    @classmethod
    def now(cls):
        return cls(*divmod(time.time_ns(), 10**9))

class Publisher:
    def __init__(self, topic, kind, queue_size):
        self.file = open(os.environ["HEARD"], "a", buffering=1)
    def publish(self, message):
        assert message.is_ahead_known
        names = " ".join(each.skill for each in message.running)
        print(time.monotonic(), names, file=self.file)
"""
MESSAGES = """
class Message:
    def __init__(self):
        self.running, self.arguments, self.permits, self.properties = [], [], [], []

class SkillContext(Message):
    class header:
        stamp = None

class RunningSkill(Message): pass
class SkillAhead(Message): pass
class SkillArgument(Message): pass
class SkillProperty(Message): pass
class SkillPermission(Message): pass
"""
HANGING = """
import time
from ezskiros import SkillDescription

class Hang(SkillDescription):
    def description(self, Seconds: float = 0.0):
        pass

class hang(Hang.SkillBase):
    def execute(self):
        print("begins", time.monotonic(), flush=True)
        end = time.monotonic() + self.params.Seconds
        while time.monotonic() < end:
            time.sleep(0.01)
        print("ends", time.monotonic(), flush=True)
        return self.success("")

class Work(SkillDescription):
    def description(self):
        pass

class work(Work.SkillBase):
    def execute(self):
        return self.step("at it")
"""


@pytest.fixture
def whiteboard(tmp_path: Path) -> Path:
    for name in ("whiteboard", "pick_place"):
        shutil.copytree(EXAMPLES / name, tmp_path / name)
    return tmp_path / "whiteboard"


@pytest.fixture
def ros(tmp_path: Path) -> Path:
    """Stand-ins of ROS 1, which write down what is published."""
    folder = tmp_path / "ros"
    (folder / "skill_context_msgs").mkdir(parents=True)
    (folder / "rospy.py").write_text(ROSPY)
    (folder / "rosgraph.py").write_text("def is_master_online():\n    return True\n")
    (folder / "skill_context_msgs" / "__init__.py").touch()
    (folder / "skill_context_msgs" / "msg.py").write_text(MESSAGES)
    return folder


@pytest.fixture
def hanging(tmp_path: Path) -> Path:
    folder = tmp_path / "own"
    folder.mkdir()
    (folder / "skills.py").write_text(HANGING)
    export(folder / "skills.py", out=folder / "skills.json")
    return folder


def started(folder: Path, ros: Path, *words: str) -> subprocess.Popen[str]:
    variables = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join([str(ros), os.environ.get("PYTHONPATH", "")]),
        "HEARD": str(folder / "heard"),
    }
    command = str(Path(sys.executable).with_name("ezskiros"))
    return subprocess.Popen(
        [command, "run", *words, "--context", "skills.json"],
        cwd=folder, env=variables, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip


def heard(folder: Path) -> list[tuple[float, str]]:
    """The times of published messages, and the running skills in each."""
    path = folder / "heard"
    lines = path.read_text().splitlines() if path.exists() else []
    parts = [line.partition(" ") for line in lines if " " in line]
    return [(float(when), names) for when, _, names in parts]


def wait_until(folder: Path, count: int) -> None:
    end = time.monotonic() + 120
    while len(heard(folder)) < count:
        assert time.monotonic() < end
        time.sleep(0.01)


def test_the_trace_has_what_runs(whiteboard: Path) -> None:
    done = command_line.run(
        "ezskiros", "run", "erase", "skills", *WORDS, "--simulate", "--period", "0",
        "--context", "skills.json", "--trace", "trace.jsonl", folder=whiteboard,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, ""), done.stdout
    lines = [json.loads(line) for line in (whiteboard / "trace.jsonl").read_text().splitlines()]
    assert all("at_ns" in each for each in lines)
    contexts = [each for each in lines if each["event"] == "context"]
    digest = json.loads((whiteboard / "skills.json").read_text())["digest"]
    assert {each["digest"] for each in contexts} == {digest}
    names = [[skill["skill"] for skill in each["running"]] for each in contexts]
    assert names[0] == names[-1] == []
    for child in ("Drive", "Reach", "Wipe"):
        assert ["Erase", child] in names
    wiping = next(
        each for each in contexts if [s["skill"] for s in each["running"]][-1:] == ["Wipe"]
    )
    (_, wipe) = wiping["running"]
    board: dict[str, Any] = next(each for each in wipe["arguments"] if each["parameter"] == "Board")
    assert (board["type"], board["value"]) == ("office.GlassBoard", "office:GlassBoard-6")
    assert {"property": "office.Withstands", "number": 30.0} in board["properties"]
    assert {"kind": "force", "type": "office.GlassBoard", "limit": 20.0} in wipe["permits"]
    assert all(
        0 <= each["since"] <= context["time"] for context in contexts for each in context["running"]
    )


@pytest.mark.parametrize(
    ("source", "code"), [("skills/motions.py", "EZS861"), ("ontology/office.ttl", "EZS861")]
)
def test_nothing_runs_with_a_stale_export(whiteboard: Path, source: str, code: str) -> None:
    with (whiteboard / source).open("a") as file:
        file.write("# another comment\n")
    done = command_line.run(
        "ezskiros", "run", "erase", "skills", *WORDS, "--context", "skills.json", folder=whiteboard
    )
    assert done.returncode == 2
    assert f"error[{code}]" in done.stdout
    assert source in done.stdout
    assert "nothing was run" in done.stderr


def test_nothing_runs_with_the_export_of_others(whiteboard: Path, tmp_path: Path) -> None:
    export(whiteboard / "skills" / "motions.py", out=whiteboard / "skills.json")
    done = command_line.run(
        "ezskiros", "run", "erase", "skills", *WORDS, "--context", "skills.json", folder=whiteboard
    )
    assert done.returncode == 2
    assert "error[EZS862]" in done.stdout
    assert "skills/erasing.py" in done.stdout


def test_nothing_runs_with_what_is_no_export(whiteboard: Path) -> None:
    (whiteboard / "skills.json").write_text("{")
    done = command_line.run(
        "ezskiros", "run", "erase", "skills", *WORDS, "--context", "skills.json", folder=whiteboard
    )
    assert (done.returncode, "error[EZS860]" in done.stdout) == (2, True)
    (whiteboard / "skills.json").unlink()
    done = command_line.run(
        "ezskiros", "run", "erase", "skills", *WORDS, "--context", "skills.json", folder=whiteboard
    )
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "ezskiros: cannot read skills.json: no such file or directory\n"


def test_without_ros_that_is_reported_and_skills_run(hanging: Path) -> None:
    done = command_line.run(
        "ezskiros", "run", "Hang", "skills.py", "--context", "skills.json", folder=hanging
    )
    assert done.returncode == 0
    assert "the context is not published: the package `skill_context_msgs`" in done.stderr


def test_it_is_published_from_start_to_end(hanging: Path, ros: Path) -> None:
    with started(hanging, ros, "Work", "skills.py", "--timeout", "1.5") as process:
        out, error = process.communicate(timeout=120)
    assert "it had no result after 1.5 s" in error, out
    times = [when for when, _ in heard(hanging)]
    names = [running for _, running in heard(hanging)]
    assert names[0] in ("", "Work"), "what is reported first depends on which thread is faster"
    assert names.count("Work") >= 5
    assert times == sorted(times)


def test_a_tick_that_hangs_silences_it(hanging: Path, ros: Path) -> None:
    with started(hanging, ros, "Hang", "skills.py", "Seconds=4") as process:
        out, error = process.communicate(timeout=120)
    assert process.returncode == 0, error
    begins, ends = (
        float(line.split()[1]) for line in out.splitlines() if line.startswith(("begins", "ends"))
    )
    times = [when for when, names in heard(hanging) if names == "Hang"]
    assert any(begins - 1 < when < begins + 1.5 for when in times)
    assert [when for when in times if begins + 1.5 < when < ends] == []


@pytest.fixture
def working(hanging: Path, ros: Path) -> Iterator[subprocess.Popen[str]]:
    with started(hanging, ros, "Work", "skills.py", "--timeout", "100") as process:
        wait_until(hanging, 3)
        yield process
        process.kill()


def test_a_process_that_is_stopped_is_silent(hanging: Path, working: subprocess.Popen[str]) -> None:
    os.kill(working.pid, signal.SIGSTOP)
    os.waitid(os.P_PID, working.pid, os.WSTOPPED)
    before = len(heard(hanging))
    time.sleep(1.0)
    assert len(heard(hanging)) == before
    os.kill(working.pid, signal.SIGCONT)
    wait_until(hanging, before + 3)


def test_a_process_that_is_killed_is_silent(hanging: Path, working: subprocess.Popen[str]) -> None:
    working.kill()
    working.wait(60)
    before = len(heard(hanging))
    time.sleep(0.5)
    assert len(heard(hanging)) == before


def test_a_simulation_is_not_published(hanging: Path, ros: Path) -> None:
    with started(hanging, ros, "Hang", "skills.py", "--simulate") as process:
        process.communicate(timeout=120)
    assert process.returncode == 0
    assert heard(hanging) == []
