"""Stand-ins for modules that are not installed: whatever is asked of them is there and idle.

The mock generator of Early Dynamic Checking (thesis, Paper IV, section 4.2), for modules.
"""

from __future__ import annotations

import importlib.abc
import importlib.machinery
import sys
from collections.abc import Callable, Iterator, MutableSequence, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any, ClassVar, cast

from dslkit.source import Span
from ezskiros import session


class StandInClass(type):
    """The type of stand-ins: classes, so that others can inherit them."""

    def __getattr__(cls, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return _class(f"{cls.__name__}.{name}")

    def __call__(cls, *_arguments: object, **_named: object) -> Any:
        """An instance; a decorated function stays what it is."""
        return object.__new__(cast("type[object]", cls))

    def __repr__(cls) -> str:
        return f"<stand-in for {cls.__name__}>"


class _Anything(metaclass=StandInClass):
    """An instance of a class that is not there."""

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return _class(f"{type(self).__name__}.{name}")

    def __call__(self, *arguments: object, **_named: object) -> Any:
        """As a decorator it leaves what it decorates."""
        return arguments[0] if len(arguments) == 1 and callable(arguments[0]) else self

    def __iter__(self) -> Iterator[Any]:
        return iter(())


def _class(name: str) -> Any:
    return StandInClass(name, (_Anything,), {})


class _Module(ModuleType):
    """A module in which everything is there."""

    __path__: ClassVar[MutableSequence[str]] = []  # type: ignore[misc]

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        found = _class(f"{self.__name__}.{name}")
        setattr(self, name, found)
        return found


class _Finder(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Finds what nobody else does."""

    def __init__(self, tell: Callable[[str, Span], object]) -> None:
        self._tell = tell

    def find_spec(
        self, name: str, path: Sequence[str] | None = None, _target: ModuleType | None = None
    ) -> importlib.machinery.ModuleSpec | None:
        """A stand-in for a top-level module that code of users imports, or for what is in a
        stand-in; libraries know themselves what to do without a module.
        """
        parent = sys.modules.get(name.rpartition(".")[0]) if "." in name else None
        if path is not None and not isinstance(parent, _Module):
            return None
        if path is None:
            place = session.directly_here()
            if str(Path.cwd() / place.file.path).startswith(session.LIBRARIES):
                return None
            self._tell(name, place)
        return importlib.machinery.ModuleSpec(name, self, is_package=True)

    def create_module(self, spec: importlib.machinery.ModuleSpec) -> ModuleType:
        """The stand-in."""
        return _Module(spec.name)

    def exec_module(self, module: ModuleType) -> None:
        """Does nothing."""


@contextmanager
def standing_in(tell: Callable[[str, Span], object]) -> Iterator[None]:
    """Within, modules that are not there are stood in for; `tell` hears the names of packages, and
    where they are imported.

    Afterwards they are gone again, so that each module that needs one is told of.
    """
    finder = _Finder(tell)
    sys.meta_path.append(finder)
    try:
        yield
    finally:
        sys.meta_path.remove(finder)
        for name in [name for name, module in sys.modules.items() if isinstance(module, _Module)]:
            del sys.modules[name]
