"""The results of trainings, to be used without them."""

from __future__ import annotations

import json
import math
import struct
import tokenize
import zipfile
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from heron.learning.environment import LEAST, MOVES
from heron.learning.policy import INPUTS, POLICY, Policy, load_policy
from heron.learning.runs import Run
from heron.learning.tree import NUMBERS, RANGES, InsertionTree
from heron.variants import Formulation

Act = Callable[[NDArray[np.float64]], Any]
"""From an observation to an action, in one episode."""
_LARGEST_FILE = 2**24  # bytes
_GREATEST = 1e6  # of the numbers of a network: what it computes stays finite

_OF_DAMAGE = (
    ArithmeticError,
    AttributeError,
    EOFError,
    LookupError,
    MemoryError,
    RuntimeError,
    SyntaxError,
    TypeError,
    ValueError,
    struct.error,
    tokenize.TokenError,
    zipfile.BadZipFile,
    zlib.error,
)
"""The errors that NumPy and zipfile raise for damaged files."""
_OUTPUTS = {(2, LEAST.size): LEAST.size, (2, 0): len(MOVES)}
"""The number of outputs of a network, by the shape of its bounds."""


@dataclass(frozen=True)
class Learned:
    """A learned policy or tree, and its formulation. `begin` gives the policy of one episode."""

    formulation: Formulation
    begin: Callable[[], Act]


def learned(folder: Path, run: Run) -> Act:
    """The policy of a training, or its tree, from its files in the folder of all trainings. Raises
    `OSError`, and `ValueError` if a file holds something else.
    """
    name = NUMBERS if run.formulation is Formulation.TREE else POLICY
    return read_learned(folder / run.folder / name).begin()


def read_learned(path: Path) -> Learned:
    """Read the file of what was learned: the numbers of a tree if its name ends in .json, else a
    policy. Raises `OSError`, and `ValueError` if the file holds something else.
    """
    if path.stat() and not path.is_file():
        raise ValueError(f"{path} is no file")
    if path.stat().st_size > _LARGEST_FILE:
        raise ValueError(f"{path} is larger than {_LARGEST_FILE // 2**20} MiB")
    if path.suffix == ".json":
        tree, numbers = InsertionTree(), _numbers(path)
        return Learned(Formulation.TREE, lambda: tree.policy(numbers))
    policy = _policy(path)
    formulation = Formulation.STEPS if policy.bounds[0] else Formulation.MOVES
    return Learned(formulation, lambda: policy)


def _numbers(path: Path) -> dict[str, float]:
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        numbers = {name: float(found[name]) for name in RANGES}
    except (ValueError, KeyError, TypeError, OverflowError, RecursionError):
        numbers = {}
    if not numbers or not all(map(math.isfinite, numbers.values())):
        raise ValueError(f"{path} does not hold the numbers of the tree")
    return numbers


def _policy(path: Path) -> Policy:
    try:
        if _holds_policy(path):
            return load_policy(path)
    except _OF_DAMAGE:
        pass
    raise ValueError(f"{path} is no policy of this task")


def _holds_policy(path: Path) -> bool:
    """Say whether the arrays of a file are those of a network whose outputs are finite, and as many
    as an environment needs.
    """
    with zipfile.ZipFile(path) as parts:
        if sum(part.file_size for part in parts.infolist()) > _LARGEST_FILE:
            return False
    with np.load(path, allow_pickle=False) as found:
        arrays = {name: found[name] for name in found.files}
    shapes = {name: array.shape for name, array in arrays.items()}
    bounds = shapes["bounds"]
    before, expected = INPUTS, {"bounds": bounds, "is_squashed": ()}
    for number in range((len(arrays) - 2) // 2):
        after = arrays[f"bias{number}"].size
        expected |= {f"weights{number}": (before, after), f"bias{number}": (after,)}
        before = after
    are_numbers = all(each.dtype.kind in "bif" for each in arrays.values())
    is_small = are_numbers and all((abs(each) <= _GREATEST).all() for each in arrays.values())
    return is_small and shapes == expected and _OUTPUTS.get(bounds) == before
