"""The executable semantics of the monitor machine, and of reactions."""

from rossmarie.interpreter.filter import Filter, LimitState
from rossmarie.interpreter.machine import Interpreter
from rossmarie.interpreter.reactor import Reactor
from rossmarie.ir import TaskState

__all__ = ["Filter", "Interpreter", "LimitState", "Reactor", "TaskState"]
