"""Recovery trees in real SkiROS2: the delay from the activation of a rule to the preemption of a
primitive.
"""

from __future__ import annotations

import itertools
import os
import random
import shutil
import statistics
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from pathlib import Path

from machine import processor
from written_page import written_page

from support.backing_off import BEGUN, active, hosted, rules, said
from support.live import LIMIT, Ears, Process, until
from support.parts import ROS1, SKIROS2
from support.ros1_build import Workspace
from support.ros1_live import Ros1
from support.skiros2_live import SkiROS2

ROOT = Path(__file__).parents[1]
MESSAGES = ROOT / "ros" / "ros1" / "skill_context_msgs"
ROUNDS = 100
TICK_MS = 40.0
"""SkiROS2 asks its ticker for 25 Hz."""
SLACK_MS = 5.0
ALLOWED_MS = TICK_MS + SLACK_MS
PULL = -20.0
"""A force (N) that a tree answers which ends with its rule only."""

VERDICTS, GOALS, TICKS = "/stuck_safety/verdicts", "/recovery/goal", "/heron/tick_rate"
STATE = "/stuck_safety/state"
TOPICS = {
    VERDICTS: "stuck_safety/Verdict",
    STATE: "stuck_safety/State",
    GOALS: "skill_context_msgs/RecoverActionGoal",
    TICKS: "std_msgs/Empty",
}
CLEARED, ACTIVATED = 0, 1

PREFACE = """\
Written by `benchmarks/recovering.py`; do not edit. One run on one machine ({processor}), at the
usual priority.

The skill manager of real SkiROS2 runs a task, and the node of the rules is a process of its own
beside it. A rule becomes active {rounds} times, at instants that have nothing to do with the
ticks, and asks for a behavior tree in the place of the task; then the rule is released. Instants
are those that the node and the skills say themselves, by one clock.

SkiROS2 asks its ticker for 25 Hz: a tick is {tick:.0f} ms. From tick to tick it took {period} ms
in this run (p50, p90, max).
"""

Delays = dict[str, list[float]]
"""Seconds, one for each round; and numbers of ticks."""

ACTIVE = "rule active"
CLEAR = "rule cleared"
LATER = "ticks between"
SENT = f"{ACTIVE} to goal sent"
PREEMPTED = f"**{ACTIVE} to `onPreempt` of the primitive of the task**"
BEGINS = f"{ACTIVE} to `onStart` of the first primitive of the tree"
RELEASED = f"{CLEAR} to `onPreempt` of the primitive of the tree"
RESUMED = f"{CLEAR} to `onStart` of the primitive of the task"
IN_TIME = {PREEMPTED: f"at most {ALLOWED_MS:.0f}"}


def lines(folder: Path) -> Iterator[str]:
    """The page; one sentence where SkiROS2 is not installed."""
    yield "# How soon a recovery begins in SkiROS2"
    yield ""
    lacking = [str(part) for part in (ROS1, SKIROS2) if part.missing]
    if lacking:
        yield "Written by `benchmarks/recovering.py`; do not edit."
        yield ""
        yield f"Not measured: this machine lacks {' and '.join(lacking)}."
        return
    shutil.rmtree(folder, ignore_errors=True)
    delays, periods = measured(folder.resolve())
    at_once = delays.pop(LATER).count(0)
    about = {"processor": processor(), "rounds": ROUNDS, "tick": TICK_MS}
    yield PREFACE.format(**about, period=", ".join(marks(periods)))
    yield "| | p50, ms | p90, ms | max, ms | to reach, ms |"
    yield "|---|---|---|---|---|"
    for name, found in delays.items():
        yield f"| {name} | {' | '.join(marks(found))} | {IN_TIME.get(name, '')} |"
    within = sum(1e3 * each <= ALLOWED_MS for each in delays[PREEMPTED])
    yield ""
    yield f"{within} of {ROUNDS} activations preempt the task within {ALLOWED_MS:.0f} ms."
    yield f"In {at_once} of {ROUNDS} no tick passes between the goal and the tick that preempts:"
    yield "one that takes longer waits for a tick that the machine holds up."


