"""The messages of a command topic, which the filter of a guard reads and changes."""

from __future__ import annotations

import copy
from collections.abc import Sequence

from heron import messages
from heron.guard.attributes import attributes_of
from heron.messages import Message
from rossmarie.ir.reactions import CommandTopic, FieldPath


class CommandMessages:
    """The messages of one topic."""

    def __init__(self, command: CommandTopic) -> None:
        self._type = command.message_type
        self._paths = [field.path for field in command.fields]
        self._read = attributes_of([tuple(map(str, path)) for path in self._paths])

    def still(self) -> Message:
        """A command that is 0."""
        return messages.new_message(self._type)

    def numbers(self, message: Message) -> Sequence[float]:
        """The numbers of a command."""
        return self._read(message)

    def with_numbers(self, message: Message, numbers: Sequence[float]) -> Message:
        """Another command that has these numbers, and all else of this one."""
        changed = copy.deepcopy(message)
        for path, number in zip(self._paths, numbers, strict=True):
            setattr(_parent(changed, path), str(path[-1]), number)
        return changed


def _parent(message: Message, path: FieldPath) -> Message:
    for part in path[:-1]:
        message = getattr(message, str(part))
    return message
