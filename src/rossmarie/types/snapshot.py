"""Copies the message definitions of ROS from the rosbags package into `messages.msg`, together with
our own definitions from `skill_context.msg`.

Importing the type stores of rosbags takes most of the time that a whole check may take. Therefore
they are read when this package is built, not when it is used (docs/decisions/0003). To renew the
copy, run `python -m rossmarie.types.snapshot`. A test asserts that it is up to date.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeVar

from rossmarie.types.definitions import (
    SEPARATOR,
    STORED,
    Constant,
    MessageDefinition,
    from_rosbags,
    own_texts,
)

T = TypeVar("T")


def render() -> str:
    """All definitions as concatenated .msg text, sorted by name.

    ROS 2 Jazzy takes precedence. Messages, fields (`Header.seq`) and constants that only ROS 1
    Noetic has are added.
    """
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    merged: dict[str, MessageDefinition] = {}
    for name, text in own_texts().items():
        merged |= from_rosbags(get_types_from_msg(text, name))
    for store in (Stores.ROS2_JAZZY, Stores.ROS1_NOETIC):
        for name, definition in from_rosbags(get_typestore(store).fielddefs).items():
            merged[name] = _merge(merged.get(name, MessageDefinition({}, {})), definition)
    return "".join(SEPARATOR + _message(name, merged[name]) for name in sorted(merged))


def _merge(first: MessageDefinition, second: MessageDefinition) -> MessageDefinition:
    return MessageDefinition(
        _joined(first.fields, second.fields), _joined(first.constants, second.constants)
    )


def _joined(first: Mapping[str, T], second: Mapping[str, T]) -> dict[str, T]:
    return {**first, **{name: each for name, each in second.items() if name not in first}}


def _message(name: str, definition: MessageDefinition) -> str:
    fields = (f"{field} {field_name}\n" for field_name, field in definition.fields.items())
    constants = map(_constant, definition.constants.items())
    return "".join((f"{name}\n", *constants, *fields))


def _constant(named: tuple[str, Constant]) -> str:
    """A constant with the type that is needed to read it again."""
    name, value = named
    return f"string {name}={value}\n" if isinstance(value, str) else f"number {name}={value:.17g}\n"


def main() -> None:
    """Write `messages.msg` beside this module."""
    STORED.write_text(render(), encoding="utf-8")


if __name__ == "__main__":
    main()
