"""Conversion of parameter keys, which are any strings, to Python names."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Collection, Iterable, Mapping
from itertools import chain, count

from ezskiros.migrate.names import is_name

ROBOT = "Robot"
"""The parameter that each SkiROS2 skill has, declared or not."""
_RESERVED = {"self", "ezskiros"}


def parameter_names(keys: Iterable[str]) -> dict[str, str]:
    """The parameter name of each key: the key itself, if it is a valid Python name."""
    keys = list(dict.fromkeys(keys))
    found = {key: key for key in keys if _is_parameter_name(key)}
    for key in keys:
        if key not in found:
            found[key] = _free(_made_of(key), {*found.values(), ROBOT})
    return found


def more_names(called: Mapping[str, str], keys: Iterable[str]) -> dict[str, str]:
    """The names of additional parameters by key. Existing parameters keep their names."""
    found: dict[str, str] = {}
    for key in keys:
        name = key if _is_parameter_name(key) else _made_of(key)
        found[key] = _free(name, {*called.values(), *found.values(), ROBOT})
    return found


def _is_parameter_name(key: str) -> bool:
    """Say whether a key is a valid parameter name. Python changes names that begin with `__`."""
    return is_name(key) and not key.startswith("__") and key not in _RESERVED


def _made_of(key: str) -> str:
    """A name for an invalid key, such as `StartPose` for `Start Pose`."""
    words = re.findall(r"[^\W_]+", unicodedata.normalize("NFKC", key))
    name = "".join(word[:1].upper() + word[1:] for word in words)
    return name if is_name(name) else f"Parameter{name}"


def _free(name: str, taken: Collection[str]) -> str:
    """The name, with a number appended if it is taken."""
    numbered = (f"{name}_{number}" for number in count(2))
    return next(each for each in chain([name], numbered) if each not in taken)
