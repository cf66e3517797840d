"""Extraction: from a decoded message to the numbers that a machine reads from it.

The definition of the message is searched once, so each message costs only a few attribute accesses.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import islice
from operator import attrgetter
from typing import Any

from rosbags.interfaces import Nodetype
from rosbags.typesys.base import normalize_fieldname
from rosbags.typesys.store import Typestore

from rossmarie.ir import (
    EACH,
    POINTS,
    Array,
    ByName,
    ChannelValues,
    FieldKind,
    List,
    Listed,
    Path,
    SkillStep,
    Slot,
)
from rossmarie.ir.beams import scan_path
from rossmarie.ir.skills import answer
from rossmarie.recordings.clouds import CloudReader, cloud_readers, holds_cloud, is_of_points
from rossmarie.recordings.definitions import full_type
from rossmarie.recordings.elements import ElementSearch, Named, place_of
from rossmarie.recordings.scans import ScanReader, holds_scan, scan_readers
from rossmarie.recordings.skills import holds_skills, query_of

_TEXTS = ("string", "wstring")
_INSTANTS = ("builtin_interfaces/msg/Time", "builtin_interfaces/msg/Duration")

Message = Any
"""A message that rosbags has decoded; rosbags creates its class from its definition."""


@dataclass(frozen=True)
class WantedParts:
    """The part of messages that a machine reads: slots and arrays with their indices in the
    machine. `lists` are all lists of the machine.
    """

    slots: Mapping[int, Slot]
    arrays: Mapping[int, Array]
    lists: Sequence[List] = ()


Find = Callable[[Named, Sequence[str], int], int | None]
"""A function that gives the place of an element, as `place_of` does."""


@dataclass(frozen=True)
class Extractor:
    """Reads the wanted values of a message: those `found` in its type, not those `missing`.
    `sensed` reads the points of clouds and the beams of scans. `searches` contains the results for
    named elements.
    """

    read: Callable[[Message], ChannelValues]
    sensed: tuple[CloudReader | ScanReader, ...]
    found: WantedParts
    missing: tuple[Slot | Array, ...]
    searches: tuple[ElementSearch, ...]


def compile_extractor(
    store: Typestore, message_type: str, wanted: WantedParts, texts: Sequence[str]
) -> Extractor:
    """An extractor for messages of `message_type`; a missing slot is NaN, a missing array empty."""
    root = (Nodetype.NAME, full_type(message_type))
    numbers: dict[int, str] = {}
    others: dict[int, Callable[[Message], float]] = {}
    arrays: dict[int, Callable[[Message], list[float]]] = {}
    searches = {index: ElementSearch(slot) for index, slot in wanted.slots.items()}
    missing: list[Slot | Array] = []
    for index, slot in wanted.slots.items():
        query = query_of(slot)
        if query is not None and holds_skills(store, root):
            others[index] = partial(_answer, searches[index], query)
            continue
        description = _describe(store, root, slot.path)
        if description is None or not _holds(description, slot.kind):
            missing.append(slot)
        elif _is_number(description) and not _has_element(slot.path):
            numbers[index] = _attributes(slot.path)
        else:
            others[index] = _scalar_reader(searches[index], description, texts)
    sensed: dict[int, Array] = {}
    for index, array in wanted.arrays.items():
        if _is_sensed(store, root, array):
            sensed[index] = array
            continue
        description = _describe(store, root, array.path)
        reader = None if description is None else _elements_reader(array, description, texts)
        if reader is None:
            missing.append(array)
        else:
            arrays[index] = reader
    found = WantedParts(
        {
            index: slot
            for index, slot in wanted.slots.items()
            if index in numbers or index in others
        },
        {i: array for i, array in wanted.arrays.items() if i in arrays or i in sensed},
    )
    read = _reader(numbers, others, arrays)
    asking = (each for each in searches.values() if query_of(each.slot) is not None)
    named = [each for each in searches.values() if _goes_by_name(each.slot.path)]
    named += islice(asking, 1)  # all queries are about the same messages
    readers: tuple[CloudReader | ScanReader, ...]
    readers = (*cloud_readers(sensed, wanted.lists), *scan_readers(sensed, wanted.lists))
    return Extractor(read, readers, found, tuple(missing), tuple(named))


def _reader(
    numbers: Mapping[int, str],
    others: Mapping[int, Callable[[Message], float]],
    arrays: Mapping[int, Callable[[Message], list[float]]],
) -> Callable[[Message], ChannelValues]:
    indices = tuple(numbers)
    get = _get_all(tuple(numbers.values()))

    def read(message: Message) -> ChannelValues:
        slots = dict(zip(indices, map(float, get(message)), strict=True))
        for index, get_other in others.items():
            slots[index] = get_other(message)
        return ChannelValues(
            slots, {index: get_array(message) for index, get_array in arrays.items()}
        )

    return read


def _get_all(paths: tuple[str, ...]) -> Callable[[Message], tuple[float, ...]]:
    """Like `attrgetter`, but always a tuple."""
    if len(paths) == 1:
        get_only = attrgetter(paths[0])
        return lambda message: (get_only(message),)
    return attrgetter(*paths) if paths else _nothing


def _nothing(_: Message) -> tuple[float, ...]:
    return ()


def _scalar_reader(
    search: ElementSearch, description: Any, texts: Sequence[str]
) -> Callable[[Message], float]:
    slot = search.slot
    get = _path_reader(slot.path, search.place)
    to_number = _converter(slot.kind, description, texts)
    return lambda message: to_number(get(message))


def _answer(search: ElementSearch, query: SkillStep, message: Message) -> float:
    search.see_export(query, message.digest)
    return answer(query, message)


def _number(value: Any) -> float:
    return math.nan if value is None else float(value)


def _seconds(value: Any) -> float:
    return math.nan if value is None else value.sec + value.nanosec * 1e-9


def _elements_reader(
    array: Array, description: Any, texts: Sequence[str]
) -> Callable[[Message], list[float]] | None:
    """The reader of an array, or of one field of all elements of a list; None if there are no such
    values.
    """
    if array.list is None:
        return _array_reader(array.path) if _is_numeric_array(description) else None
    if not _holds(description, array.kind):
        return None
    step = array.path.index(EACH)
    get_list = _path_reader(array.path[:step], place_of)
    get = _path_reader(array.path[step + 1 :], place_of)
    to_number = _converter(array.kind, description, texts)
    return lambda message: [to_number(get(element)) for element in get_list(message)]


def _converter(kind: FieldKind, description: Any, texts: Sequence[str]) -> Callable[[Any], float]:
    if kind is FieldKind.TEXT:
        numbers = {text: float(number) for number, text in enumerate(texts)}
        return lambda value: numbers.get(value, -1.0)
    return _seconds if description[0] == Nodetype.NAME else _number


def _array_reader(path: Path) -> Callable[[Message], list[float]]:
    get = _path_reader(path, place_of)

    def read(message: Message) -> list[float]:
        elements = get(message)
        return [] if elements is None else list(map(float, elements.tolist()))

    return read


def _path_reader(path: Path, find: Find) -> Callable[[Message], Any]:
    """The reader of a path; it gives None if an array does not have the element."""
    if not _has_element(path):
        return attrgetter(_attributes(path))

    def read(message: Message) -> Any:
        value = message
        for part in path:
            if isinstance(part, str):
                value = getattr(value, normalize_fieldname(part))
                continue
            assert isinstance(part, int | Named), "a single element has a place or a name"
            place = _place(message, part, find, len(value))
            if place is None or place >= len(value):
                return None
            value = value[place]
        return value

    return read


def _place(message: Message, element: int | Named, find: Find, length: int) -> int | None:
    """The place of an element in an array of a length."""
    return element if isinstance(element, int) else find(element, _names(message, element), length)


def _names(message: Message, element: Named) -> Sequence[str]:
    """The names of an array's elements in a message; none if the input declares the names."""
    match element:
        case ByName(names=path):
            names: Sequence[str] = attrgetter(_attributes(path))(message)
            return names
        case Listed():
            return ()


