"""The part of monitors and reactors that is the same for all rules: copied C files, and the
functions of numbers and of samples, which are generated from the core.

Generated files name the version of the engine that they need. A compiler therefore rejects them
with another version, which a later build may have copied.
"""

from __future__ import annotations

from functools import cache
from hashlib import sha256

from rossmarie.targets import copies
from rossmarie.targets.c99 import functions
from rossmarie.targets.formulas import fixed_definitions

FOLDER = "engine"
"""The folder of the copies, beside the generated files."""

_ROOT = copies.ROOT / "c" / FOLDER


@cache
def _copies() -> dict[str, str]:
    found = {path.name: path.read_bytes() for path in _ROOT.glob("*.h")}
    return copies.with_sums({**found, "functions.h": _functions().encode()})


def _functions() -> str:
    """The file of functions that need no table of the rules."""
    head = (
        f"/* {copies.MARK}. */\n\n"
        "/* Functions of numbers and of samples, generated from the formulas of rossmarie.core.\n"
        " * The rules S4 to S6, S19, S20, S43, S49 and S50 of the semantics define the formulas.\n"
        " */\n"
    )
    return "\n".join([head, *map(functions.function, fixed_definitions())])


def version() -> str:
    """A number in C that identifies the version: the beginning of a hash of the engine's files."""
    return f"0x{sha256(_copies()[copies.SUMS].encode()).hexdigest()[:8]}"


def files() -> dict[str, str]:
    """All files of the engine, by their paths beside the generated ones."""
    reported = (
        f"/* {copies.MARK}. The version is the beginning of the hash of {copies.SUMS}. */\n"
        f"#define ROSSMARIE_ENGINE {version()}\n"
    )
    return {f"{FOLDER}/{name}": text for name, text in {**_copies(), "version.h": reported}.items()}
