"""An engine for a machine: native if there is a C compiler, else in Python."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

from rossmarie.engines.python_guard import PythonGuard
from rossmarie.engines.python_monitor import PythonMonitor
from rossmarie.engines.python_row import PythonRow
from rossmarie.ir import Machine
from rossmarie.native import (
    BuildError,
    NativeGuard,
    NativeMonitor,
    NativeRow,
    NoCompilerError,
    load_native,
    load_native_guard,
)
from rossmarie.targets import c99, python

NATIVE = "native"
PYTHON = "python"

_Native = TypeVar("_Native")
_Python = TypeVar("_Python")
_Engine = TypeVar("_Engine", covariant=True)

MonitorEngine = NativeMonitor | PythonMonitor
GuardEngine = NativeGuard | PythonGuard
GuardRow = NativeRow | PythonRow


@dataclass(frozen=True)
class Started(Generic[_Engine]):
    """An engine in its initial state, its kind (`NATIVE` or `PYTHON`), and the reason if it is not
    native.
    """

    engine: _Engine
    kind: str
    reason: str | None


def start_monitor(machine: Machine) -> Started[MonitorEngine]:
    """A monitor. Its verdicts do not depend on its kind."""
    return _started(
        machine,
        "the monitor",
        lambda: load_native(machine, c99.generate_loadable(machine)),
        lambda: PythonMonitor(machine, python.source(machine)),
    )


def start_guard(machine: Machine) -> Started[GuardEngine]:
    """A monitor with the reactor of its rules. Its decisions do not depend on its kind."""
    return _started(
        machine,
        "the guard",
        lambda: load_native_guard(machine, c99.generate_guard(machine)),
        lambda: PythonGuard(machine, python.source(machine)),
    )


def _started(
    machine: Machine, what: str, native: Callable[[], _Native], in_python: Callable[[], _Python]
) -> Started[_Native | _Python]:
    refused = next(iter(c99.unsupported(machine)), None)
    if refused is None:
        try:
            return Started(native(), NATIVE, None)
        except (NoCompilerError, BuildError, OSError) as error:
            why = str(error).partition("\n")[0]
    else:
        why = refused.title
    return Started(in_python(), PYTHON, f"{what} runs in Python, which is slower: {why}")
