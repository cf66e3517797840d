"""The engines that run a machine in this process: a monitor, or a monitor with a reactor."""

from rossmarie.engines.python_guard import PythonGuard
from rossmarie.engines.python_monitor import PythonMonitor
from rossmarie.engines.start import (
    NATIVE,
    PYTHON,
    GuardEngine,
    GuardRow,
    MonitorEngine,
    Started,
    start_guard,
    start_monitor,
)
from rossmarie.engines.values import NamedValues, Value

__all__ = [
    "NATIVE",
    "PYTHON",
    "GuardEngine",
    "GuardRow",
    "MonitorEngine",
    "NamedValues",
    "PythonGuard",
    "PythonMonitor",
    "Started",
    "Value",
    "start_guard",
    "start_monitor",
]
