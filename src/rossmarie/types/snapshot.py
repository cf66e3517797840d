"""Copies the message definitions of ROS out of the rosbags package into `messages.msg`.

Importing the type stores of rosbags takes most of the time that a whole check may take, so they
are read when this package is made, not when it is used (docs/decisions/0003). To renew the copy:
`python -m rossmarie.types.snapshot`. A test asserts that it is up to date.
"""

from __future__ import annotations

from rossmarie.types.definitions import SEPARATOR, STORED, Definition, from_rosbags


def render() -> str:
    """All definitions as concatenated .msg text, sorted by name.

    ROS 2 Jazzy comes first; of ROS 1 Noetic, the messages and the fields (`Header.seq`) that Jazzy
    does not have are added.
    """
    from rosbags.typesys import Stores, get_typestore

    merged: dict[str, Definition] = {}
    for store in (Stores.ROS2_JAZZY, Stores.ROS1_NOETIC):
        for name, definition in from_rosbags(get_typestore(store).fielddefs).items():
            merged[name] = _merge(merged.get(name, {}), definition)
    return "".join(SEPARATOR + _message(name, merged[name]) for name in sorted(merged))


def _merge(first: Definition, second: Definition) -> Definition:
    return {**first, **{name: field for name, field in second.items() if name not in first}}


def _message(name: str, definition: Definition) -> str:
    fields = (f"{field} {field_name}\n" for field_name, field in definition.items())
    return "".join((f"{name}\n", *fields))


def main() -> None:
    """Write `messages.msg` beside this module."""
    STORED.write_text(render(), encoding="utf-8")


if __name__ == "__main__":
    main()
