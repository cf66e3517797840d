"""Message definitions as written: fields with their types, unresolved, and values of constants.

The common messages are read from `messages.msg` (see `snapshot`), other messages from folders of
.msg files. Of services and actions, only the request or goal is read: the part of the file before
the first `---`. Common services and actions are in `services.msg` and `actions.msg`. Names are in
the short form, `sensor_msgs/Imu`.
"""

from __future__ import annotations

import enum
import re
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from dslkit.source import SourceFile, ending
from rossmarie.types.message_lines import read_line

STORED = Path(__file__).with_name("messages.msg")
OWN = Path(__file__).with_name("skill_context.msg")
"""The messages of `skill_context_msgs`, our own package. `STORED` contains them, too."""
SEPARATOR = "=" * 80 + "\nMSG: "
"""The separator of two messages in concatenated .msg text, as in the headers of ROS 1 bags."""

_NAME = re.compile(r"([A-Za-z]\w*)/(?:(?:msg|srv|action)/)?([A-Za-z]\w*)", re.ASCII)
_END_OF_SENT = "---"
# rosbags puts this member into messages without fields, as the IDL of ROS 2 does.
_PADDING = "structure_needs_at_least_one_member"
_LARGEST_FILE = 64 * 1024


class DefinedField(NamedTuple):
    """The type of a field (`float32`, `geometry_msgs/Point`), and whether the field is an array of
    it.
    """

    base: str
    is_array: bool

    def __str__(self) -> str:
        return self.base + "[]" * self.is_array


Constant = float | str
"""A number, or a text; flags are 0 and 1."""


class MessageDefinition(NamedTuple):
    """The fields and the constants of a message, in the order of the file."""

    fields: Mapping[str, DefinedField]
    constants: Mapping[str, Constant]


class InterfaceKind(enum.Enum):
    """The kinds of definitions. The value is the suffix of the file, and the name of its folder in
    the package.
    """

    MESSAGE = "msg"
    SERVICE = "srv"
    ACTION = "action"


_STORED = {
    InterfaceKind.MESSAGE: STORED,
    InterfaceKind.SERVICE: Path(__file__).with_name("services.msg"),
    InterfaceKind.ACTION: Path(__file__).with_name("actions.msg"),
}


class MessageDefinitionError(Exception):
    """An unusable definition: its file, the line (None: the whole file), and the reason."""

    def __init__(self, path: Path, line: int | None, reason: str) -> None:
        place = f"{path}:{line}" if line is not None else str(path)
        super().__init__(f"{place}: {reason}")
        self.path = path
        self.line = line
        self.reason = reason


def normalized(name: str) -> str | None:
    """`sensor_msgs/Imu` for `sensor_msgs/msg/Imu`; None if this cannot be the name of a
    definition.
    """
    match = _NAME.fullmatch(name)
    return f"{match[1]}/{match[2]}" if match else None


@cache
def stored_texts(kind: InterfaceKind = InterfaceKind.MESSAGE) -> Mapping[str, str]:
    """The text of each common definition, by name; `read_stored` parses it."""
    return _texts_in(_STORED[kind])


@cache
def own_texts() -> Mapping[str, str]:
    """The text of each message of `skill_context_msgs`, by name."""
    return _texts_in(OWN)


def _texts_in(path: Path) -> Mapping[str, str]:
    blocks = path.read_text(encoding="utf-8").split(SEPARATOR)[1:]
    return dict(block.split("\n", 1) for block in blocks)


def read_stored(name: str, kind: InterfaceKind = InterfaceKind.MESSAGE) -> MessageDefinition | None:
    """The definition of a common message, service or action; None if the name is not one of
    them.
    """
    text = stored_texts(kind).get(name)
    if text is None:
        return None
    fields: dict[str, DefinedField] = {}
    constants: dict[str, Constant] = {}
    for line in text.splitlines():
        base, _, field = line.partition(" ")
        constant, sign, value = field.partition("=")
        if sign:
            constants[constant] = value if base == "string" else float(value)
        else:
            fields[field] = DefinedField(base.removesuffix("[]"), base.endswith("[]"))
    return MessageDefinition(fields, constants)


def find_file(
    name: str, search_paths: Sequence[Path], kind: InterfaceKind = InterfaceKind.MESSAGE
) -> Path | None:
    """The file of a definition, in the first folder that contains it; None if no folder does."""
    return next((path for path in places(name, search_paths, kind) if path.is_file()), None)


