"""The policy that a step learner has learned, for use without it: a network in NumPy."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

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
    tanh between two layers. The outputs are an action scaled to [-1, 1], whose least and greatest
    values are `bounds`, and come out of a tanh if `is_squashed`; or the values of moves, where
    there are no bounds.
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
    try:
        with path.open("rb") as file, np.load(file, allow_pickle=False) as found:
            count = sum(name.startswith("weights") for name in found.files)
            layers = [(found[f"weights{i}"], found[f"bias{i}"]) for i in range(count)]
            least, greatest = found["bounds"].tolist()
            policy = Policy(layers, (least, greatest), bool(found["is_squashed"]))
            policy(np.zeros(len(FIELDS)))
    except (
        KeyError,
        IndexError,
        TypeError,
        AttributeError,
        ValueError,
        EOFError,
        zipfile.BadZipFile,
    ):
        raise ValueError(f"{path} is no policy of this task") from None
    return policy
