"""The executable semantics of the monitor machine, and of reactions."""

from rossmarie.interpreter.filter import Filter, Force
from rossmarie.interpreter.machine import Interpreter
from rossmarie.interpreter.reactor import Reactor
from rossmarie.ir import State

__all__ = ["Filter", "Force", "Interpreter", "Reactor", "State"]