def main() -> None:
    """Measure, print and write."""
    out = written_page(__doc__)
    found: list[str] = []
    for line in lines(ROOT / "build" / "bench" / "recovering"):
        print(line, flush=True)
        found.append(line)
    out.write_text("\n".join(found) + "\n", encoding="utf-8")


def measured(folder: Path) -> tuple[Delays, list[float]]:
    """The delays of all rounds, and the seconds from tick to tick."""
    notes, workspace = folder / "notes", folder / "robot"
    workspace.mkdir(parents=True)
    os.environ["NOTES"] = str(notes)
    ros = Ros1(folder / "ros", Workspace(folder / "workspace"))
    started: list[Process] = []
    with ExitStack() as stack:
        stack.callback(ros.end)
        stack.callback(lambda: [each.end() for each in reversed(started)])
        robot = hosted(workspace)
        _, program = ros.prepare([MESSAGES, rules(workspace)])
        SkiROS2(ros, robot, folder, started)
        until(lambda: said(notes) == BEGUN[:1], "the task runs")
        started.append(ros.begin(program, {"patience": LIMIT}))
        heard = [word for topic in TOPICS.items() for word in topic]
        sensor = ros.ears(*heard, script="forceful.py")
        started.append(sensor)
        return _rounds(sensor, notes)


def _rounds(sensor: Ears, notes: Path) -> tuple[Delays, list[float]]:
    for topic in TOPICS:
        sensor.connected(topic)
    until(lambda: sensor.last(STATE) is not None, "the node speaks")
    found: Delays = {name: [] for name in (SENT, PREEMPTED, BEGINS, RELEASED, RESUMED, LATER)}
    sensor.ask(forget=TICKS)
    for _ in range(ROUNDS):
        for name, each in _round(sensor, notes).items():
            found[name].append(each)
    ticks = itertools.pairwise(_ticks(sensor))
    return found, [after - before for before, after in ticks]


def _round(sensor: Ears, notes: Path) -> dict[str, float]:
    """The seconds from what the rule does to what the skills do, and how many ticks pass between
    the goal and the tick that preempts.
    """
    before = len(_instants(notes))
    sensor.ask(forget=VERDICTS)
    time.sleep(random.uniform(0.2, 0.4))
    sensor.set(force=PULL)
    until(lambda: len(_instants(notes)) == before + 2, "the tree has begun")
    time.sleep(random.uniform(0.2, 0.4))
    sensor.set(force=0.0)
    until(lambda: len(_instants(notes)) == before + 4, "the task goes on")
    until(lambda: active(sensor) == [], "the rule is released")
    begun = _verdict(sensor, ACTIVATED)
    cleared = _verdict(sensor, CLEARED)
    preempted, begins, released, resumed = _instants(notes)[before:]
    (goal, _), slack = sensor.ask(last=GOALS), SLACK_MS / 1e3
    return {
        SENT: sensor.last(GOALS)["goal_id"]["stamp"] - begun,
        PREEMPTED: preempted - begun,
        BEGINS: begins - begun,
        RELEASED: released - cleared,
        RESUMED: resumed - cleared,
        LATER: sum(goal + slack < each < preempted - slack for each in _ticks(sensor)),
    }


def _ticks(sensor: Ears) -> list[float]:
    """The instants at which ticks began, heard by another process."""
    return [at for at, _ in sensor.ask(heard=TICKS)]


def _verdict(sensor: Ears, change: int) -> float:
    """The instant at which the rule changed so."""
    (found,) = [each["at"] for each in sensor.heard(VERDICTS) if each["change"] == change]
    return float(found)


def _instants(notes: Path) -> list[float]:
    """The instants that the skills recorded."""
    text = notes.read_text(encoding="utf-8")
    return [float(line.rpartition(" ")[2]) for line in text.splitlines()]


def marks(seconds: Sequence[float]) -> list[str]:
    """The median, the 90th percentile and the maximum, in milliseconds."""
    found = (statistics.median(seconds), statistics.quantiles(seconds, n=10)[8], max(seconds))
    return [f"{1e3 * each:.1f}" for each in found]


if __name__ == "__main__":
    main()
