"""Drive the course with rules and with Nav2's collision monitor; write the figures as a page."""

from __future__ import annotations

import math
import statistics
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, nullcontext
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain
from pathlib import Path

import course_rules
import nav2_node
import numpy as np
import rules_node
from course import (
    BEAMS,
    COMMAND_TICKS,
    DELAY_TICKS,
    NEAR_M,
    NS,
    SCAN_TICKS,
    SILENCE_S,
    TICK_S,
    Command,
    Contender,
    Odometry,
    Outcome,
    Scan,
    outcomes,
    unguarded,
)
from course_scenes import BRAKING, HALF_LENGTH, HALF_WIDTH, ORIGIN, SCENES, SPEED
from machine import processor
from nav2_model import CollisionMonitor
from nav2_settings import ALL, LATENCY_S, STOP_M, Settings
from written_page import written_page

RUNS = 10
PERIOD_S, COST_S, FAR_M = SCAN_TICKS * TICK_S, 10.0, 5.0
FOLDER = Path(__file__).parents[1] / "build" / "bench" / "course"

PREFACE = """\
# Rules and Nav2's collision monitor on one course

Written by `benchmarks/beside_nav2.py`; do not edit. All guards drive the same course, with {runs}
runs of each scene. Each run has its own seed.

**Base.** The base is {length:g} m long and {width:g} m wide, drives at {speed:g} m/s, and brakes at
{braking:g} m/s². A lidar at its center sends {beams} readings, {scans:g} times per second. A scan
arrives {delay:g} ms after its stamp. A planner that knows nothing about walls and people sends
{commands:g} commands per second. A guard may change each command.

**Guards.** {guards}

**Columns.**

- *collisions*: the runs in which the base drove into an obstacle.
- *reaction*: the time from the instant at which the braking distance of an unguarded base equals
  the free distance, to the first reduced command: the median and the maximum of all runs. A
  negative time means that the command was reduced before this instant.
- *gap*: the smallest distance between the base and an obstacle in all runs.
- *stops*: the stops per run, on average.
- *false stops*: the stops per run without need, on average. A stop is necessary if an obstacle
  ahead is closer than {near:.2f} m, or if the lidar has been silent for {silence:g} s. In some
  scenes, no stop is necessary.
- *slow*: the time per run in which commands are reduced without need, on average.
- *distance*: the distance travelled per run, on average.
- *goal*: the runs in which the base reached its goal.
"""

GUARDS = """\
Nav2's collision monitor is {how}. Its correction for
the motion since a scan is off, because the correction needs transforms. The monitor has two
settings. *approach* has the settings of `nav2_bringup`, with the outline of this base. *zones* has
two zones. The base stops in a zone of {stop:.2f} m: the distance of a latency of {latency:g} s plus
the braking distance. The base slows down in a zone of twice this length.

The rules are in `benchmarks/guards`. *zones* and *approach* have the shapes and numbers of the two
settings of Nav2. *stopping* has no fixed length: the base stops for an obstacle ahead that is
nearer than the stopping distance at the actual or commanded speed, and slows down at twice this
distance. *min(ranges)* has no geometry: the base stops and slows down at the distances of the
zones, by the minimum of all readings."""

COST = """\
The CPU time of the process of a ROS 2 node in {period:g} s of real time, including all transport.
In the column *idle*, the node receives no messages. In the next column, the node receives the
clock, commands and odometry; Nav2's node then logs each missing scan. In the last column, the node
also receives a scan whose readings are all {far:g} m. Each figure is the mean over
{seconds:g} s, on {machine}.
"""

HEAD = (
    "| guard | collisions | reaction, s | gap, m | stops | false stops | slow, s "
    "| distance, m | goal |"
)


@dataclass(frozen=True)
class Comparison:
    """The number of runs in which the node was compared with the model, and the number of equal
    runs.
    """

    runs: int = 0
    same: int = 0


