"""The results of trainings, for use without the training code."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from heron.learning.policy import POLICY, load_policy, require_small
from heron.learning.runs import TrainingRun
from heron.learning.tree import NUMBERS, RANGES, InsertionTree
from heron.variants import Formulation

Act = Callable[[NDArray[np.float64]], Any]
"""A function from an observation to an action, for one episode."""


@dataclass(frozen=True)
class Learned:
    """A learned policy or tree, and its formulation. `begin` gives the policy of one episode."""

    formulation: Formulation
    begin: Callable[[], Act]


def learned(folder: Path, run: TrainingRun) -> Act:
    """The policy of a training, or its tree, from its files in the folder of all trainings. Raises
    `OSError`, and `ValueError` if a file holds something else.
    """
    name = NUMBERS if run.formulation is Formulation.TREE else POLICY
    return read_learned(folder / run.folder / name).begin()


def read_learned(path: Path) -> Learned:
    """Read a file of learned values: the numbers of a tree if its name ends in .json, otherwise a
    policy. Raises `OSError`, and `ValueError` if the file contains something else.
    """
    require_small(path)
    if path.suffix == ".json":
        tree, numbers = InsertionTree(), _numbers(path)
        return Learned(Formulation.TREE, lambda: tree.policy(numbers))
    policy = load_policy(path)
    formulation = Formulation.STEPS if policy.bounds[0] else Formulation.MOVES
    return Learned(formulation, lambda: policy)


def _numbers(path: Path) -> dict[str, float]:
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        numbers = {name: float(found[name]) for name in RANGES}
    except (ValueError, KeyError, TypeError, OverflowError, RecursionError):
        numbers = {}
    if not numbers or not all(map(math.isfinite, numbers.values())):
        raise ValueError(f"{path} does not contain the numbers of the tree")
    return numbers
