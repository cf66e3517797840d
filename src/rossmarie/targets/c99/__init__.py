"""The C99 target: a machine as one header and one source that need only the library math.h."""

from rossmarie.targets.base import Target
from rossmarie.targets.c99.engine import version
from rossmarie.targets.c99.monitor import generate, generate_guard, generate_loadable
from rossmarie.targets.c99.unsupported import unsupported

TARGET = Target("c99", unsupported, lambda machine, _: generate(machine))

__all__ = ["TARGET", "generate", "generate_guard", "generate_loadable", "unsupported", "version"]
