"""The tables of a .db3 file: only stored data, no computed data.

A view, a virtual table or a generated column can produce any number of rows and bytes from a few
words.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from rossmarie.recordings.limits import LimitError

_READ = ("messages", "topics", "message_definitions", "schema")
_STORED = 0
"""The mark that SQLite gives to a column that is neither hidden nor generated."""


def check_tables(execute: Callable[[str], Iterable[Any]]) -> None:
    """Raises `LimitError` for a table that is not only stored rows; `execute` runs queries."""
    names = ", ".join(f"'{name}'" for name in _READ)
    for name, kind, text in execute(
        f"SELECT name, type, sql FROM sqlite_master WHERE name IN ({names})"
    ):
        if kind != "table" or str(text).upper().split()[:2] != ["CREATE", "TABLE"]:
            raise LimitError(f"it has no table `{name}`")
        columns = list(execute(f"PRAGMA table_xinfo({name})"))
        if any(column[-1] != _STORED for column in columns):
            raise LimitError(f"`{name}` has a computed column")
