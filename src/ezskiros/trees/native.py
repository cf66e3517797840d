"""Implementations for plain SkiROS2 of skills that are described in EzSkiROS. A migration can leave
them unchanged.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from types import FunctionType, ModuleType

from ezskiros.skills.calls import SkillClass


def native_implementations(description: SkillClass) -> dict[str, type]:
    """The classes whose `createDescription` sets an EzSkiROS description, by class name."""
    return {each.__name__: each for each in _classes() if _sets(each, description)}


def _classes() -> Iterator[type]:
    """The classes with a method `createDescription` in all imported modules. No other object is
    examined, because objects of modules can be anything.
    """
    for name, module in list(sys.modules.items()):
        for each in list(vars(module).values()) if isinstance(module, ModuleType) else ():
            is_own = issubclass(type(each), type) and vars(each).get("__module__") == name
            if is_own and type(vars(each).get("createDescription")) is FunctionType:
                yield each


def _sets(found: type, description: SkillClass) -> bool:
    """Say whether the code of a class uses `setDescription` and the description."""
    method = vars(found)["createDescription"]
    names = method.__code__.co_names
    is_one = any(method.__globals__.get(name) is description for name in names)
    return is_one and "setDescription" in names
