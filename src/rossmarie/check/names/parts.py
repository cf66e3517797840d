"""The path from a message to a part of it, as expressions and tests write it step by step."""

from __future__ import annotations

from dataclasses import dataclass, replace

from rossmarie.ir.path import POINTS, Beams, ByName, Listed, Path, Sector, Step
from rossmarie.types import Array, Entry, List, Message, Type


def part_at(path: Path, type_: Type) -> MessagePart:
    """The part of a message at the end of a path of fields, if there is a `type_`, or at a query
    about the running skills.
    """
    if path and isinstance(path[-1], str):
        return MessagePart(path[:-1]).field(path[-1], type_)
    return MessagePart(path)


@dataclass(frozen=True)
class MessagePart:
    """A part of a message. With an `entry`, the part consists of the elements with this name in all
    arrays below `path`.
    """

    path: Path = ()
    entry: ByName | None = None

    def field(self, name: str, type_: Type) -> MessagePart:
        """A field of this part, with its type. The field of an entry is the element in the
        array.
        """
        step: Step = name
        if isinstance(type_, List) and (type_.is_of_points or type_.is_of_beams):
            step = POINTS if type_.is_of_points else Beams(name)
        path = (*self.path, step)
        if self.entry is None or isinstance(type_, Entry):
            return replace(self, path=path)
        return MessagePart((*path, self.entry))

    def sector(self, sector: Sector) -> MessagePart:
        """A sector of this part, which is the `ranges` of a scan."""
        return replace(self, path=(*self.path, sector))

    def element(self, index: int | str, owner: Type) -> MessagePart:
        """An element of this part by its index or its name. `owner` is the type of this part, and
        has such elements.
        """
        if isinstance(index, int):
            return replace(self, path=(*self.path, index))
        assert isinstance(owner, Message | Array), "checked: only their elements have names"
        assert owner.names is not None, "checked: they have names"
        if isinstance(owner.names, tuple):
            listed = Listed(owner.names.index(index), len(owner.names), index)
            return replace(self, path=(*self.path, listed))
        outside = self.path if isinstance(owner, Message) else self.path[:-1]
        names = (*(step for step in outside if isinstance(step, str)), owner.names)
        element = ByName(names, index)
        if isinstance(owner, Message):
            return replace(self, entry=element)
        return replace(self, path=(*self.path, element))
