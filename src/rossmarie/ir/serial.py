"""A machine as JSON, and back. The text also contains the sources, so that spans keep their
meaning.

The layout follows the classes of the model: an object per instance with a member per field, nodes
tagged by the name of their class, enumerations by value, spans as `[file, start, end]`. `VERSION`
increases with every change of this layout; texts of other versions are refused.
"""

from __future__ import annotations

import dataclasses
import enum
import json
import types
import typing

from dslkit.source import SourceFile, Span
from rossmarie.core import Circle, Polygon, Rectangle, RegionFunction
from rossmarie.ir import model as ir
from rossmarie.ir.feedback import Margin
from rossmarie.ir.path import Beams, ByName, Doing, Each, Listed, Points, Quantity, Sector
from rossmarie.ir.reactions import Effect

FORMAT = "rossmarie-machine"
VERSION = 11

Json = dict[str, "Json"] | list["Json"] | str | int | float | bool | None


class UnreadableMachine(Exception):
    """The text is not a machine of this version."""


def machine_to_json(machine: ir.Machine) -> str:
    """The machine as JSON text; equal machines over equal sources give equal texts."""
    files: dict[SourceFile, int] = {}
    body = _encode(machine, files)
    sources: list[Json] = [{"path": file.path, "text": file.text} for file in files]
    whole: Json = {"format": FORMAT, "version": VERSION, "files": sources, "machine": body}
    return json.dumps(whole, indent=1, allow_nan=False) + "\n"


def machine_from_json(text: str) -> ir.Machine:
    """The machine in a text, without verification. Raises `UnreadableMachine`."""
    try:
        whole = json.loads(text)
        if whole["format"] != FORMAT or whole["version"] != VERSION:
            raise UnreadableMachine(f"not version {VERSION} of a {FORMAT}")
        files = [SourceFile(source["path"], source["text"]) for source in whole["files"]]
        machine = _decode(ir.Machine, whole["machine"], files)
    except (ValueError, KeyError, TypeError, IndexError, RecursionError) as error:
        raise UnreadableMachine(f"{type(error).__name__}: {error}") from error
    assert isinstance(machine, ir.Machine)
    return machine


def _encode(value: object, files: dict[SourceFile, int]) -> Json:
    match value:
        case Span(file=file, start=start, end=end):
            return [files.setdefault(file, len(files)), start, end]
        case enum.Enum():
            return typing.cast("Json", value.value)
        case tuple():
            return [_encode(item, files) for item in value]
        case None | bool() | int() | float() | str():
            return value
        case _:  # open: any dataclass of the machine
            return _encode_instance(value, files)


def _encode_instance(value: object, files: dict[SourceFile, int]) -> Json:
    assert dataclasses.is_dataclass(value)
    members: dict[str, Json] = {"class": type(value).__name__} if _is_node(type(value)) else {}
    for field in dataclasses.fields(value):
        members[field.name] = _encode(getattr(value, field.name), files)
    return members


_SHAPES = (Polygon, Rectangle, Circle)
_PARTS = (
    ByName, Listed, Each, Points, Sector, Beams, Doing, Quantity, Margin, RegionFunction, *_SHAPES
)  # fmt: skip
_NODES: dict[str, type] = {
    node.__name__: node
    for union in (ir.SignalNode, ir.PropositionNode, Effect)
    for node in typing.get_args(union)
} | {step.__name__: step for step in _PARTS}


def _is_node(kind: type) -> bool:
    return kind in _NODES.values()


def _decode(hint: object, data: typing.Any, files: list[SourceFile]) -> object:
    """The value of `data`, by the type `hint` of the model."""
    arguments = typing.get_args(hint)
    if typing.get_origin(hint) in (types.UnionType, typing.Union):
        return _decode(_choose(arguments, data), data, files)
    if typing.get_origin(hint) is tuple:
        _require(isinstance(data, list), hint, data)
        is_long = arguments[-1] is ...
        hints = [arguments[0]] * len(data) if is_long else arguments
        return tuple(_decode(each, item, files) for each, item in zip(hints, data, strict=True))
    if hint is Span:
        file, start, end = data
        return Span(files[_decode_int(file)], _decode_int(start), _decode_int(end))
    assert isinstance(hint, type)
    if issubclass(hint, enum.Enum):
        return hint(data)
    if dataclasses.is_dataclass(hint):
        return _decode_instance(hint, data, files)
    _require(type(data) is hint, hint, data)
    return data


def _decode_int(data: object) -> int:
    _require(type(data) is int, int, data)
    assert isinstance(data, int)
    return data


def _decode_instance(kind: type, data: typing.Any, files: list[SourceFile]) -> object:
    names = {field.name for field in dataclasses.fields(kind)}
    _require(isinstance(data, dict) and data.keys() - {"class"} == names, kind, data)
    hints = typing.get_type_hints(kind)
    return kind(**{name: _decode(hints[name], data[name], files) for name in names})


def _choose(hints: tuple[type, ...], data: typing.Any) -> object:
    is_node = isinstance(data, dict) and "class" in data
    kind = _NODES[data["class"]] if is_node else _plain(hints, data)
    chosen = tuple if kind is list else kind
    found = [hint for hint in hints if (typing.get_origin(hint) or hint) is chosen]
    _require(bool(found), hints, data)
    return found[0]


def _plain(hints: tuple[type, ...], data: object) -> type:
    """The type of a value that is not a node: a class of JSON, an enumeration, or the only class of
    the model.
    """
    if not isinstance(data, dict):
        names = (hint for hint in hints if issubclass(hint, enum.Enum))
        return next(names, type(data)) if isinstance(data, str) else type(data)
    return next(hint for hint in hints if dataclasses.is_dataclass(hint))


def _require(is_so: bool, hint: object, data: object) -> None:
    if not is_so:
        raise ValueError(f"expected {getattr(hint, '__name__', hint)}, found {str(data)[:60]!r}")
