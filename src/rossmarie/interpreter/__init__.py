"""The executable semantics of the monitor machine, and of reactions."""

from rossmarie.interpreter.machine import Interpreter
from rossmarie.interpreter.reactor import Reactor
from rossmarie.ir import State

__all__ = ["Interpreter", "Reactor", "State"]
