"""The part of the node that is the same for all rules: files that are copied, and their hashes."""

from __future__ import annotations

from hashlib import sha256
from pathlib import Path

FOLDER = "runtime"
"""Where a package has the copies."""

MARK = "Part of ROSSMARie, the same in each package"
"""The text in the first line of each copy."""

_SUMS = "SHA256SUMS"
_ROOT = Path(__file__).parents[2] / "runtime" / "ros"


def copies(generation: str) -> dict[str, str]:
    """The files that a package for a generation has, `ros1` or `ros2`, by their paths in it. One of
    them lists the hashes of all others, for `sha256sum -c`.
    """
    paths = [*_ROOT.glob("*"), *(_ROOT / generation).rglob("*")]
    found = {
        path.relative_to(_ROOT).as_posix(): path.read_bytes() for path in paths if path.is_file()
    }
    rows = (f"{sha256(found[name]).hexdigest()}  {name}\n" for name in sorted(found))
    sums = "".join([f"# {MARK}. Check it here: sha256sum -c {_SUMS}\n", *rows])
    texts = {name: content.decode() for name, content in found.items()}
    return {f"{FOLDER}/{name}": text for name, text in {**texts, _SUMS: sums}.items()}
