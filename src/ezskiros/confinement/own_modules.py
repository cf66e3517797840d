"""A test that user code has not modified the modules of the checker."""

from __future__ import annotations

import builtins
import operator
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import FunctionType, ModuleType

from ezskiros.session import OURS


@dataclass(frozen=True)
class _Names:
    """The names in a module or class, and their values at the start."""

    owner: str
    now: Mapping[str, object]
    before: Mapping[str, object]
    is_class: bool

    def changed(self) -> str | None:
        """A name with another value, or a new name that hides a builtin one."""
        now, before = self.now, self.before
        if len(now) == len(before) and all(map(operator.is_, now.values(), before.values())):
            return None
        lost = [name for name in before if name not in now or now[name] is not before[name]]
        added = [name for name in now if name not in before and self._is_odd(name)]
        return next(iter(lost + added), None)

    def _is_odd(self, name: str) -> bool:
        if self.is_class:
            return not name.startswith("__")
        return self.owner != builtins.__name__ and hasattr(builtins, name)


class Seal:
    """A record of the checker's modules, classes and functions."""

    def __init__(self) -> None:
        self._modules = dict(_modules())
        self._names: list[_Names] = []
        self._functions: list[tuple[str, FunctionType, tuple[object, ...]]] = []
        for name, module in self._modules.items():
            self._remember(name, vars(module), is_class=False)
        self._remember(builtins.__name__, vars(builtins), is_class=False)

    def _remember(self, owner: str, names: Mapping[str, object], *, is_class: bool) -> None:
        self._names.append(_Names(owner, names, dict(names), is_class))
        for name, each in names.items():
            if isinstance(each, type) and not is_class and each.__module__ == owner:
                self._remember(f"{owner}.{name}", vars(each), is_class=True)
            for function in _functions(each):
                self._functions.append((f"{owner}.{name}", function, _meaning(function)))

    def broken(self) -> tuple[str, object] | None:
        """A part that has changed, with its current value; None if no part has changed."""
        for name, module in self._modules.items():
            if sys.modules.get(name) is not module:
                return name, sys.modules.get(name)
        for names in self._names:
            changed = names.changed()
            if changed is not None:
                return f"{names.owner}.{changed}", names.now.get(changed)
        for name, function, meaning in self._functions:
            if not all(map(operator.is_, _meaning(function), meaning)):
                return name, function
        return None


def _modules() -> Iterator[tuple[str, ModuleType]]:
    for name, module in list(sys.modules.items()):
        if (getattr(module, "__file__", None) or "").startswith(OURS):
            yield name, module


def _functions(part: object) -> Iterator[FunctionType]:
    """The functions behind an attribute of a class or of a module."""
    if isinstance(part, FunctionType):
        yield part
    elif isinstance(part, (classmethod, staticmethod)):
        yield from _functions(part.__func__)
    elif isinstance(part, property):
        yield from _functions(part.fget)


def _meaning(function: FunctionType) -> tuple[object, ...]:
    return function.__code__, function.__defaults__, function.__kwdefaults__
