"""`ezskiros run`: what it prints, how it ends, and what stops it."""

from __future__ import annotations

import json
import os
import pty
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from ezskiros.ontology.load import VARIABLE
from support import command_line

ROOT = Path(__file__).parents[3]
EXAMPLE = ROOT / "examples" / "pick_place"
COMMAND = (str(Path(sys.executable).with_name("ezskiros")), "run")
PICK = ("pick", str(EXAMPLE / "skills"), "--scene", str(EXAMPLE / "lab.turtle"), "Gripper=gripper")
SKILLS = """
from ezskiros import SkillDescription

class Work(SkillDescription):
    def description(self): pass

class work(Work.SkillBase):
    def execute(self):
        return self.step("at it")
    def onPreempt(self):
        print("preempted", flush=True)
        return self.fail("stopped")
    def onEnd(self):
        print("ended", flush=True)
        return True

class Hang(SkillDescription):
    def description(self): pass

class hang(Hang.SkillBase):
    def execute(self):
        import time
        for _ in range(30_000):  # five minutes
            print("hangs", time.monotonic_ns(), flush=True)
            time.sleep(0.01)
        return self.success()
"""


def run(
    *words: str, folder: Path = ROOT, given: str = "", **variables: str
) -> subprocess.CompletedProcess[str]:
    return command_line.run(
        "ezskiros", "run", *words, folder=folder, variables=variables, given=given
    )


@pytest.fixture
def skills(tmp_path: Path) -> Path:
    (tmp_path / "skills.py").write_text(SKILLS, encoding="utf-8")
    return tmp_path


def test_pick_and_place_runs_as_listed_in_the_thesis(tmp_path: Path) -> None:
    saved, trace = tmp_path / "after.turtle", tmp_path / "trace.jsonl"
    done = run(
        "PickAndPlace", *PICK[1:], "Object=starter", "PlacingLocation=shelf", "--simulate",
        "--out", str(saved), "--trace", str(trace),
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1].startswith("PickAndPlace has succeeded (1 tick, ")
    events = [json.loads(line) for line in trace.read_text(encoding="utf-8").splitlines()]
    picked = [
        each["path"][2] for each in events if len(each["path"]) == 3 and "Pick.pick" in each["path"]
    ]
    assert list(dict.fromkeys(picked)) == [
        "SwitchController", "MoveitCartesianSpaceMotion", "WmSetRelation.wm_set_relation",
        "HSVDetection", "SwitchController#2", "ApproachMovement.go_to_linear",
        "WmSetRelation.wm_set_relation#2", "Wait", "ActuateGripper", "WmMoveObject",
        "ApproachMovement.go_to_linear#2", "Wait#2",
    ]  # fmt: skip
    again = run("pick", *PICK[1:], "Object=starter", "--simulate", "--scene", str(saved))
    assert again.returncode == 1
    assert "pre-condition does not hold: " in again.stderr


def test_each_line_of_a_trace_has_a_stamp(skills: Path) -> None:
    """A stamp is the time of day, and differs from the start by the seconds of the line."""
    before = time.time_ns()
    done = run("work", "--trace", "trace.jsonl", "--timeout", "0.2", folder=skills)
    after = time.time_ns()
    assert done.returncode == 1
    text = (skills / "trace.jsonl").read_text("utf-8")
    events = [json.loads(line) for line in text.splitlines()]
    assert before <= events[0]["at_ns"] < events[-1]["at_ns"] <= after
    starts = [each["at_ns"] - round(each["time"] * 1e9) for each in events]
    assert max(starts) - min(starts) <= 1_000  # seconds are told to the microsecond
    assert {type(each["at_ns"]) for each in events} == {int}


def test_skills_with_errors_are_not_run(tmp_path: Path) -> None:
    wrong = SKILLS.replace('return self.step("at it")', "return True")
    (tmp_path / "skills.py").write_text(wrong, encoding="utf-8")
    done = run("work", folder=tmp_path)
    assert done.returncode == 2
    assert "error[EZS" in done.stdout
    assert done.stderr == "ezskiros: nothing was run, because there are errors\n"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("wrok",), "there is no skill `wrok` in these files; did you mean `work`?"),
        (("work", "Speed=3"), "`Work` has no parameter `Speed`; it has none"),
        (("work", "--scene", "no.turtle"), "cannot read no.turtle: no such file or directory"),
        (("work", "--trace", "no/trace.jsonl", "--timeout", "0"),
         "cannot write no/trace.jsonl: no such file or directory"),
        (("work", "--out", "no/after.turtle", "--timeout", "0"),
         "cannot write no/after.turtle: no such file or directory"),
    ],
)  # fmt: skip
def test_a_wrong_call_is_reported(skills: Path, words: tuple[str, ...], said: str) -> None:
    done = run(*words, folder=skills)
    assert (done.returncode, done.stderr) == (2, f"ezskiros: {said}\n")


def test_a_scene_with_errors_is_not_run(skills: Path) -> None:
    (skills / "lab.turtle").write_text("@prefix : <http://a#> .\n:B a :C .\n", encoding="utf-8")
    done = run(
        "work", "--scene", "lab.turtle", folder=skills, **{VARIABLE: str(EXAMPLE / "ontology")}
    )
    assert done.returncode == 2
    assert "lab.turtle:2:6" in done.stdout