def modelled(settings: Settings) -> Contender:
    """The model of Nav2's collision monitor."""
    return Contender(settings.name, lambda: nullcontext(CollisionMonitor(settings)))


@contextmanager
def nav2_nodes(folder: Path) -> Iterator[list[Contender]]:
    """The node, once with each of the settings."""
    with ExitStack() as stack:
        found = []
        for number, settings in enumerate(ALL):
            node = nav2_node.Node(settings, folder / f"nav2_{number}")
            stack.callback(node.end)
            found.append(node.contender)
        yield found


def drive(contenders: Sequence[Contender]) -> Mapping[tuple[str, str], list[Outcome]]:
    """All runs, by scene and guard."""
    return {
        (scene, each.name): list(outcomes(each, scene, RUNS))
        for scene in SCENES
        for each in contenders
    }


def compared(one: Sequence[Outcome], other: Sequence[Outcome]) -> Comparison:
    """Compare runs of the node with runs of the model. Their CPU times are not compared."""
    pairs = zip(map(_driven, one), map(_driven, other), strict=True)
    return Comparison(len(one), sum(left == right for left, right in pairs))


def _driven(outcome: Outcome) -> str:
    return str(replace(outcome, cpu_ns_of_scan=0.0))  # as text, NaN equals NaN


def row(name: str, runs: Sequence[Outcome]) -> str:
    """The row of one guard in one scene."""
    reactions = [each.reaction_s for each in runs if not math.isnan(each.reaction_s)]
    latest = f"{statistics.median(reactions):+.2f}, {max(reactions):+.2f}" if reactions else ""
    hits = sum(each.contact_speed > 0.0 for each in runs)
    goals = sum(each.is_at_goal for each in runs)
    figures = [
        f"{min(each.least_gap_m for each in runs):.2f}",
        *(f"{statistics.mean(numbers):.1f}" for numbers in _means(runs)),
    ]
    cells = [name, _of(hits, runs), latest, *figures, _of(goals, runs)]
    return "| " + " | ".join(cells) + " |"


def _means(runs: Sequence[Outcome]) -> Iterator[list[float]]:
    yield [each.stops for each in runs]
    yield [each.false_stops for each in runs]
    yield [each.falsely_slow_s for each in runs]
    yield [each.distance_m for each in runs]


def _of(count: int, runs: Sequence[Outcome]) -> str:
    return f"{count}/{len(runs)}"


def scene_lines(found: Mapping[tuple[str, str], list[Outcome]]) -> Iterator[str]:
    """The description and the table of each scene."""
    for scene, make in SCENES.items():
        rows = {guard: runs for (where, guard), runs in found.items() if where == scene}
        yield f"## {scene.capitalize()}"
        yield ""
        yield (make.__doc__ or "").replace("\n    ", "\n").strip()
        yield ""
        yield HEAD
        yield "|---|---|---|---|---|---|---|---|---|"
        yield from (row(guard, runs) for guard, runs in rows.items())
        blind = {guard: [each.blind_s for each in runs] for guard, runs in rows.items()}
        if any(map(math.isfinite, chain(*blind.values()))):
            yield ""
            yield from _blind_lines(blind)
        yield ""


def _blind_lines(blind: Mapping[str, Sequence[float]]) -> Iterator[str]:
    yield "The maximum time from the silence of the lidar to the first reduced command:"
    yield ""
    for guard, seconds in blind.items():
        if all(map(math.isfinite, seconds)):
            yield f"- {guard}: {max(seconds):.2f} s"


