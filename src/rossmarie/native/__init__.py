"""Monitors and guards in C, built with the system's compiler and run in this process."""

from rossmarie.native.build import BuildError, NoCompilerError, build
from rossmarie.native.columns import FLAG_VALUES, ColumnError, MachineColumns, fit
from rossmarie.native.guard import NativeGuard, load_native_guard
from rossmarie.native.monitor import BoundColumns, NativeMonitor, load_native
from rossmarie.native.result import RunResult
from rossmarie.native.steps import (
    CHANGED,
    CLOSED,
    REFUSED,
    REPORTED,
    AllowCall,
    NativeRow,
    StepCall,
    fits,
    packed_note,
    put_back,
)

__all__ = [
    "CHANGED",
    "CLOSED",
    "FLAG_VALUES",
    "REFUSED",
    "REPORTED",
    "AllowCall",
    "BoundColumns",
    "BuildError",
    "ColumnError",
    "MachineColumns",
    "NativeGuard",
    "NativeMonitor",
    "NativeRow",
    "NoCompilerError",
    "RunResult",
    "StepCall",
    "build",
    "fit",
    "fits",
    "load_native",
    "load_native_guard",
    "packed_note",
    "put_back",
]
