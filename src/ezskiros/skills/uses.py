"""The topics and action servers that a skill commands: `self.uses += server("/move_base")`."""

from __future__ import annotations

import enum
from dataclasses import dataclass, field

from dslkit.source import Span
from ezskiros import session
from ezskiros.ontology.symbols import UNKNOWN, Described, UnknownValue, depends_on_symbol, described
from ezskiros.skills import permit_errors as errors
from ezskiros.skills.added import Added
from ezskiros.skills.ros_names import type_name, why_no_name
from ezskiros.skills.syntax import added_value


class Used(enum.Enum):
    """The kinds of resources that a skill uses."""

    TOPIC = "topic"
    SERVER = "server"


_WORDS = {Used.TOPIC: "a topic", Used.SERVER: "an action server"}
_NAMES = {Used.TOPIC: "/cmd_vel", Used.SERVER: "/move_base"}
_TYPES = {Used.TOPIC: "geometry_msgs/Twist", Used.SERVER: "move_base_msgs/MoveBase"}


@dataclass(frozen=True)
class Use(Described):
    """A topic or server that a skill commands, and its place in the source. `type` is
    `package/Type`.
    """

    kind: Used
    name: str
    type: str | None
    span: Span = field(compare=False)

    def described(self) -> str:
        """The description, for messages."""
        return f"{_WORDS[self.kind]} that a skill uses"


class Uses(Added[Use]):
    """The uses of a skill: `self.uses += topic("/cmd_vel", "geometry_msgs/Twist")`."""

    def __iadd__(self, use: Use | UnknownValue) -> Uses:
        if isinstance(use, Use):
            self._items.append(use)
            return self
        self.are_whole = False
        if not isinstance(use, UnknownValue):
            span = added_value(session.here())
            session.report(errors.NoUse(found=described(use)).at(span))
        return self

    def replaced_by(self, value: object) -> None:
        """Take the use of `self.uses = server("/move_base")`, which has been reported."""
        self.are_whole = False
        if isinstance(value, Use):
            self._items.append(value)


def topic(name: object, type: object) -> Use | UnknownValue:  # noqa: A002 - as users write it
    """The skill publishes on a topic: `topic("/cmd_vel", "geometry_msgs/Twist")`."""
    return _use(Used.TOPIC, name, type)


def server(name: object, type: object = None) -> Use | UnknownValue:  # noqa: A002 - as users write it
    """The skill sends goals to an action server: `server("/move_base")`."""
    return _use(Used.SERVER, name, type)


def _use(kind: Used, name: object, type: object) -> Use | UnknownValue:  # noqa: A002
    span = session.here()
    if isinstance(name, UnknownValue) or isinstance(type, UnknownValue):
        return UNKNOWN
    is_text = isinstance(name, str) and not depends_on_symbol(name)
    reason = why_no_name(str(name)) if is_text else "a string literal is needed"
    if reason is not None:
        wrong = errors.WrongRosName(
            found=described(name), a_kind=_WORDS[kind], reason=reason, example=_NAMES[kind]
        )
        session.report(wrong.at(span))
        return UNKNOWN
    is_typed = isinstance(type, str) and not depends_on_symbol(type)
    known = type_name(str(type)) if is_typed else None
    if known is None and not (type is None and kind is Used.SERVER):
        unfit = errors.WrongRosType(
            found=described(type), a_kind=_WORDS[kind], example=_TYPES[kind]
        )
        session.report(unfit.at(span))
        return UNKNOWN
    return Use(kind, str(name), known, span)
