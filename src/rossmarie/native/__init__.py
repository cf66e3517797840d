"""Monitors and guards in C, built with the system's compiler and run in this process."""

from rossmarie.native.build import BuildError, NoCompilerError, build
from rossmarie.native.columns import FLAG_VALUES, ColumnError, Columns, fit
from rossmarie.native.guard import NativeGuard, load_native_guard
from rossmarie.native.monitor import BoundColumns, NativeMonitor, load_native
from rossmarie.native.result import RunResult

__all__ = [
    "FLAG_VALUES",
    "BoundColumns",
    "BuildError",
    "ColumnError",
    "Columns",
    "NativeGuard",
    "NativeMonitor",
    "NoCompilerError",
    "RunResult",
    "build",
    "fit",
    "load_native",
    "load_native_guard",
]