def test_an_ontology_that_is_not_there_is_reported(skills: Path) -> None:
    done = run("work", folder=skills, **{VARIABLE: "nowhere"})
    assert done.returncode == 2
    assert "the ontology nowhere cannot be read: it does not exist" in done.stdout


def test_a_timeout_preempts(skills: Path) -> None:
    done = run("work", "--timeout", "0.1", "--period", "0.01", folder=skills)
    assert done.returncode == 1
    assert done.stdout.splitlines()[-3:] == [
        "preempted",
        "ended",
        "->Work-work(Failure)[-405] stopped",
    ]
    assert done.stderr.rstrip().endswith("it had no result after 0.1 s")


def started(skill: str, folder: Path, line: str) -> subprocess.Popen[str]:
    """A run that has printed a line."""
    process = subprocess.Popen(
        [*COMMAND, skill], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    while line not in process.stdout.readline():
        assert process.poll() is None
    return process


def test_ctrl_c_preempts(skills: Path) -> None:
    process = started("work", skills, "at it")
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=command_line.TIME_LIMIT_S)
    assert out.splitlines() == ["preempted", "ended", "->Work-work(Failure)[-405] stopped"]
    assert err.rstrip().endswith("it was stopped from the keyboard")
    assert process.returncode == 1


def test_a_second_ctrl_c_ends_what_hangs(skills: Path) -> None:
    process = started("hang", skills, "hangs")
    assert process.stdout is not None
    process.send_signal(signal.SIGINT)
    sent_ns = time.monotonic_ns()
    while int(process.stdout.readline().split()[1]) < sent_ns:
        pass  # written before
    process.stdout.readline()  # it goes on all the same, and a second signal is not one with it
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=command_line.TIME_LIMIT_S)
    assert process.returncode not in (0, None)
    assert "Traceback" not in err


def test_what_could_be_several_individuals_is_asked(tmp_path: Path) -> None:
    scene = tmp_path / "lab.turtle"
    text = (EXAMPLE / "lab.turtle").read_text(encoding="utf-8")
    scene.write_text(text + "rparts:ArmDevice-20 a rparts:ArmDevice .\n", encoding="utf-8")
    words = (*PICK[:2], "--scene", str(scene), PICK[-1], "Object=cable", "--simulate", "--ask")
    done = run(*words, given="7\n2\n")
    assert done.returncode == 0, done.stderr
    assert "  2  Robot=cora:Robot-1, Arm=rparts:ArmDevice-20" in done.stdout
    assert "Arm=rparts:ArmDevice-20" in done.stdout.partition("it could be")[0].splitlines()[-1]
    given_up = run(*words)
    assert given_up.returncode == 1
    assert "Traceback" not in given_up.stderr


def test_a_terminal_shows_a_tree() -> None:
    master, slave = pty.openpty()
    process = subprocess.Popen(
        [*COMMAND, *PICK, "Object=cable", "--simulate"],
        stdout=slave,
        stderr=slave,
        env={**os.environ, "TERM": "xterm", "COLUMNS": "100", "LINES": "40"},
    )
    os.close(slave)
    shown = b""
    while True:
        try:
            part = os.read(master, 4096)
        except OSError:  # Linux says so at the end
            break
        if not part:
            break
        shown += part
    os.close(master)
    assert process.wait(command_line.TIME_LIMIT_S) == 0
    assert b"SerialStar" in shown
    assert b"WmMoveObject" in shown
    assert b"->Pick-pick" not in shown


def test_a_module_that_was_not_run_whole_is_only_simulated(tmp_path: Path) -> None:
    text = "import socket\n\narm = socket.create_connection(('arm', 1))\n" + SKILLS
    (tmp_path / "skills.py").write_text(text, encoding="utf-8")
    done = run("Work", folder=tmp_path)
    assert done.returncode == 2
    assert "EZS231" in done.stderr + done.stdout
    assert "nothing was run" in done.stderr
    assert run("Work", "--simulate", folder=tmp_path).returncode == 0


@pytest.mark.parametrize(
    ("module", "code"), [("rospy", "EZS004"), ("of_a_vendor", "EZS004"), ("actionlib", "EZS233")]
)
def test_primitives_on_stand_ins_are_only_simulated(tmp_path: Path, module: str, code: str) -> None:
    (tmp_path / "skills.py").write_text(
        SKILLS.replace("class work", f"import {module}\n\nclass work").replace(
            'return self.step("at it")', f"{module}.stop(); return self.success()"
        ),
        encoding="utf-8",
    )
    if code == "EZS233":  # it is installed
        (tmp_path / f"{module}.py").write_text("def stop(): raise OSError", encoding="utf-8")
    done = run("Work", "skills.py", folder=tmp_path)
    assert done.returncode == 2
    assert code in done.stdout
    assert f"import {module}" in done.stdout
    assert "has succeeded" not in done.stdout
    assert "import them in the methods that use them" in done.stderr
    assert run("Work", "skills.py", "--simulate", folder=tmp_path).returncode == 0