def _goes_by_name(path: Path) -> bool:
    return any(isinstance(part, ByName | Listed) for part in path)


def _has_element(path: Path) -> bool:
    """Say whether a path leads into an array."""
    return not all(isinstance(part, str) for part in path)


def _attributes(path: Path) -> str:
    return ".".join(normalize_fieldname(str(part)) for part in path)


# --- what the definition says ----------------------------------------------------------------


def _describe(store: Typestore, root: Any, path: Path) -> Any:
    """The type description, in the form of rosbags, of a field of a message; None if there is no
    such field.
    """
    description = root
    for part in path:
        kind, content = description
        if not isinstance(part, str):
            if kind not in (Nodetype.ARRAY, Nodetype.SEQUENCE):
                return None
            if isinstance(part, ByName) and not _are_names(_describe(store, root, part.names)):
                return None
            description = content[0]
        else:
            if kind != Nodetype.NAME or content not in store.fielddefs:
                return None
            fields = dict(store.fielddefs[content][1])
            if part not in fields:
                return None
            description = fields[part]
    return description


def _is_sensed(store: Typestore, root: Any, array: Array) -> bool:
    """Say whether an array belongs to a cloud or a scan, in a message of the required type."""
    path, holds = scan_path(array.path), holds_scan
    if is_of_points(array):
        path, holds = array.path[: array.path.index(POINTS)], holds_cloud
    description = None if path is None else _describe(store, root, path)
    return description is not None and holds(description, store)


def _holds(description: Any, kind: FieldKind) -> bool:
    if kind is FieldKind.TEXT:
        return description[0] == Nodetype.BASE and description[1][0] in _TEXTS
    return _is_number(description) or (
        description[0] == Nodetype.NAME and description[1] in _INSTANTS
    )


def _are_names(description: Any) -> bool:
    """Say whether a description is the description of a list of strings."""
    if description is None or description[0] not in (Nodetype.ARRAY, Nodetype.SEQUENCE):
        return False
    kind, content = description[1][0]
    return bool(kind == Nodetype.BASE and content[0] in _TEXTS)


def _is_number(description: Any) -> bool:
    return description[0] == Nodetype.BASE and description[1][0] not in _TEXTS


def _is_numeric_array(description: Any) -> bool:
    kind, content = description
    return kind in (Nodetype.ARRAY, Nodetype.SEQUENCE) and _is_number(content[0])
