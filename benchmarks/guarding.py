"""Measure the guard of a policy, alone and in a batch, and write the table as a page."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from machine import processor
from written_page import written_page

import rossmarie
from rossmarie.guard import Guard

SIGNALS = 20
COUNT = 1024
STEPS = 2_000
ROUNDS = 25
STEP_S, ENVIRONMENT_S = 2e-6, 0.2e-6
"""The targets: the time of a step from Python, and the time of one environment of a batch."""

HEAD = """
system robot { topic /cmd_vel : geometry_msgs/Twist; node planner { publishes /cmd_vel; } }
action slow { limit /cmd_vel { linear.x in [-0.2, 0.2] m/s; } ramp 0.3 m/s^2; }
"""
FIELDS = [f"{part}.{axis}" for part in ("linear", "angular") for axis in "xyz"]
LIMIT = {"linear": "m/s", "angular": "rad/s"}


def spread(rules: int) -> str:
    """Rules whose signals each have their own topic, with a timeout."""
    inputs = [
        f"input s{n} = topic /s{n} : std_msgs/Float64 in m/s timeout 1 sec;" for n in range(SIGNALS)
    ]
    conditions = [
        f"rule r{n}: if s{n % SIGNALS} > {1 + n / 1000} m/s "
        f"and s{(n + SIGNALS // 2) % SIGNALS} > -1 m/s then {{ slow; }};"
        for n in range(max(rules, SIGNALS))
    ]
    return "\n".join([HEAD, *inputs, *conditions[:rules]])


def together(rules: int) -> str:
    """Rules whose signals all have the same topic."""
    fields = [FIELDS[n % len(FIELDS)] for n in range(rules)]
    conditions = [
        f"rule r{n}: if odometry.twist.twist.{field} > {1 + n / 1000} "
        f"{LIMIT[field.partition('.')[0]]} then {{ slow; }};"
        for n, field in enumerate(fields)
    ]
    topic = "input odometry = topic /odom : nav_msgs/Odometry timeout 1 sec;"
    return "\n".join([HEAD, topic, *conditions])


def guard_of(rules: str, folder: Path) -> tuple[Guard, int]:
    """The guard of some rules, and the number of fields that the guard observes."""
    path = folder / "rules.ross"
    path.write_text(rules, encoding="utf-8")
    monitor = rossmarie.load(path)
    names = [name for channel in monitor.machine.channels for name in monitor.fields(channel.topic)]
    observe = {name: place for place, name in enumerate(names)}
    return monitor.guard(observe=observe, act={"linear.x": 0}), len(names)


def best(call: Callable[[], None]) -> float:
    """The minimum CPU time of the rounds, in seconds."""

    def once() -> float:
        start = time.thread_time()
        call()
        return time.thread_time() - start

    return min(once() for _ in range(ROUNDS))


def seconds_of_step(guard: Guard, size: int, seen: float) -> float:
    """The time of one step (s). The observation changes a little each time, and no rule changes."""
    observations = [np.full(size, seen + 0.001 * n) for n in range(3)]
    action = np.array([0.1, 0.2])

    def run() -> None:
        guard.restart()
        step = guard.step
        for at_ns in range(STEPS):
            step(at_ns, observations[at_ns % 3], action)

    return best(run) / STEPS


def seconds_of_row(guard: Guard, size: int, seen: float) -> float:
    """The time of one environment in a step of a batch (s)."""
    batch = guard.batch(COUNT)
    observations = [np.full((COUNT, size), seen + 0.001 * n) for n in range(3)]
    actions = np.full((COUNT, 2), 0.1)
    instants = iter(range(10**9))
    batch.step(next(instants), observations[0], actions)

    def run() -> None:
        at_ns = next(instants)
        batch.step(at_ns, observations[at_ns % 3], actions)

    return best(run) / COUNT


@dataclass(frozen=True)
class Row:
    """Times in seconds: a step while no rule is active, a step while all rules are active, and one
    environment of a batch.
    """

    rules: int
    size: int
    topics: str
    calm: float
    active: float
    of_row: float

    def __str__(self) -> str:
        return (
            f"| {self.rules} | {self.size}, {self.topics} | {1e6 * self.calm:.2f} µs "
            f"| {1e6 * self.active:.2f} µs | {1e6 * self.of_row:.3f} µs "
            f"| {1e9 * self.of_row / self.rules:.2f} ns |"
        )


def rows(folder: Path) -> Iterator[Row]:
    """A row for each number of rules."""
    for topics, text in (("each on its own topic", spread), ("all on one topic", together)):
        for rules in (3, 10, 30, 300):
            guard, size = guard_of(text(rules), folder)
            assert guard.kind == "native", guard.reason
            calm, active = (seconds_of_step(guard, size, seen) for seen in (0.5, 2.0))
            of_row = seconds_of_row(guard, size, 0.5)
            yield Row(rules, size, topics, calm, active, of_row)


def targets(found: Sequence[Row]) -> str:
    """The targets, each with its result."""
    (row,) = [each for each in found if (each.rules, each.size) == (10, SIGNALS)]
    step, environment = max(row.calm, row.active), row.of_row
    return (
        f"The targets for 10 rules and {SIGNALS} signals are {1e6 * STEP_S:g} µs per step "
        f"({_word(step <= STEP_S)}) and {1e6 * ENVIRONMENT_S:g} µs per environment of a batch "
        f"({_word(environment <= ENVIRONMENT_S)})."
    )


def _word(is_met: bool) -> str:
    return "met" if is_met else "missed"


PREFACE = """\
# Cost of the guard of a policy

Written by `benchmarks/guarding.py`; do not edit. All figures are CPU times of one thread, the
minimum of {rounds} rounds, on {processor}.

A step is one call of `guard.step` from Python, with numpy arrays as input and output. In the column
*step*, no rule is active. In the next column, all rules are active and limit the action. A batch
has {count:,} environments. One call of `batch.step` makes a step of all environments and
evaluates each rule once per environment. See [speed of the experiments](performance-heron.md) for
the cost of the guard in a simulated robot.
"""
COLUMNS = (
    "rules",
    "signals",
    "step",
    "step, all rules active",
    "batch, per environment",
    "batch, per environment and rule",
)


def page() -> str:
    """The text of the page."""
    with tempfile.TemporaryDirectory() as folder:
        found = list(rows(Path(folder)))
    preface = PREFACE.format(rounds=ROUNDS, processor=processor(), count=COUNT)
    head = [f"| {' | '.join(COLUMNS)} |", f"|{'---|' * len(COLUMNS)}"]
    return "\n".join([preface, targets(found), "", *head, *map(str, found), ""])


def main() -> None:
    """Measure and write the page."""
    written_page(__doc__).write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
