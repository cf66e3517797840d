"""The types of ROS messages and of their fields.

Definitions come from `definitions`. Units come from the given overrides, then from `field_units`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from dslkit.source import SourceFile
from rossmarie.types import definitions
from rossmarie.types.definitions import (
    Constant,
    DefinedField,
    InterfaceKind,
    MessageDefinitionError,
)
from rossmarie.types.field_units import FIELD_UNITS
from rossmarie.types.model import (
    AXES,
    Array,
    Boolean,
    List,
    Message,
    Point,
    Quantity,
    Quaternion,
    Text,
    Type,
    Unsupported,
    Vector,
)
from rossmarie.types.sensors import (
    CLOUD,
    LAYOUT_OF_BEAMS,
    LAYOUT_OF_POINTS,
    POINTS,
    SCAN,
    beams_of,
    tells,
)
from rossmarie.units import Unit, parse_unit

FieldPath = tuple[str, ...]
UnitOverrides = Mapping[tuple[str, FieldPath], Unit]
Level = tuple[str, FieldPath]
"""A message that encloses a field, and the path from the message to the field."""

POSITIONS = frozenset(("geometry_msgs/Point", "geometry_msgs/Point32"))
VECTORS = POSITIONS | {"geometry_msgs/Vector3"}
_TRANSLATION = ("geometry_msgs/Transform", ("translation",))
"""A vector that is a position although its type is not a point."""
QUATERNION = "geometry_msgs/Quaternion"
INSTANTS = frozenset(("builtin_interfaces/Time", "builtin_interfaces/Duration"))
_MOST_FIELDS = 20_000
_MOST_LEVELS = 32
_LIMITS = {
    **{f"uint{bits}": (0.0, 2.0**bits - 1.0) for bits in (8, 16, 32, 64)},
    **{f"int{bits}": (-(2.0 ** (bits - 1)), 2.0 ** (bits - 1) - 1.0) for bits in (8, 16, 32, 64)},
    # ROS 1 and ROS 2 disagree on the sign of these.
    **dict.fromkeys(("byte", "char", "octet"), (-128.0, 255.0)),
}
"""The limits of fields of whole numbers, as doubles. The greatest 64-bit number is rounded upwards,
as it is on arrival.
"""
_TEXTS = frozenset(("string", "wstring"))
_LISTS_OF_NAMES = ("name", "names", "joint_names")


class Leaf(NamedTuple):
    """A field that is not a message: `base` is `float64`, `bool`, `string` or similar."""

    path: FieldPath
    base: str
    is_array: bool


class MessageCatalog:
    """All known messages: first those on the search paths, then the common messages of ROS.

    A folder of the search paths has files `PACKAGE/msg/NAME.msg` or `PACKAGE/NAME.msg`. The keys of
    overrides are the message, `my_msgs/Wheel`, and the path of the field in it. Overrides take
    precedence over the built-in table, also for a message inside another message.
    """

    def __init__(
        self, search_paths: Sequence[Path] = (), unit_overrides: UnitOverrides | None = None
    ) -> None:
        self._search_paths = tuple(search_paths)
        self._overrides = _normalized_overrides(unit_overrides or {})
        self._found: dict[str, Message | None] = {}
        self._definitions: dict[str, definitions.MessageDefinition | None] = {}
        self._parts: dict[str, tuple[str, ...]] = {}
        self._called: dict[str, list[str]] = {}
        self._leaves: dict[str, tuple[Leaf, ...]] = {}
        self._fields_left = _MOST_FIELDS
        self._read_files: list[SourceFile] = []

    @property
    def read_files(self) -> tuple[SourceFile, ...]:
        """The files that were read so far, each once. All results depend on these files."""
        return tuple(self._read_files)

    def find(self, name: str) -> Message | None:
        """The message `sensor_msgs/Imu`, also spelled `sensor_msgs/msg/Imu`; None if unknown.

        Raises `MessageDefinitionError` if its .msg file, or that of a message in it, is malformed.
        """
        short = definitions.normalized(name)
        if short is None:
            return None
        if short not in self._found:
            self._fields_left = _MOST_FIELDS
            self._found[short] = self._message(short, ((short, ()),))
        return self._found[short]

    def find_sent(self, name: str, kind: InterfaceKind) -> Message | None:
        """The message that is sent to a service (its request) or to an action server (its goal);
        None if the type is unknown. The goals of ROS 1 are also known as messages,
        `PACKAGE/NAMEGoal`.

        Raises `MessageDefinitionError` like `find`.
        """
        short = definitions.normalized(name)
        if short is None:
            return None
        key = f"{short} ({kind.value})"
        if key not in self._found:
            self._definitions[key] = self._read(short, kind)
            self._fields_left = _MOST_FIELDS
            self._found[key] = self._message(key, ((short, ()),))
        found = self._found[key]
        is_action = kind is InterfaceKind.ACTION
        return self.find(f"{short}Goal") if found is None and is_action else found

    def leaves(self, message: Message) -> tuple[Leaf, ...]:
        """All fields of a message that are not messages themselves, in order. Arrays of messages
        are left out, because their elements are not known in advance.
        """
        if message.name not in self._leaves:
            self._leaves[message.name] = tuple(self._find_leaves(message))
        return self._leaves[message.name]

    def _find_leaves(self, message: Message) -> Iterator[Leaf]:
        pending: list[tuple[FieldPath, DefinedField, tuple[str, ...]]]
        pending = [((name,), each, (message.name,)) for name, each in self._fields_of(message.name)]
        while pending:
            path, field, around = pending.pop(0)
            if "/" not in field.base:
                yield Leaf(path, field.base, field.is_array)
            elif not field.is_array and field.base not in (*around, *INSTANTS):
                inside = (*around, field.base)
                inner = self._fields_of(field.base)
                pending[:0] = [((*path, name), each, inside) for name, each in inner]

    def _fields_of(self, name: str) -> list[tuple[str, DefinedField]]:
        definition = self._definition(name)
        return [] if definition is None else list(definition.fields.items())

    def known_names(self, kind: InterfaceKind = InterfaceKind.MESSAGE) -> Sequence[str]:
        """The names of all messages, services or actions, sorted."""
        names = set(definitions.stored_texts(kind))
        for folder in self._search_paths:
            names.update(definitions.names_in(folder, kind))
        return sorted(names)

    def constants(self, name: str) -> Mapping[str, Constant]:
        """The constants of a message, by name.

        Raises `MessageDefinitionError` if its .msg file is malformed.
        """
        definition = self._definition(name)
        return {} if definition is None else definition.constants

    def parts(self, name: str) -> tuple[str, ...]:
        """A message and all messages that it contains, also as elements of arrays.

        Raises `MessageDefinitionError` if a .msg file among them is malformed.
        """
        first = definitions.normalized(name) or name
        if first not in self._parts:
            found = {first: None}
            waiting = [first]
            while waiting and len(found) < _MOST_FIELDS:
                definition = self._definition(waiting.pop())
                inside = () if definition is None else definition.fields.values()
                new = [each.base for each in inside if "/" in each.base and each.base not in found]
                found |= dict.fromkeys(new)
                waiting += new
            self._parts[first] = tuple(found)
        return self._parts[first]

    def called(self, name: str) -> Sequence[str]:
        """The full names of all messages with this name, in any package."""
        if not self._called:
            for each in self.known_names():
                self._called.setdefault(each.rpartition("/")[2], []).append(each)
        return self._called.get(name, ())

    def package_of(self, name: str) -> Path | None:
        """The search path that is the package of a message; the user should give its parent
        instead.
        """
        return definitions.package_among(self._search_paths, definitions.normalized(name) or name)

    def places_of(self, name: str) -> list[Path]:
        """The possible paths of the file of a message, in the search paths."""
        short = definitions.normalized(name)
        return definitions.places(short, self._search_paths) if short is not None else []

    def _definition(self, name: str) -> definitions.MessageDefinition | None:
        if name not in self._definitions:
            self._definitions[name] = self._read(name, InterfaceKind.MESSAGE)
        return self._definitions[name]

    def _read(self, name: str, kind: InterfaceKind) -> definitions.MessageDefinition | None:
        path = definitions.find_file(name, self._search_paths, kind)
        if path is None:
            return definitions.read_stored(name, kind)
        source = definitions.read_file(path)
        self._read_files.append(source)
        return definitions.parse_file(source, name)

    def _message(
        self, name: str, levels: tuple[Level, ...], *, is_element: bool = False
    ) -> Message | None:
        """A message; with `is_element`, an element of a list, whose own lists are left out."""
        definition = self._definition(name)
        if definition is None:
            return None
        self._fields_left -= len(definition.fields)
        if self._fields_left < 0:
            outermost, _ = levels[0]
            path = definitions.find_file(outermost, self._search_paths) or Path(outermost)
            raise MessageDefinitionError(path, None, f"has more than {_MOST_FIELDS} fields")
        names = None if is_element else _names_among(definition)
        fields = {
            field: self._type(
                type_, tuple((outer, (*path, field)) for outer, path in levels), is_element
            )
            for field, type_ in definition.fields.items()
        }
        named = {
            field: replace(type_, names=names)
            for field, type_ in fields.items()
            if isinstance(type_, Array)
        }
        if name == CLOUD and tells(definition, LAYOUT_OF_POINTS):
            inside = tuple((outer, (*path, POINTS)) for outer, path in levels)
            points = _inner_points() if is_element else List(self._point(inside))
            fields = {POINTS: points} | fields
        if name == SCAN and not is_element and tells(definition, LAYOUT_OF_BEAMS):
            return Message(name, {**fields, **named, **beams_of(fields)}, names)
        return Message(name, fields | named, names)

    def _point(self, levels: tuple[Level, ...]) -> Point:
        """The points of a cloud; `levels` are the messages around the cloud."""
        known: dict[str, Quantity] = {}
        for outer, path in levels:
            for (name, (*before, field)), unit in self._overrides.items():
                if (name, tuple(before)) == (outer, path) and field not in AXES:
                    known.setdefault(field, Quantity(unit))
        return Point(Quantity(self._unit(levels)), is_position=True, fields=known)

    def _type(self, field: DefinedField, levels: tuple[Level, ...], is_element: bool) -> Type:
        base = field.base
        if field.is_array:
            return _inner_array(base) if is_element else self._array(base, levels)
        if base == "bool":
            return Boolean()
        if base in _TEXTS:
            return Text()
        if base in INSTANTS:
            return Quantity(parse_unit("s"))
        if base == QUATERNION:
            return Quaternion()
        if base in VECTORS:
            is_position = base in POSITIONS or _TRANSLATION in levels
            return Vector(Quantity(self._unit((*levels, (base, ())))), is_position)
        if "/" not in base:
            return Quantity(self._unit(levels), _LIMITS.get(base))
        return self._nested(base, levels, is_element)

    def _array(self, base: str, levels: tuple[Level, ...]) -> Type:
        if base == "bool":
            return Array(Boolean())
        if base in _TEXTS or base in INSTANTS:
            kind = "strings" if base in _TEXTS else "times"
            return Unsupported(
                f"an array of {kind}; rules can use arrays of numbers, of booleans and of messages"
            )
        if "/" in base:
            return self._list(base, levels)
        return Array(Quantity(self._unit(levels), _LIMITS.get(base)))

    def _list(self, base: str, levels: tuple[Level, ...]) -> Type:
        if base == QUATERNION:
            return List(Quaternion())
        if base in VECTORS:
            quantity = Quantity(self._unit((*levels, (base, ()))))
            return List(Vector(quantity, base in POSITIONS))
        element = self._nested(base, levels, is_element=True)
        return List(element) if isinstance(element, Message) else element

    def _nested(self, base: str, levels: tuple[Level, ...], is_element: bool) -> Type:
        if any(name == base for name, _ in levels):
            return Unsupported(f"a {base} message inside itself")
        if len(levels) >= _MOST_LEVELS:
            return Unsupported(f"more than {_MOST_LEVELS} messages inside each other")
        message = self._message(base, (*levels, (base, ())), is_element=is_element)
        return message or Unsupported(f"a {base} message, of which no definition is known")

    def _unit(self, levels: tuple[Level, ...]) -> Unit | None:
        """The unit of a field. An override takes precedence over the table; in both, the outermost
        message with a unit counts.
        """
        keys = [key for level in levels for key in _keys(level)]
        for key in keys:
            if key in self._overrides:
                return self._overrides[key]
        for name, path in keys:
            fields = FIELD_UNITS.get(name, {})
            field = ".".join(path)
            if field in fields:
                symbol = fields[field]
                return None if symbol is None else parse_unit(symbol)
        return None


def _inner_array(base: str) -> Unsupported:
    """An array in an element of a list."""
    kind = "strings" if base in _TEXTS else f"{base} messages" if "/" in base else "numbers"
    return Unsupported(f"an array of {kind} in each element of a list; rules look one level deep")


def _inner_points() -> Unsupported:
    """A cloud in an element of a list."""
    return Unsupported("points in each element of a list; rules look one level deep")


def _names_among(definition: definitions.MessageDefinition) -> str | None:
    """The field with the names of the elements of the other arrays: the only list of strings, or
    the list called `name`.
    """
    lists = [
        name for name, each in definition.fields.items() if each.is_array and each.base in _TEXTS
    ]
    called = [name for name in lists if name in _LISTS_OF_NAMES]
    return next(iter(lists if len(lists) == 1 else called), None)


def message_value(message: Message) -> Type:
    """The value of a whole message: a vector, a quaternion, else the message itself."""
    if message.name in VECTORS:
        element = message.fields["x"]
        is_position = message.name in POSITIONS
        return Vector(element, is_position) if isinstance(element, Quantity) else message
    return Quaternion() if message.name == QUATERNION else message


def std_msgs_data(type_: Type) -> Type | None:
    """The type of the `data` of a std_msgs message without other fields; None for other
    messages.
    """
    if not isinstance(type_, Message) or not type_.name.startswith("std_msgs/"):
        return None
    return type_.fields["data"] if tuple(type_.fields) == ("data",) else None


def _normalized_overrides(overrides: UnitOverrides) -> UnitOverrides:
    return {
        (definitions.normalized(name) or name, path): unit
        for (name, path), unit in overrides.items()
    }


def _keys(level: Level) -> Iterator[Level]:
    """The keys for a field. A vector has one unit: a unit for one of its axes applies to all of
    them.
    """
    name, path = level
    if name in VECTORS:
        path = ()
    else:
        yield level
    yield from ((name, (*path, axis)) for axis in "xyz")
