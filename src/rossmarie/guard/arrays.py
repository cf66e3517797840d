"""Arrays of a policy. Other values are refused before anything changes."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from rossmarie.guard.mapping import MappingError

Array = NDArray[Any]
FLOATS = (np.float64, np.float32)


def require_array(what: str, array: object) -> None:
    """Raise `TypeError` for a value that is not an array, and `MappingError` for an array that is
    not flat or not of floats.
    """
    if not isinstance(array, np.ndarray):
        refuse(what, array)
    elif array.ndim != 1:
        raise MappingError(f"the {what} has the shape {array.shape}, but must be a flat array")
    elif array.dtype not in FLOATS:
        raise MappingError(f"the {what} holds {array.dtype}, not float64 or float32")


def refuse(what: str, array: object) -> Array:
    """Raise `TypeError` for `what`."""
    raise TypeError(f"the {what} is a {type(array).__name__}, not a NumPy array")
