"""The call of the planner Fast Downward in its own process.

The program is located, but its Python modules are not imported.
"""

from __future__ import annotations

import contextlib
import math
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from ezskiros.engine.world import World
from ezskiros.extras import EXTRAS
from ezskiros.planning.facts import FluentLiteral, is_so, make_so
from ezskiros.planning.pddl import PlanStep, Problem

_PACKAGE = "up_fast_downward"
_PROGRAM = "downward/fast-downward.py"
_FIRST = ("--alias", "lama-first")
_CHEAPEST = ("--alias", "lama")
"""The option to search for cheaper plans, `plan.1`, `plan.2` and so on, until there is none."""
_END = "; cost = "
"""The beginning of the last line of a plan."""
# https://www.fast-downward.org/ExitCodes
_FOUND = range(4)
_UNSOLVABLE = range(10, 14)
_TIME_OVER = (21, 23)


class NoPlannerError(Exception):
    """The planner is not installed. The text explains the installation."""

    def __init__(self) -> None:
        super().__init__(f"planning needs a planner: {EXTRAS.advice('plan')}")


class TimeOverError(Exception):
    """The search took too long."""


def solve(problem: Problem, seconds: float) -> list[PlanStep] | None:
    """A plan, the cheapest one that is found in time if skills have costs; None if there is none.
    Raises `NoPlannerError` and `TimeOverError`.
    """
    program = _program()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "domain.pddl").write_text(problem.domain(), encoding="utf-8")
        (folder / "problem.pddl").write_text(problem.problem(), encoding="utf-8")
        # The planner is killed below after these seconds, and ends by itself if this process is
        # gone.
        limit = ("--overall-time-limit", f"{math.ceil(seconds) + 10}s")
        search = _CHEAPEST if problem.costs else _FIRST
        files = ("--plan-file", "plan", *limit, *search, "domain.pddl", "problem.pddl")
        try:
            code, said = _run([sys.executable, str(program), *files], folder, seconds)
        except TimeOverError:
            code, said = _TIME_OVER[0], ""
        plan = _last_plan(folder)
        if plan is not None and code in (*_FOUND, *_TIME_OVER):
            return problem.steps(plan)
    if code in _FOUND or code in _UNSOLVABLE:
        return None
    if code in _TIME_OVER:
        raise TimeOverError
    raise RuntimeError(f"the planner ended with exit code {code}: {said}")


def _last_plan(folder: Path) -> str | None:
    """The last complete plan; None if there is none."""
    files = sorted(folder.glob("plan*"), key=lambda each: int(each.suffix[1:] or 0))
    plans = [each.read_text(encoding="utf-8") for each in files]
    return next((each for each in reversed(plans) if f"\n{_END}" in f"\n{each}"), None)


def _program() -> Path:
    """The program, in the folder of its package. The package is not imported."""
    package = find_spec(_PACKAGE)
    for folder in (package and package.submodule_search_locations) or ():
        if (found := Path(folder) / _PROGRAM).is_file():
            return found
    raise NoPlannerError


def _run(command: Sequence[str], folder: Path, seconds: float) -> tuple[int, str]:
    """The exit code and the output of a program. The program ends together with all its child
    processes.
    """
    with subprocess.Popen(
        command,
        cwd=folder,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        start_new_session=True,
    ) as process:
        try:
            said, _ = process.communicate(timeout=seconds)
        except BaseException as error:
            with contextlib.suppress(ProcessLookupError):  # all processes have ended
                os.killpg(process.pid, signal.SIGKILL)
            if isinstance(error, subprocess.TimeoutExpired):
                raise TimeOverError from None
            raise
    return process.returncode, said.decode("utf-8", "replace")


# --- replay of a plan -----------------------------------------------------------------------------


@dataclass(frozen=True)
class Failed:
    """A failing step of a plan, and its missing need. After the last step, the missing need is the
    goal.
    """

    number: int
    needed: FluentLiteral


def tried(steps: Sequence[PlanStep], goals: Sequence[FluentLiteral], world: World) -> Failed | None:
    """Replay a plan on a world model, which changes. Returns the failing step, or None if the plan
    reaches the goals.
    """
    for number, step in enumerate(steps, 1):
        lacking = _done(step, world)
        if lacking is not None:
            return Failed(number, lacking)
    return next((Failed(len(steps) + 1, each) for each in goals if not is_so(each, world)), None)


def shortened(
    steps: Sequence[PlanStep], goals: Sequence[FluentLiteral], start: Callable[[], World]
) -> Sequence[PlanStep]:
    """A plan without unnecessary steps, because the first plan of a planner may make detours. Each
    step is left out in turn, together with the steps that depend on it (greedy action elimination:
    Nakhost and Müller, 2010).
    """
    number = 0
    while number < len(steps):
        world = start()
        others = (*steps[:number], *steps[number + 1 :])
        kept = [each for each in others if _done(each, world) is None]
        if all(is_so(each, world) for each in goals):
            steps = kept
        else:
            number += 1
    return steps


def _done(step: PlanStep, world: World) -> FluentLiteral | None:
    """Apply a step to a world model. Returns the missing need if this is impossible; then nothing
    changes.
    """
    individuals = dict(step.individuals)
    for clause in step.action.needs:
        bound = [each.bound(individuals) for each in clause]
        if not any(is_so(each, world) for each in bound):
            return bound[0]
    for effect in sorted(step.action.asserted, key=lambda each: each.is_true):
        make_so(effect.bound(individuals), world)
    return None
