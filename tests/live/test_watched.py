"""A robot that is watched while it runs: `crosscheck live` beside the node of its rules."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest

from rossmarie.driver import compile_file
from support.live import LIMIT, Ears, Process, Ros, Wanted, until
from support.ros1_live import set_parameters

ROOT = Path(__file__).parents[2]
RULES = ROOT / "tests" / "fixtures" / "skillful" / "skillful.ross"
DIGEST = f"c0ffee{'0' * 58}"
DEBIAN = "/usr/lib/python3/dist-packages"
"""The folder of rospy in Debian."""
GLASS = ("Push", [("Object", "skiros.Glass", 0.3)])
NODE = "skillful_safety"

Line = dict[str, Any]


def needs(generation: str) -> Sequence[Wanted]:
    return [ROOT / "ros" / generation / "skill_context_msgs", compile_file(RULES).machine]


pytestmark = [pytest.mark.builds(by=needs)]


class Watching:
    """`crosscheck live`, and what it has said so far."""

    def __init__(self, ros: Ros, log: Path, *arguments: str) -> None:
        paths = [ros.variables.get("PYTHONPATH", ""), *sys.path]
        if ros.name == "ros1":
            paths.append(DEBIAN)
        variables = {**ros.variables, "PYTHONPATH": os.pathsep.join(filter(None, paths))}
        command = [sys.executable, "-m", "crosscheck", "live", str(RULES), *arguments]
        self._log = log
        with log.open("wb") as out:
            self.process = subprocess.Popen(
                command, env=variables, stdout=out, stderr=subprocess.STDOUT
            )

    def said(self) -> str:
        return self._log.read_text("utf-8", "replace")

    def lines(self) -> list[Line]:
        """All that was reported, of JSON lines that are whole."""
        found = self.said().splitlines(keepends=True)
        return [json.loads(line) for line in found if line.startswith("{") and line[-1] == "\n"]

    def changes(self, kind: str) -> list[Line]:
        return [line for line in self.lines() if line.get("change") == kind]

    def codes(self) -> list[str]:
        return [line["finding"]["code"] for line in self.lines() if "finding" in line]

    def until(self, is_so: Callable[[], bool], what: str) -> None:
        def is_so_or_over() -> bool:
            assert self.process.poll() is None, self.said()
            return is_so()

        try:
            until(is_so_or_over, what)
        except AssertionError as error:
            raise AssertionError(f"{error}; it said: {self.said()}") from error

    def ended(self, how: int) -> Line:
        """The summary, after a signal."""
        self.process.send_signal(how)
        self.process.wait(LIMIT)
        summary: Line = self.lines()[-1]["summary"]
        return summary


@pytest.fixture
def begin(ros: Ros, programs: Sequence[Path], started: list[Process]) -> Callable[[str], Ears]:
    """Starts a robot and its node, in a namespace. It feels a force, and no skill runs."""

    def begin(namespace: str) -> Ears:
        robot = ros.ears(namespace, script="skillful.py")
        started.append(robot)
        robot.set(digest=DIGEST, force=20.0)
        started.append(ros.begin(programs[1], {"patience": LIMIT}, namespace=namespace))
        return robot

    return begin


@pytest.fixture
def watch(ros: Ros, tmp_path: Path) -> Iterator[Callable[..., Watching]]:
    """Watches a robot."""
    found: list[Watching] = []

    def watch(*arguments: str) -> Watching:
        found.append(Watching(ros, tmp_path / f"live{len(found)}.log", *arguments))
        return found[-1]

    yield watch
    for each in found:
        each.process.kill()
        each.process.wait(LIMIT)


def test_what_skills_and_rules_do_is_reported_as_they_do_it(
    begin: Callable[[str], Ears], watch: Callable[..., Watching]
) -> None:
    robot, watching = begin(""), watch("--format", "json")

    def is_active(rule: str) -> bool:
        return any(each["rule"] == rule for each in watching.changes("rule-activates"))

    watching.until(lambda: is_active("contact"), "contact is active")
    robot.set(skills=[GLASS])
    watching.until(lambda: bool(watching.changes("skill-starts")), "Push starts")
    watching.until(lambda: bool(watching.changes("exemption-begins")), "the exemption is used")
    assert watching.changes("skill-starts")[0]["text"] == "Push starts: Object = skiros.Glass"
    (used,) = watching.changes("exemption-begins")
    assert (used["rule"], used["exempted"]) == ("contact_doing_Push", "contact")
    assert "`Push` permits contact with skiros.Product" in used["text"]
    robot.set(skills=[])
    watching.until(lambda: bool(watching.changes("exemption-ends")), "it is not used any more")
    watching.until(lambda: bool(watching.changes("skill-ends")), "Push ends")
    assert watching.codes() == []
    summary = watching.ended(signal.SIGINT)
    assert watching.process.returncode == 0
    assert summary["skills"]["Push"]["times"] == 1
    assert summary["rules"]["contact"]["times"] == 2


def test_what_is_amiss_is_reported_once_until_it_is_over(
    begin: Callable[[str], Ears],
    watch: Callable[..., Watching],
    started: list[Process],
    ros: Ros,
    programs: Sequence[Path],
) -> None:
    robot, watching = begin(""), watch("--format", "json")

    def is_over(code: str) -> bool:
        return any(each["code"] == code for each in watching.changes("finding-over"))

    def tells(code: str) -> None:
        watching.until(lambda: code in watching.codes(), code)

    watching.until(lambda: bool(watching.changes("rule-activates")), "the node is heard")
    robot.set(digest=f"c0ffee{'1' * 58}")
    tells("CHK401")
    robot.set(digest=DIGEST)
    watching.until(lambda: is_over("CHK401"), "it is this export again")
    robot.set(is_talking=False)
    tells("CHK403")
    robot.set(is_talking=True, skills=[("Dance\x1b[2J" + "!" * 10_000, [])])
    watching.until(lambda: is_over("CHK403"), "the context is reported again")
    tells("CHK402")
    robot.set(skills=[])
    started.pop().end()
    tells("CHK404")
    started.append(ros.begin(programs[1], {"patience": LIMIT}))
    watching.until(lambda: is_over("CHK404"), "the node is heard again")
    found = watching.ended(signal.SIGTERM)
    assert watching.process.returncode == 1
    assert sorted(watching.codes()) == ["CHK401", "CHK402", "CHK403", "CHK404"]
    assert found["findings"] == 4
    assert "\x1b" not in watching.said()
    assert "!" * 200 not in watching.said()


def test_a_robot_in_a_namespace_is_reported_alone_and_time_may_stand_still(
    begin: Callable[[str], Ears], watch: Callable[..., Watching], ros: Ros
) -> None:
    robots = {"/robot1": begin("/robot1"), "/robot2": begin("/robot2")}

    def have_begun() -> bool:
        return all(each.last(f"{name}/{NODE}/state") for name, each in robots.items())

    until(have_begun, "the nodes have their clocks")
    if ros.name == "ros1":  # for all who start after this; in ROS 2 each node is reported by itself
        set_parameters(ros.variables, "crosscheck_live", {}, use_sim_time=True)
    watching = watch("--namespace", "robot1", "--format", "json")
    watching.until(lambda: bool(watching.changes("rule-activates")), "contact is active")
    robots["/robot1"].set(skills=[GLASS])
    watching.until(lambda: bool(watching.changes("exemption-begins")), "the exemption is used")
    assert {each["rule"] for each in watching.changes("rule-activates")} == {"contact"}
    assert watching.codes() == []
    nobody = watch("--namespace", "/robot3", "--duration", "1")
    assert nobody.process.wait(LIMIT) == 1, nobody.said()
    assert "error[CHK403]" in nobody.said()
    assert "on /robot3/skill_context" in nobody.said()
    assert "error[CHK404]: no message from /robot3/skillful_safety for" in nobody.said()
    assert "watched for 1" in nobody.said()
    watching.ended(signal.SIGTERM)
