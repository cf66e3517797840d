"""Values at many places of a byte string, all at once."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray


def values_at(content: bytes, kind: str | np.dtype[Any], places: NDArray[np.int64]) -> NDArray[Any]:
    """The values at the places, each inside the content. `kind` is a NumPy type."""
    if not len(places):
        return np.empty(0, kind)
    size = np.dtype(kind).itemsize
    # A value begins at every byte; NumPy copies only the requested values.
    everywhere: NDArray[Any] = np.ndarray(
        (len(content) - size + 1,), kind, buffer=content, strides=(1,)
    )
    return everywhere[places]
