"""Monitors in C, built with the system's compiler and run in this process."""

from rossmarie.native.build import BuildError, NoCompilerError, build
from rossmarie.native.monitor import NativeMonitor, RunResult, load_native

__all__ = ["BuildError", "NativeMonitor", "NoCompilerError", "RunResult", "build", "load_native"]