def cost_lines(folder: Path) -> Iterator[str]:
    """The section about the CPU time of the nodes."""
    yield "## Cost of a scan"
    yield ""
    lacking = nav2_node.missing()
    if lacking:
        yield f"Not measured: {lacking}."
        yield ""
        return
    yield COST.format(period=PERIOD_S, far=FAR_M, seconds=COST_S, machine=processor())
    yield "| node | idle | clock, commands, odometry | clock, commands, odometry, scan |"
    yield "|---|---|---|---|"
    makers: list[Callable[[], rules_node.Node | nav2_node.Node]] = [
        partial(nav2_node.Node, each, folder / "nav2_cost", is_checked=False) for each in ALL
    ]
    makers += [partial(rules_node.Node, each, folder / "rules") for each in course_rules.ALL]
    for make in makers:
        node = make()
        try:
            with node.contender.start():
                loads = ((False, False), (True, False), (True, True))
                spent = [spent_s(node, *load) for load in loads]
        finally:
            node.end()
        cells = (f"{1e6 * each:.0f} µs" for each in spent)
        yield f"| {' | '.join((node.contender.name, *cells))} |"
    yield ""


def spent_s(node: rules_node.Node | nav2_node.Node, has_commands: bool, has_scans: bool) -> float:
    """The CPU time of a node in the period of one scan (s)."""
    far = np.full(BEAMS, FAR_M, dtype=np.float32)
    command = Command(SPEED, 0.0)
    node.lockstep.begin()
    begin_s, begin_ns = time.monotonic(), node.cpu_ns()
    for number in range(round(COST_S / PERIOD_S * SCAN_TICKS / COMMAND_TICKS)):
        at_s = number * COMMAND_TICKS * TICK_S
        time.sleep(max(0.0, begin_s + at_s - time.monotonic()))
        if has_commands:
            is_due = has_scans and number * COMMAND_TICKS % SCAN_TICKS == 0
            at_ns = round(at_s * NS)
            odometry = Odometry(at_ns, ORIGIN, command)
            node.lockstep.tell(at_ns, Scan(at_ns, far) if is_due else None, odometry)
            node.lockstep.ask(command)
    time.sleep(max(0.0, begin_s + COST_S - time.monotonic()))
    return (node.cpu_ns() - begin_ns) / NS * PERIOD_S / COST_S


def model_lines(lacking: str | None, found: Sequence[Comparison]) -> Iterator[str]:
    """The section about the model of the node."""
    yield "## Node and model"
    yield ""
    if lacking:
        yield f"The node did not run on this machine ({lacking}). The figures are from the model"
        yield "`benchmarks/nav2_model.py`, whose docstring names its sources."
        return
    runs, same = sum(each.runs for each in found), sum(each.same for each in found)
    yield "The figures are from the node. A model of the node, `benchmarks/nav2_model.py`, drives"
    yield f"the same runs. In {same} of {runs} runs, the model has the same figures in all columns."


def lines(folder: Path) -> Iterator[str]:
    """The lines of the page."""
    lacking = nav2_node.missing()
    version = "" if lacking else nav2_node.version()
    how = "a model of the node" if lacking else f"the node itself, version {version}"
    guards = GUARDS.format(how=how, latency=LATENCY_S, stop=STOP_M)
    yield PREFACE.format(
        runs=RUNS,
        length=2 * HALF_LENGTH,
        width=2 * HALF_WIDTH,
        speed=SPEED,
        braking=BRAKING,
        beams=BEAMS,
        scans=1 / (SCAN_TICKS * TICK_S),
        delay=1e3 * DELAY_TICKS * TICK_S,
        commands=1 / (COMMAND_TICKS * TICK_S),
        guards=guards,
        near=NEAR_M,
        silence=SILENCE_S,
    )
    nobody = Contender("no guard", lambda: nullcontext(unguarded))
    models = [modelled(each) for each in ALL]
    ours = [each.contender(folder) for each in course_rules.ALL]
    if lacking:
        found, comparisons = drive([nobody, *models, *ours]), []
    else:
        with nav2_nodes(folder) as nodes:
            found = drive([nobody, *nodes, *ours])
        twins = drive(models)
        comparisons = [compared(found[place], runs) for place, runs in twins.items()]
    yield from scene_lines(found)
    yield from cost_lines(folder)
    yield from model_lines(lacking, comparisons)


def main() -> None:
    """Drive the course and write the page."""
    out = written_page(__doc__)
    text = "\n".join(lines(FOLDER)) + "\n"
    out.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
