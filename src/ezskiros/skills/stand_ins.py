"""Stand-ins for modules that are not installed, or that talk to a robot. A stand-in has every name,
and its functions do nothing.

The mock generator of Early Dynamic Checking (thesis, Paper IV, section 4.2), for modules.
"""

from __future__ import annotations

import importlib.abc
import importlib.machinery
import sys
from abc import ABCMeta
from collections.abc import Callable, Iterator, MutableSequence, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from types import ModuleType
from typing import Any, ClassVar, cast

from dslkit.source import Span
from ezskiros import session
from ezskiros.skills.mocks import Mock
from ezskiros.skills.values import Symbol

CLIENTS = frozenset(
    (
        "actionlib",
        "moveit",
        "moveit_commander",
        "rclpy",
        "ros2_numpy",
        "roscpp",
        "rospy",
        "tf",
        "tf2_py",
        "tf2_ros",
    )
)
"""The modules through which Python talks to ROS. Much of their code is compiled, and raises no
audit events.
"""


class StandInClass(ABCMeta):
    """The type of stand-ins: classes, so that others can inherit them."""

    def __getattr__(cls, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return _class(f"{cls.__name__}.{name}")

    def __call__(cls, *_arguments: object, **_named: object) -> Any:
        """An instance. A decorated function stays unchanged."""
        return object.__new__(cast("type[object]", cls))

    def __repr__(cls) -> str:
        return f"<stand-in for {cls.__name__}>"

    def _operated(cls, *_others: object) -> Mock:
        return Mock(cls.__name__)

    def __iter__(cls) -> Iterator[Symbol]:
        return Mock(cls.__name__).__parts__(sys._getframe(1))  # noqa: SLF001

    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = _operated
    __truediv__ = __rtruediv__ = __neg__ = __getitem__ = _operated
    __lt__ = __le__ = __gt__ = __ge__ = _operated


class _Anything(Symbol, metaclass=StandInClass):
    """An instance of a missing class."""

    def __derived__(self) -> Mock:
        """The mock of a dependent value."""
        return Mock(type(self).__name__)

    def described(self) -> str:
        """The description, for messages."""
        return self.__derived__().described()

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return _class(f"{type(self).__name__}.{name}")

    def __call__(self, *arguments: object, **_named: object) -> Any:
        """Return the decorated object, if used as a decorator."""
        return arguments[0] if len(arguments) == 1 and callable(arguments[0]) else self


def _class(name: str) -> Any:
    return StandInClass(name, (_Anything,), {})


class _Module(ModuleType):
    """A module with every name."""

    __path__: ClassVar[MutableSequence[str]] = []  # type: ignore[misc]

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        found = _class(f"{self.__name__}.{name}")
        setattr(self, name, found)
        return found


class _Finder(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Finds modules that no other finder finds."""

    def __init__(self, tell: Callable[[str, Span], object]) -> None:
        self._tell = tell
        self.made: list[str] = []

    def find_spec(
        self, name: str, path: Sequence[str] | None = None, _target: ModuleType | None = None
    ) -> importlib.machinery.ModuleSpec | None:
        """A stand-in for a top-level module that users' code imports, or for a name in a stand-in.
        Libraries can handle missing modules themselves.
        """
        parent = sys.modules.get(name.rpartition(".")[0]) if "." in name else None
        if path is not None and not isinstance(parent, _Module):
            return None
        if path is None:
            place = session.directly_here()
            if not session.is_of_user(str(Path.cwd() / place.file.path)):
                return None
            self._tell(name, place)
        return importlib.machinery.ModuleSpec(name, self, is_package=True)

    def create_module(self, spec: importlib.machinery.ModuleSpec) -> ModuleType:
        """The stand-in."""
        self.made.append(spec.name)
        return _Module(spec.name)

    def exec_module(self, module: ModuleType) -> None:
        """Do nothing."""


class _ClientFinder(_Finder):
    """Finds ROS clients before all other finders, so that the installed clients are not loaded."""

    def find_spec(
        self, name: str, _path: Sequence[str] | None = None, _target: ModuleType | None = None
    ) -> importlib.machinery.ModuleSpec | None:
        """A stand-in for an installed ROS client, for any importing module."""
        if name not in CLIENTS or not is_installed(name):
            return None
        self._tell(name, session.here())
        return importlib.machinery.ModuleSpec(name, self, is_package=True)


def is_installed(module: str) -> bool:
    """Say whether a top-level module of this name is installed."""
    return importlib.machinery.PathFinder.find_spec(module) is not None


_is_real: ContextVar[bool] = ContextVar("is_real", default=False)


@contextmanager
def without_stand_ins() -> Iterator[None]:
    """While the context is active, missing modules have no stand-ins, also during the expansion of
    trees.
    """
    token = _is_real.set(True)
    try:
        yield
    finally:
        _is_real.reset(token)


@contextmanager
def standing_in(tell: Callable[[str, Span], object]) -> Iterator[None]:
    """While the context is active, missing modules have stand-ins. `tell` is called with the names
    of packages and the places of their imports.

    Afterwards the stand-ins are removed, so that they are reported for each module that needs them.
    """
    if _is_real.get():
        yield
        return
    first, last = _ClientFinder(tell), _Finder(tell)
    sys.meta_path.insert(0, first)
    sys.meta_path.append(last)
    try:
        yield
    finally:
        sys.meta_path.remove(first)
        sys.meta_path.remove(last)
        for name in [*first.made, *last.made]:
            sys.modules.pop(name, None)
