"""Measure the queries about rules for different numbers of rules; write the tables as a page."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path

from machine import processor
from written_page import written_page

from rossmarie.analysis.conflict import find_conflicts
from rossmarie.analysis.decided import find_decided
from rossmarie.analysis.failures import find_unnoticed
from rossmarie.analysis.feedback import find_alternating
from rossmarie.analysis.holding import find_self_holding
from rossmarie.analysis.implied import find_implied
from rossmarie.analysis.inquiry import Inquiry
from rossmarie.analysis.latches import find_released_latches
from rossmarie.analysis.queries import ask_all
from rossmarie.analysis.rates import find_unfit_durations
from rossmarie.analysis.recovery import find_blocked
from rossmarie.analysis.release import find_never_cleared
from rossmarie.driver import compile_file
from rossmarie.driver.analyze import TOGGLE_NS

HERE = Path(__file__).parent
BENCH = HERE.parent / "build" / "bench"
COUNTS = (3, 10, 30, 100)
SIMPLE_COUNTS = (8, 30, 100, 300)
QUERIES = {
    "conflicting rules (quick)": lambda asked: find_conflicts(asked, thorough=False),
    "rules that are never or always active, constant parts of conditions (quick)": lambda asked: (
        find_decided(asked, thorough=False)
    ),
    "stale inputs that activate no rule (quick)": find_unnoticed,
    "blocked recoveries (quick)": find_blocked,
    "rules that keep themselves active (quick)": find_self_holding,
    "latched rules that a rule resets (quick)": find_released_latches,
    "rules that activate each other (quick)": find_alternating,
    "durations that do not fit the message rates (quick)": find_unfit_durations,
    "superfluous rules, rules that never get their resource": find_implied,
    "rules that are never cleared": find_never_cleared,
}


def rules(count: int) -> str:
    """Rules with durations over four inputs. Each pair of rules needs the same parameter."""
    lines = [
        "system base { topic /imu : sensor_msgs/Imu at 100 Hz;",
        "topic /odom : nav_msgs/Odometry at [15, 25] Hz; }",
        "input orientation = topic /imu : sensor_msgs/Imu .orientation timeout 0.2 sec",
        "input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec",
        "input force = topic /wrench : geometry_msgs/Wrench .force timeout 0.1 sec",
        "input ranges = topic /scan : sensor_msgs/LaserScan .ranges timeout 0.5 sec",
    ]
    conditions = (
        "(orientation.pitch() > {0} deg for 2 sec) and speed > 0.{0} m/s",
        "(norm(force) > {0} N for 1 sec) or min(ranges) < 0.{0} m",
        "abs(speed) > {0} m/s and (any(ranges < 0.{0} m) for 0.5 sec)",
    )
    for number in range(count):
        condition = conditions[number % 3].format(10 + number % 70)
        lines.append(f"action act{number} {{ set /planner{number // 2}.speed to 0.{number + 1}; }}")
        lines.append(f"rule r{number}: if {condition} then {{ act{number}; }} clear for 2 sec;")
    return "\n".join(lines) + "\n"


def simple_rules(count: int) -> str:
    """Rules with one or two thresholds each, over five inputs. No rule conflicts with another."""
    lines = [
        "input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec",
        "input orientation = topic /imu : sensor_msgs/Imu .orientation timeout 0.2 sec",
        "input force = topic /wrench : geometry_msgs/Wrench .force timeout 0.1 sec",
        "input ranges = topic /scan : sensor_msgs/LaserScan .ranges timeout 0.5 sec",
        "input charge = topic /battery : sensor_msgs/BatteryState .percentage timeout 5 sec",
    ]
    conditions = (
        "speed > 0.{0} m/s",
        "abs(orientation.pitch()) > {0} deg for 1 sec",
        "norm(force) > {0} N",
        "min(ranges) < 0.{0} m",
        "charge < 0.{0} and speed > 0.{0} m/s",
    )
    for number in range(count):
        condition = conditions[number % 5].format(10 + number % 70)
        lines.append(f'action act{number} {{ log warning "rule {number}"; }}')
        lines.append(f"rule r{number}: if {condition} then {{ act{number}; }} clear for 2 sec;")
    return "\n".join(lines) + "\n"


def simple_seconds(count: int) -> tuple[float, float]:
    """The CPU time to parse, check and lower `count` simple rules, and the CPU time of all quick
    queries about them (s).
    """
    path = BENCH / f"simple_{count}.ross"
    path.write_text(simple_rules(count), encoding="utf-8")
    start = time.process_time()
    machine = compile_file(path).machine
    compiled = time.process_time()
    assert not list(ask_all(machine, thorough=False, within_ns=TOGGLE_NS)), (
        "the queries find nothing"
    )
    return compiled - start, time.process_time() - compiled


def seconds(count: int) -> dict[str, float]:
    """The CPU time of each query about `count` rules (s)."""
    BENCH.mkdir(parents=True, exist_ok=True)
    path = BENCH / f"queries_{count}.ross"
    path.write_text(rules(count), encoding="utf-8")
    machine = compile_file(path).machine
    took = {}
    for name, query in QUERIES.items():
        start = time.process_time()
        list(query(Inquiry(machine)))
        took[name] = time.process_time() - start
    return took


PREFACE = """\
# Cost of queries about rules

Written by `benchmarks/queries.py`; do not edit. All figures are CPU seconds of one process, on
{processor}. The rules are generated: their conditions have durations and
use four inputs, and each pair of rules needs the same parameter.
"""
SIMPLE = """
The rules of the next table have one or two thresholds each. The queries find nothing, and the
process has already imported all modules:
"""


def page() -> str:
    """The text of the page."""
    found = {count: seconds(count) for count in COUNTS}
    totals = [
        sum(took for name, took in found[count].items() if "quick" in name) for count in COUNTS
    ]
    lines = [
        PREFACE.format(processor=processor()),
        *_head("Query", COUNTS),
        *(_line(name, [found[count][name] for count in COUNTS]) for name in QUERIES),
        _line("all quick queries", totals),
        *simple_lines(),
    ]
    return "\n".join(lines) + "\n"


def simple_lines() -> list[str]:
    """The table of simple rules."""
    simple_seconds(SIMPLE_COUNTS[0])  # the first run also loads the tables of the parser
    found = [simple_seconds(count) for count in SIMPLE_COUNTS]
    return [
        SIMPLE,
        *_head("", SIMPLE_COUNTS),
        _line("parse, check and lower", [compiled for compiled, _ in found]),
        _line("all quick queries", [asked for _, asked in found]),
    ]


def _head(first: str, counts: Sequence[int]) -> list[str]:
    """The first two lines of a table, with a column for each number of rules."""
    start = f"| {first} " if first else "| "
    cells = " | ".join(f"{count} rules" for count in counts)
    return [f"{start}| {cells} |", "|---" * (len(counts) + 1) + "|"]


def _line(name: str, figures: Sequence[float]) -> str:
    return f"| {name} | {' | '.join(f'{each:.2f}' for each in figures)} |"


def main() -> None:
    """Measure and write the page."""
    written_page(__doc__).write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
