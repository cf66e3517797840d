"""Measure recovery trees in a real SkiROS2: the delays from the activation of a rule to the
preemption of a primitive.
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
"""SkiROS2 requests 25 Hz from its ticker."""
SLACK_MS = 5.0
ALLOWED_MS = TICK_MS + SLACK_MS
PULL = -20.0
"""A force (N). The rule for this force requests a tree that ends only with the rule."""

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
Written by `benchmarks/recovering.py`; do not edit. All figures are from one run on one machine
({processor}). All processes have default priority.

The skill manager of a real SkiROS2 runs a task, and the node of the rules is a separate process. A
rule becomes active {rounds} times, at instants that are independent of the ticks. The rule requests
a behavior tree in place of the task; then the rule is cleared. The node and the skills record the
instants themselves, with the same clock.

SkiROS2 requests 25 Hz from its ticker, so a tick takes {tick:.0f} ms. In this run, the time from
tick to tick was {period} ms (p50, p90, max).
"""

Delays = dict[str, list[float]]
"""Delays in seconds, one for each round; and numbers of ticks."""

ACTIVE = "from rule active"
CLEAR = "from rule cleared"
LATER = "ticks between"
SENT = f"{ACTIVE} to goal sent"
PREEMPTED = f"**{ACTIVE} to `onPreempt` of the task's primitive**"
BEGINS = f"{ACTIVE} to `onStart` of the tree's first primitive"
RELEASED = f"{CLEAR} to `onPreempt` of the tree's primitive"
RESUMED = f"{CLEAR} to `onStart` of the task's primitive"
IN_TIME = {PREEMPTED: f"at most {ALLOWED_MS:.0f}"}


def lines(folder: Path) -> Iterator[str]:
    """The lines of the page; one sentence if SkiROS2 is not installed."""
    yield "# Latency of recoveries in SkiROS2"
    yield ""
    lacking = [str(part) for part in (ROS1, SKIROS2) if part.missing]
    if lacking:
        yield "Written by `benchmarks/recovering.py`; do not edit."
        yield ""
        yield f"Not measured: this machine does not have {' and '.join(lacking)}."
        return
    shutil.rmtree(folder, ignore_errors=True)
    delays, periods = measured(folder.resolve())
    at_once = delays.pop(LATER).count(0)
    about = {"processor": processor(), "rounds": ROUNDS, "tick": TICK_MS}
    yield PREFACE.format(**about, period=", ".join(marks(periods)))
    yield "| | p50, ms | p90, ms | max, ms | target, ms |"
    yield "|---|---|---|---|---|"
    for name, found in delays.items():
        yield f"| {name} | {' | '.join(marks(found))} | {IN_TIME.get(name, '')} |"
    within = sum(1e3 * each <= ALLOWED_MS for each in delays[PREEMPTED])
    yield ""
    yield f"{within} of {ROUNDS} activations preempt the task within {ALLOWED_MS:.0f} ms."
    yield f"In {at_once} of {ROUNDS} activations, no tick passes between the goal and the tick that"
    yield "preempts the task. A slower activation waits for a tick that the machine delays."


def main() -> None:
    """Measure, print and write the page."""
    out = written_page(__doc__)
    found: list[str] = []
    for line in lines(ROOT / "build" / "bench" / "recovering"):
        print(line, flush=True)
        found.append(line)
    out.write_text("\n".join(found) + "\n", encoding="utf-8")


def measured(folder: Path) -> tuple[Delays, list[float]]:
    """The delays of all rounds, and the times from tick to tick (s)."""
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
    until(lambda: sensor.last(STATE) is not None, "the node publishes its state")
    found: Delays = {name: [] for name in (SENT, PREEMPTED, BEGINS, RELEASED, RESUMED, LATER)}
    sensor.ask(forget=TICKS)
    for _ in range(ROUNDS):
        for name, each in _round(sensor, notes).items():
            found[name].append(each)
    ticks = itertools.pairwise(_ticks(sensor))
    return found, [after - before for before, after in ticks]


def _round(sensor: Ears, notes: Path) -> dict[str, float]:
    """The delays from the changes of the rule to the reactions of the skills (s), and the number of
    ticks between the goal and the tick that preempts the task.
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
    """The instants at which ticks began (s), recorded by another process."""
    return [at for at, _ in sensor.ask(heard=TICKS)]


def _verdict(sensor: Ears, change: int) -> float:
    """The instant of the verdict with this change (s)."""
    (found,) = [each["at"] for each in sensor.heard(VERDICTS) if each["change"] == change]
    return float(found)


def _instants(notes: Path) -> list[float]:
    """The instants that the skills recorded (s)."""
    text = notes.read_text(encoding="utf-8")
    return [float(line.rpartition(" ")[2]) for line in text.splitlines()]


def marks(seconds: Sequence[float]) -> list[str]:
    """The median, the 90th percentile and the maximum, in milliseconds."""
    found = (statistics.median(seconds), statistics.quantiles(seconds, n=10)[8], max(seconds))
    return [f"{1e3 * each:.1f}" for each in found]


if __name__ == "__main__":
    main()
