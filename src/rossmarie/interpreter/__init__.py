"""The executable semantics of the monitor machine."""

from rossmarie.interpreter.machine import Interpreter

__all__ = ["Interpreter"]
