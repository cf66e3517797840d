"""Access to fields of messages by generated functions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from heron.messages import Message

Read = Callable[[Message], Sequence[Any]]
"""Some fields of a message."""


def attributes_of(paths: Sequence[tuple[str, ...]]) -> Read:
    """A function that gives the attributes at these paths. It is written and compiled, and looks up
    each part of a message once: in a run that is several times as fast as `attrgetter`.
    """
    assert all(name.isidentifier() for path in paths for name in path), "fields of messages"
    parts: dict[tuple[str, ...], str] = {(): "message"}
    lines = ["def read(message):"]
    for path in paths:
        for end in range(1, len(path)):
            if path[:end] not in parts:
                lines.append(f"    part_{len(parts)} = {parts[path[: end - 1]]}.{path[end - 1]}")
                parts[path[:end]] = f"part_{len(parts)}"
    found = "".join(f"{parts[path[:-1]]}.{path[-1]}, " for path in paths)
    lines.append(f"    return ({found})")
    made: dict[str, Any] = {}
    exec("\n".join(lines), made)
    read: Read = made["read"]
    return read
