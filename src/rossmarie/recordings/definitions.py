"""Message definitions: from the type of a topic to the store that decodes its messages.

A definition in the recording takes precedence, then the user's own .msg folders, then the standard
packages of ROS and `skill_context_msgs`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path

from rosbags.interfaces import MessageDefinition, MessageDefinitionFormat, Nodetype
from rosbags.interfaces.typing import Constdefs, Fielddefs, FieldDesc, Typesdict
from rosbags.typesys import (
    Stores,
    TypesysError,
    get_types_from_idl,
    get_types_from_msg,
    get_typestore,
)
from rosbags.typesys.store import Typestore

from rossmarie.recordings.message_sizes import Sizes
from rossmarie.recordings.stored import RecordedConnection, plain_type
from rossmarie.types.definitions import own_texts

_STANDARD: Mapping[str, tuple[Stores, ...]] = {
    "ros1": (Stores.ROS1_NOETIC,),
    # Recordings without definitions are older than ROS 2 Iron; Humble fits them best.
    "cdr": (Stores.ROS2_HUMBLE, Stores.ROS2_JAZZY),
}
_ENCODINGS = frozenset(_STANDARD)
_NAME = re.compile(r"[A-Za-z]\w*", re.ASCII)
_SHORT = re.compile(r"[A-Za-z]\w*/[A-Za-z]\w*", re.ASCII)
_IDL_SEPARATOR = "=" * 80 + "\n"
_MSG_SEPARATOR = re.compile(r"^=+\r?\nMSG: (\S+)\r?\n", re.MULTILINE)


class UndefinedTypeError(Exception):
    """A message type without a known definition; the text gives the reason."""


def full_type(name: str) -> str:
    """The form of rosbags, `sensor_msgs/msg/Imu`, for `sensor_msgs/Imu`."""
    package, _, rest = name.partition("/")
    return name if "/" in rest else f"{package}/msg/{rest}"


def is_standard(message_type: str) -> bool:
    """Say whether a type such as `sensor_msgs/Imu` is in a standard package of ROS 1 or ROS 2, or
    in `skill_context_msgs`.
    """
    name = full_type(message_type)
    return name in _own_types() or any(
        name in _store(store).fielddefs for stores in _STANDARD.values() for store in stores
    )


def own_definitions(connections: Iterable[RecordedConnection]) -> dict[str, str]:
    """The .msg texts that connections contain, for their types and the types inside these, by names
    such as `my_msgs/Wheel`. Standard types and unreadable texts are left out. The first of several
    texts for one type counts.
    """
    found: dict[str, str] = {}
    for connection in connections:
        if is_standard(connection.message_type):
            continue
        try:
            store = typestore_for(connection, ())
        except UndefinedTypeError:
            continue
        for name, text in _texts(connection, store):
            if _SHORT.fullmatch(name) and not is_standard(name):
                found.setdefault(name, text.rstrip() + "\n")
    return found


def _texts(connection: RecordedConnection, store: Typestore) -> Iterator[tuple[str, str]]:
    """The recorded text of each type; a definition in IDL is converted to .msg."""
    text = connection.definition.data
    if connection.definition.format is not MessageDefinitionFormat.MSG:
        text, _ = store.generate_msgdef(full_type(connection.message_type), ros_version=2)
    first, *others = _MSG_SEPARATOR.split(text)
    yield connection.message_type, first
    for name, other in zip(others[::2], others[1::2], strict=True):
        yield plain_type(name), other


def typestore_for(connection: RecordedConnection, message_folders: Sequence[Path]) -> Typestore:
    """A store with the type of a connection, and all types that it contains.

    `message_folders` contain `<package>/msg/Type.msg` or `<package>/Type.msg`. Raises
    `UndefinedTypeError`.
    """
    if connection.encoding not in _ENCODINGS:
        raise UndefinedTypeError(f"its messages are encoded as `{connection.encoding}`")
    name = full_type(connection.message_type)
    reason = "the definition is neither in the recording nor in a standard ROS package"
    try:
        own = dict(_recorded_types(connection.definition, name))
        own = own or _types_in_folders(name, message_folders)
        own = own or (_own_types() if name in _own_types() else {})
        if own:
            return _store_of(own, connection.encoding)
    except (TypesysError, ValueError, AssertionError, OSError) as error:
        reason = f"its definition cannot be parsed ({_first_line(error)})"
    for standard in _STANDARD[connection.encoding]:
        if name in _store(standard).fielddefs:
            return _store(standard)
    raise UndefinedTypeError(reason)


@cache
def _store(name: Stores) -> Typestore:
    return get_typestore(name)


@cache
def _own_types() -> Typesdict:
    """The types of `skill_context_msgs`."""
    types: Typesdict = {}
    for name, text in own_texts().items():
        types.update(get_types_from_msg(text, full_type(name)))
    return types


def _recorded_types(definition: MessageDefinition, name: str) -> Typesdict:
    if definition.format is MessageDefinitionFormat.MSG:
        return get_types_from_msg(definition.data, name)
    if definition.format is not MessageDefinitionFormat.IDL:
        return {}
    types: Typesdict = {}
    for part in definition.data.split(_IDL_SEPARATOR):
        text = part.split("\n", 1)[1] if part.startswith("IDL: ") else part
        if text.strip():
            types.update(get_types_from_idl(text))
    return types


def _types_in_folders(name: str, folders: Sequence[Path]) -> Typesdict:
    """The definitions of a type and of the types that it contains, if their files exist."""
    types: Typesdict = {}
    wanted = [name]
    while wanted:
        path = _message_file(wanted[-1], folders)
        missing = wanted.pop()
        if path is None or missing in types:
            continue
        found = get_types_from_msg(path.read_text(encoding="utf-8"), missing)
        types.update(found)
        wanted += [part for _, fields in found.values() for part in _named(fields)]
    return types if name in types else {}


def _message_file(name: str, folders: Sequence[Path]) -> Path | None:
    package, _, type_name = name.split("/")
    places = (folder / package / inner for folder in folders for inner in ("msg", ""))
    return next(
        (found for place in places if (found := place / f"{type_name}.msg").is_file()), None
    )


def _store_of(types: Typesdict, encoding: str) -> Typestore:
    """A store of `types`, completed by the standard types that they contain."""
    store = get_typestore(Stores.EMPTY)
    complete = dict(types)
    wanted = [part for _, fields in types.values() for part in _named(fields)]
    while wanted:
        name = wanted.pop()
        if name not in complete and name not in store.fielddefs:
            complete[name] = _standard_definition(name, encoding)
            wanted += _named(complete[name][1])
    _check_names(complete)
    sizes = Sizes(complete)
    for name in complete:
        sizes.check(name)
    store.register(complete)
    return store


def _check_names(types: Typesdict) -> None:
    """Raise `TypesysError` unless all names are identifiers, because rosbags generates Python code
    from them.
    """
    for name, (constants, fields) in types.items():
        entries = [entry[0] for entry in constants] + [entry[0] for entry in fields]
        odd = [word for word in (*name.split("/"), *entries) if not _NAME.fullmatch(word)]
        if odd:
            raise TypesysError(f"`{odd[0]}` is not a name")


def _standard_definition(name: str, encoding: str) -> tuple[Constdefs, Fielddefs]:
    for standard in _STANDARD[encoding]:
        if name in _store(standard).fielddefs:
            return _store(standard).fielddefs[name]
    raise TypesysError(f"there is no {name}")


def _named(fields: Fielddefs) -> Iterator[str]:
    """The names of the message types of some fields."""
    for _, description in fields:
        inner = description[1][0] if _is_sequence(description) else description
        if inner[0] == Nodetype.NAME:
            yield str(inner[1])


def _is_sequence(description: FieldDesc) -> bool:
    return description[0] in (Nodetype.ARRAY, Nodetype.SEQUENCE)


def _first_line(error: Exception) -> str:
    return (str(error).splitlines() or [type(error).__name__])[0]
