"""Files that are the same for all rules. They are copied beside generated files, with their hashes,
so that a reviewer reads them only once.
"""

from __future__ import annotations

from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path

ROOT = Path(__file__).parents[1] / "runtime"
"""The folder of these files."""

MARK = "Part of ROSSMARie, the same for all rules"
"""The text in the first line of each copy."""

SUMS = "SHA256SUMS"
"""The file among the copies that lists the hashes of all other copies, for `sha256sum -c`."""


def texts_of(files: Mapping[str, Path]) -> dict[str, str]:
    """The texts of these files, by their names among the copies, and the file with their hashes."""
    return with_sums({name: path.read_bytes() for name, path in files.items()})


def with_sums(files: Mapping[str, bytes]) -> dict[str, str]:
    """The same files and their hashes, for files given by their contents."""
    contents = {name: files[name] for name in sorted(files)}
    rows = (f"{sha256(content).hexdigest()}  {name}\n" for name, content in contents.items())
    sums = "".join([f"# {MARK}. Check it here: sha256sum -c {SUMS}\n", *rows])
    return {**{name: content.decode() for name, content in contents.items()}, SUMS: sums}
