"""The policies and trees that trainings have learned, to be used without them."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from heron.learning.policy import POLICY, load_policy
from heron.learning.runs import Run
from heron.learning.tree import NUMBERS, RANGES, InsertionTree
from heron.variants import Formulation

Act = Callable[[NDArray[np.float64]], Any]
"""From an observation to an action, in one episode."""


def learned(folder: Path, run: Run) -> Act:
    """The policy of a training, or its tree, from its files in the folder of all trainings. Raises
    `OSError`, and `ValueError` if a file holds something else.
    """
    place = folder / run.folder
    if run.formulation is Formulation.TREE:
        return InsertionTree().policy(_numbers(place / NUMBERS))
    return load_policy(place / POLICY)


def _numbers(path: Path) -> dict[str, float]:
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        return {name: float(found[name]) for name in RANGES}
    except (ValueError, KeyError, TypeError):
        raise ValueError(f"{path} does not hold the numbers of the tree") from None
