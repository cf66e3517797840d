"""The part of monitors and reactors that is the same for all rules: C files that are copied.

Generated files name the version of the engine that they need, so that none is compiled with another
one that a later build put in its place.
"""

from __future__ import annotations

from functools import cache
from hashlib import sha256

from rossmarie.targets import copies

FOLDER = "engine"
"""The folder of the copies, beside the generated files."""

_ROOT = copies.ROOT / "c" / FOLDER


@cache
def _copies() -> dict[str, str]:
    return copies.texts_of({path.name: path for path in _ROOT.glob("*.h")})


def version() -> str:
    """A number in C that differs from one version to another: the beginning of a hash."""
    return f"0x{sha256(_copies()[copies.SUMS].encode()).hexdigest()[:8]}"


def files() -> dict[str, str]:
    """All files of the engine, by their paths beside the generated ones."""
    told = (
        f"/* {copies.MARK}: the version of the engine, from the hash of {copies.SUMS}. */\n"
        f"#define ROSSMARIE_ENGINE {version()}\n"
    )
    return {f"{FOLDER}/{name}": text for name, text in {**_copies(), "version.h": told}.items()}
