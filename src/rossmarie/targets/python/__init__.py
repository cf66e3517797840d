"""The Python target: a machine as one module that needs only Python's standard library."""

from __future__ import annotations

from collections.abc import Mapping

from rossmarie import ir
from rossmarie.targets.base import Target
from rossmarie.targets.python.module import source
from rossmarie.targets.python.names import file_name


def generate(machine: ir.Machine) -> Mapping[str, str]:
    """The file of a monitor, by name: NAME_monitor.py."""
    return {file_name(machine.name): source(machine)}


# Python can express every machine that `ir.verify` accepts.
TARGET = Target("python", lambda _: (), lambda machine, _: generate(machine))

__all__ = ["TARGET", "generate", "source"]
