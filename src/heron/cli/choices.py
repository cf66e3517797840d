"""Checks of arguments and of the installation before the simulation is imported. A failed check
ends the run with one line that names the missing part.
"""

from __future__ import annotations

import enum
import os
import re
import sys
from collections.abc import Sequence
from ctypes.util import find_library
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from dslkit.catalog import Catalog
from dslkit.command_line import CommandLine
from heron.extras import EXTRAS
from heron.variants import (
    ALGORITHMS,
    ARMS,
    BUDGETS,
    LEARNING_ARMS,
    LEAST_BUDGETS,
    VARIANTS,
    ExperimentArm,
    Formulation,
    LearningArm,
)

if TYPE_CHECKING:  # needs MuJoCo
    from dslkit.campaign import Workers


def _catalog() -> Catalog:
    from rossmarie.catalog import CATALOG

    return CATALOG


_LIMIT_S = 600.0  # of one episode
TRAINING_LIMIT_S = 7200.0
_SKRL = "skrl"
_LEARNERS = {"cma-es": "cmaes"}  # the others are of skrl
_FILMS = (".mp4", ".gif")
_PARTS = {
    "MuJoCo": "mujoco",
    "Matplotlib": "matplotlib",
    "Pillow": "PIL",
    "SciPy": "scipy",
    "imageio-ffmpeg": "imageio_ffmpeg",
}
_VERSION = sys.version_info[:2]
_OLDEST = (3, 11)  # for which MuJoCo has wheels
output = CommandLine(
    tool="heron",
    subject="what you called it with",
    internal_code="HERON",
    unreadable=frozenset(),
    catalog=_catalog,
    distribution="heron-robot",
    extras=lambda: EXTRAS,
)


def draw_without_display() -> None:
    """Choose EGL before the import of MuJoCo: MuJoCo reads this choice at its import."""
    os.environ.setdefault("MUJOCO_GL", "egl" if find_library("EGL") else "disable")


def require_drawing() -> None:
    """End the run if nothing can be drawn here, before it takes its time."""
    draw_without_display()
    if os.environ["MUJOCO_GL"] == "disable":
        output.fail(
            "films need EGL, which is missing: on Debian, install libegl1 and libgl1-mesa-dri",
            exit_code=2,
        )


def require_arm(experiment: str, arm: ExperimentArm) -> None:
    """End the run if the experiment has no such guard."""
    if arm not in ARMS[experiment]:
        there_are = ", ".join(each.value for each in ARMS[experiment])
        output.fail(
            f"experiment {experiment} has no arm {arm.value}; there are {there_are}", exit_code=2
        )


def require_place(out: Path) -> None:
    """End the run if a file cannot be written, or if it would replace a file of the user. Its
    folder need not exist yet.
    """
    output.try_folder(out.parent, out.name)


def require_campaign(out: Path, page: str, journal: Path) -> None:
    """End the run if the page of a campaign or the files next to its journal would replace files of
    the user. Files next to a journal belong to its campaign.
    """
    output.try_folder(out, page)
    if journal.exists() or output.permission.is_given:
        return
    for path in sorted(journal.parent.glob("*")):
        if path.suffix in (".csv", ".svg"):
            output.require_own_file(path)


def require_trace(out: Path) -> None:
    """End the run if a trace could not be written into a file of this name."""
    if out.suffix != ".jsonl":
        output.fail(f"the name of the trace must end in .jsonl, unlike {out}", exit_code=2)
    require_place(out)


def require_film(out: Path) -> None:
    """End the run if a film could not be written into a file of this name."""
    if out.suffix.lower() not in _FILMS:
        output.fail(f"the name of the film must end in .mp4 or .gif, unlike {out}", exit_code=2)
    require_place(out)


def workers_of(jobs: int | None, ray: str | None, limit_s: float = _LIMIT_S) -> Workers:
    """Processes of this machine, or a Ray cluster at HOST:PORT. On this machine an episode, or a
    training, takes `limit_s` at most.
    """
    from dslkit.campaign import Processes

    if ray is None:
        return Processes(jobs or Processes.cores(), limit_s)
    if not re.fullmatch(r"\S+:\d+", ray):
        output.fail(f"--ray needs HOST:PORT, not `{ray}`", exit_code=2)
    if find_spec("ray") is None:
        output.fail(f"--ray needs Ray: {EXTRAS.advice('ray')}", exit_code=2)
    from dslkit.campaign.ray_cluster import RayCluster

    return RayCluster(ray)


