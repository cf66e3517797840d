"""A policy that a step learner has learned, for use without the learner: a network in NumPy."""

from __future__ import annotations

import io
import struct
import tokenize
import zipfile
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from heron.learning.environment import LEAST, MOVES
from heron.learning.insertion import FIELDS, LONGEST_S
from heron.scene.insertion import InsertionParameters

Floats = NDArray[np.float64]
_SIZES = {"place": 0.3, "velocity": 0.3, "force": 10.0, "person": 2.0, "left": LONGEST_S}
_SIZE = np.array([_SIZES[field.partition(".")[0]] for field in FIELDS])
POLICY = "policy.npz"
"""The name of a file that holds one."""
INPUTS = len(FIELDS) + 3
_NEAR = 0.02
_MIDDLE = np.append(np.array(InsertionParameters().hole), np.zeros(len(FIELDS) - 3))
_LARGEST_FILE = 2**24  # bytes
_GREATEST = 1e6  # of the numbers of a network: its results stay finite

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


def scaled(observations: Floats) -> Floats:
    """Observations as learners get them, `INPUTS` numbers each: places from the hole on, everything
    about 1, and places near the hole once more, spread wide.
    """
    found = (observations - _MIDDLE) / _SIZE
    near = np.tanh((observations[..., :3] - _MIDDLE[:3]) / _NEAR)
    return np.concatenate([found, near], axis=-1)


@dataclass(frozen=True)
class Policy:
    """The best actions for observations of the insertion. `layers` are weights and biases, with
    tanh between two layers. The outputs are an action scaled to [-1, 1], with the bounds `bounds`,
    after a tanh if `is_squashed`. Without bounds, the outputs are the values of moves.
    """

    layers: Sequence[tuple[Floats, Floats]]
    bounds: tuple[Sequence[float], Sequence[float]] = ((), ())
    is_squashed: bool = False

    def __call__(self, observation: Floats) -> Any:
        """The action for an observation (`FIELDS` of `heron.learning.insertion`): velocities (m/s)
        and the push (N), or the number of a move.
        """
        values = scaled(observation)
        *hidden, last = self.layers
        for weights, bias in hidden:
            values = np.tanh(values @ weights + bias)
        values = values @ last[0] + last[1]
        least, greatest = map(np.asarray, self.bounds)
        if not least.size:
            return int(np.argmax(values))
        part = np.tanh(values) if self.is_squashed else np.clip(values, -1.0, 1.0)
        return (least + (part + 1.0) / 2.0 * (greatest - least)).astype(np.float32)

    def file(self) -> bytes:
        """The content of a file that `load_policy` reads."""
        arrays = {"bounds": np.array(self.bounds), "is_squashed": np.array(self.is_squashed)}
        for number, (weights, bias) in enumerate(self.layers):
            arrays |= {f"weights{number}": weights, f"bias{number}": bias}
        found = io.BytesIO()
        np.savez(found, **arrays)  # type: ignore[arg-type]
        return found.getvalue()


def load_policy(path: Path) -> Policy:
    """Read a policy from a file. Raises `OSError`, and `ValueError` if it is none."""
    require_small(path)
    try:
        found = _arrays(path)
        if _are_of_a_policy(found):
            count = (len(found) - 2) // 2
            layers = [
                (found[f"weights{number}"], found[f"bias{number}"]) for number in range(count)
            ]
            least, greatest = found["bounds"].tolist()
            return Policy(layers, (least, greatest), bool(found["is_squashed"]))
    except _OF_DAMAGE:
        pass
    raise ValueError(f"{path} is not a policy of this task")


def require_small(path: Path) -> None:
    """Raise `ValueError` if a path is not a file, or one that is too large to be of a training, and
    `OSError` if there is none.
    """
    if path.stat() and not path.is_file():
        raise ValueError(f"{path} is not a file")
    if path.stat().st_size > _LARGEST_FILE:
        raise ValueError(f"{path} is larger than {_LARGEST_FILE // 2**20} MiB")


def _arrays(path: Path) -> Mapping[str, Floats]:
    """The arrays of a file, which may say before that it is no small one."""
    with path.open("rb") as file:
        with zipfile.ZipFile(file) as parts:
            if sum(part.file_size for part in parts.infolist()) > _LARGEST_FILE:
                return {}
        file.seek(0)
        with np.load(file, allow_pickle=False) as found:
            return {name: found[name] for name in found.files}


def _are_of_a_policy(arrays: Mapping[str, Floats]) -> bool:
    """Return True if the arrays belong to a network with finite outputs, as many as an environment
    needs.
    """
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