def places(
    name: str, search_paths: Sequence[Path], kind: InterfaceKind = InterfaceKind.MESSAGE
) -> list[Path]:
    """The paths at which the file of a definition is searched for, in this order."""
    package, _, short = name.partition("/")
    parents = ((package, kind.value), (package,))
    file = f"{short}.{kind.value}"
    return [folder.joinpath(*parts, file) for folder in search_paths for parts in parents]


def names_in(search_path: Path, kind: InterfaceKind = InterfaceKind.MESSAGE) -> list[str]:
    """The names of all definitions in a folder, whether or not their files can be used."""
    folder, pattern = kind.value, f"*.{kind.value}"
    files = [*search_path.glob(f"*/{pattern}"), *search_path.glob(f"*/{folder}/{pattern}")]
    packages = (file.parents[1] if file.parent.name == folder else file.parent for file in files)
    return [
        f"{package.name}/{file.stem}"
        for file, package in zip(files, packages, strict=True)
        if package != search_path
    ]


def package_among(search_paths: Sequence[Path], name: str) -> Path | None:
    """The search path that is itself the package of a message; the user should give its parent
    instead.
    """
    package, _, short = name.partition("/")
    for folder in search_paths:
        places = (folder / "msg" / f"{short}.msg", folder / f"{short}.msg")
        if folder.resolve().name == package and any(place.is_file() for place in places):
            return folder
    return None


def parse_file(source: SourceFile, name: str) -> MessageDefinition:
    """The definition in a .msg file, or the request or goal in a service or action file. Raises
    `MessageDefinitionError` if there is none.
    """
    path = Path(source.path)
    fields: dict[str, DefinedField] = {}
    constants: dict[str, Constant] = {}
    for number, line in enumerate(source.text.splitlines(), start=1):
        if line.strip() == _END_OF_SENT and path.suffix != ".msg":
            break
        found = _read_line(path, number, line, name)
        for field, type_ in found.fields.items():
            if field in fields:
                raise MessageDefinitionError(path, number, f"a second field named {field!r}")
            fields[field] = type_
        constants |= found.constants
    return MessageDefinition(fields, constants)


def read_file(path: Path) -> SourceFile:
    """The text of a definition. Raises `MessageDefinitionError` if the file cannot be read."""
    if ending(path) != path.suffix.lower():
        raise MessageDefinitionError(path, None, "is a link to a file of another kind")
    try:
        with path.open("rb") as file:
            data = file.read(_LARGEST_FILE + 1)
        source = SourceFile.decoded(str(path), data)
    except OSError as error:
        reason = error.strerror or type(error).__name__
        raise MessageDefinitionError(path, None, f"cannot be read: {reason}") from error
    except UnicodeDecodeError as error:
        raise MessageDefinitionError(path, None, "is not UTF-8 text") from error
    if len(data) > _LARGEST_FILE:
        raise MessageDefinitionError(path, None, f"is larger than {_LARGEST_FILE // 1024} KiB")
    return source


def _read_line(path: Path, number: int, line: str, name: str) -> MessageDefinition:
    try:
        found = read_line(line, name.partition("/")[0])
    except ValueError as error:
        reason = f"not a field or constant of a message: {line.strip()[:60]!r}"
        raise MessageDefinitionError(path, number, reason) from error
    if found is None:
        return MessageDefinition({}, {})
    if found.value is not None:
        return MessageDefinition({}, {found.name: found.value})
    return MessageDefinition(
        {found.name: DefinedField(normalized(found.base) or found.base, found.is_array)}, {}
    )


def from_rosbags(types: Mapping[str, Any]) -> dict[str, MessageDefinition]:
    """The definitions of rosbags, converted to our classes."""
    return {
        normalized(name) or name: MessageDefinition(
            {field: _field(description) for field, description in fields if field != _PADDING},
            {constant: _constant(value) for constant, _, value in constants},
        )
        for name, (constants, fields) in types.items()
    }


def _constant(value: bool | float | str) -> Constant:
    return value if isinstance(value, str) else float(value)


def _field(description: Any) -> DefinedField:
    kind, content = description
    if kind.name in ("ARRAY", "SEQUENCE"):
        return DefinedField(_field(content[0]).base, is_array=True)
    if kind.name == "BASE":
        return DefinedField(content[0], is_array=False)
    # rosbags does not know wide strings and takes the type for a message of the package.
    base = "wstring" if content.endswith("/wstring") else normalized(content) or content
    return DefinedField(base, is_array=False)