def known(experiment: str) -> str:
    """The name of an experiment that there is; known before the simulation is imported."""
    if experiment not in VARIANTS:
        there_are = ", ".join(VARIANTS)
        output.fail(f"there is no experiment {experiment}; there are {there_are}", exit_code=2)
    return experiment


def variant_of(experiment: str, wanted: str | None) -> enum.Enum:
    """A variant by its name, else the first one."""
    variants = {variant.value: variant for variant in VARIANTS[experiment]}
    if wanted is None:
        return VARIANTS[experiment][0]
    if wanted not in variants:
        there_are = ", ".join(variants)
        output.fail(f"{experiment} has no variant {wanted}; there are {there_are}", exit_code=2)
    return variants[wanted]


def algorithms_of(formulation: Formulation, wanted: Sequence[str] | None) -> list[str]:
    """The algorithms by their names, each once; else the usual one."""
    known = ALGORITHMS[formulation]
    for name in wanted or ():
        if name not in known:
            there_are = ", ".join(known)
            output.fail(
                f"{formulation.value} has no algorithm {name}; there are {there_are}", exit_code=2
            )
    return list(dict.fromkeys(wanted or known[:1]))


def learning_arms_of(
    formulation: Formulation, wanted: Sequence[LearningArm] | None
) -> list[LearningArm]:
    """The named arms, each once; by default all arms of the formulation."""
    known = LEARNING_ARMS[formulation]
    for arm in wanted or ():
        if arm not in known:
            there_are = ", ".join(each.value for each in known)
            output.fail(
                f"{formulation.value} has no arm {arm.value}; there are {there_are}", exit_code=2
            )
    return list(dict.fromkeys(wanted or known))


def budget_of(formulation: Formulation, steps: int | None) -> int:
    """The steps of a training, of which there are enough; else the usual number."""
    least = LEAST_BUDGETS[formulation]
    if steps is not None and steps < least:
        output.fail(
            f"--steps {steps} is too small: 32 environments of 300 steps learn in parallel, "
            f"so {formulation.value} needs {least} at least",
            exit_code=2,
        )
    return steps or BUDGETS[formulation]


def require_learning(algorithms: Sequence[str]) -> None:
    """End the run with the reason if a learner is not installed."""
    wanted = dict.fromkeys(_LEARNERS.get(name, _SKRL) for name in algorithms)
    missing = [name for name in wanted if find_spec(name) is None]
    if not missing:
        return
    reason = f"these trainings need {', '.join(missing)}, not installed for {sys.executable}"
    if _VERSION < _OLDEST:
        python, oldest = (".".join(map(str, each)) for each in (_VERSION, _OLDEST))
        reason = f"{reason}, which needs Python {oldest} or later; this is Python {python}"
    output.fail(f"{reason}: {EXTRAS.advice('learning')}", exit_code=2)


def require_gymnasium() -> None:
    """End the run if there can be no environments."""
    if find_spec("gymnasium") is None:
        output.fail(f"a learned policy needs Gymnasium: {EXTRAS.advice('gym')}", exit_code=2)


def require_simulation() -> None:
    """End the run with the reason if a part of the simulation is not installed, or cannot draw as
    the environment says.
    """
    missing = [name for name, module in _PARTS.items() if find_spec(module) is None]
    if not missing:
        _require_renderer()
        return
    reason = f"the simulation needs {', '.join(missing)}, not installed for {sys.executable}"
    if "MuJoCo" in missing and _VERSION < _OLDEST:
        python, oldest = (".".join(map(str, each)) for each in (_VERSION, _OLDEST))
        reason = (
            f"the simulation needs MuJoCo, which needs Python {oldest} or later; "
            f"this is Python {python}"
        )
    output.fail(f"{reason}: {EXTRAS.advice()}", exit_code=2)


def _require_renderer() -> None:
    """MuJoCo loads the library named by MUJOCO_GL at its import."""
    renderer = os.environ.get("MUJOCO_GL")
    if not renderer:
        return
    try:
        import mujoco  # noqa: F401
    except (AttributeError, ImportError, OSError, RuntimeError) as error:  # by the renderer
        output.fail(
            f"MuJoCo cannot draw with MUJOCO_GL={renderer} ({error}): unset it, or set it to egl "
            "or disable",
            exit_code=2,
        )
