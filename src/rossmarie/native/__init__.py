"""Monitors in C, built with the system's compiler and run in this process."""

from rossmarie.native.build import BuildError, NoCompilerError, build
from rossmarie.native.columns import ColumnError, RunResult
from rossmarie.native.monitor import BoundColumns, NativeMonitor, load_native

__all__ = [
    "BoundColumns",
    "BuildError",
    "ColumnError",
    "NativeMonitor",
    "NoCompilerError",
    "RunResult",
    "build",
    "load_native",
]
