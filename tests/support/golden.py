"""Files that hold what a program printed when somebody last looked at it."""

from __future__ import annotations

from pathlib import Path


def assert_golden(path: Path, actual: str, *, bless: bool) -> None:
    """Compare `actual` with the file at `path`; write it instead when blessing.

    A missing file fails: nobody has looked at it yet.
    """
    if bless:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(actual, encoding="utf-8", newline="")
        return
    assert path.is_file(), f"{path} is missing: run pytest with --bless, and look at it"
    assert actual == path.read_bytes().decode("utf-8")
