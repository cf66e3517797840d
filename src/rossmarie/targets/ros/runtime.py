"""The part of the node that is the same for all rules: copied files, and their hashes."""

from __future__ import annotations

from rossmarie.targets import copies

FOLDER = "runtime"
"""The folder of the copies in a package."""

_ROOT = copies.ROOT / "ros"


def files(generation: str) -> dict[str, str]:
    """The files that the package for a generation (`ros1` or `ros2`) has, by their paths in the
    package.
    """
    paths = [*_ROOT.glob("*"), *(_ROOT / generation).rglob("*")]
    found = {path.relative_to(_ROOT).as_posix(): path for path in paths if path.is_file()}
    return {f"{FOLDER}/{name}": text for name, text in copies.texts_of(found).items()}
