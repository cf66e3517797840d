"""The C99 target: a machine as one header and one source that need no library but math.h."""

from rossmarie.targets.c99.monitor import generate, generate_loadable

__all__ = ["generate", "generate_loadable"]
