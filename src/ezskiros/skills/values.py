"""Symbols for parameters of basic types: numbers, texts, truth values and enumerations.

What is done to them gives more of them. Where Python asks one whether it is true, both answers are
followed, one after the other.
"""

from __future__ import annotations

import enum
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field

from dslkit.source import Span
from ezskiros import session
from ezskiros.ontology import condition_errors as errors
from ezskiros.ontology.things import UNKNOWN, Described, Unknown
from ezskiros.skills.guard import TimeOverError

MOST_PATHS = 64
MOST_DECISIONS = 1000
"""Of one run: more are those of a loop that does not end."""


@dataclass
class Decisions:
    """The answers of one run, and where each was asked for."""

    planned: list[bool] = field(default_factory=list)
    taken: list[bool] = field(default_factory=list)
    asked: list[tuple[Span, str]] = field(default_factory=list)

    def decide(self, span: Span, name: str) -> bool:
        """The next answer: as planned, then always true."""
        number = len(self.taken)
        if number >= MOST_DECISIONS:
            raise TimeOverError
        answer = self.planned[number] if number < len(self.planned) else True
        self.taken.append(answer)
        self.asked.append((span, name))
        return answer

    def following(self) -> list[bool] | None:
        """The answers of the next run; None if all have been tried."""
        found = list(self.taken)
        while found and not found[-1]:
            found.pop()
        return [*found[:-1], False] if found else None


_decisions: ContextVar[Decisions | None] = ContextVar("decisions", default=None)


@contextmanager
def deciding(decisions: Decisions) -> Iterator[None]:
    """Within, symbols are asked as `decisions` says."""
    token = _decisions.set(decisions)
    try:
        yield
    finally:
        _decisions.reset(token)


def _example(value_type: type) -> object:
    """Some value of a basic type, or of an enumeration (its first, if it has any)."""
    if issubclass(value_type, enum.Enum):
        return next(iter(value_type), value_type)
    return value_type()


class SymbolicValue(Described):
    """A value that is not known before the skill runs. Of what is computed from it the type is not
    known either.
    """

    def __init__(self, name: str, kind: type | None = None) -> None:
        self._name, self._kind = name, kind

    def described(self) -> str:
        """For messages."""
        if self._kind is None:
            return f"a value that depends on the parameter `{self._name}`"
        return f"the parameter `{self._name}`, of type {self._kind.__name__}"

    def __repr__(self) -> str:
        return self._name

    def __bool__(self) -> bool:
        decisions = _decisions.get()
        return decisions is None or decisions.decide(session.here(), self._name)

    def __getattr__(self, name: str) -> SymbolicValue | Unknown:
        if name.startswith("__"):
            raise AttributeError(name)
        if self._kind is None or hasattr(_example(self._kind), name):
            return SymbolicValue(self._name)
        found = errors.ValueRelates(parameter=self._name, type=self._kind.__name__, spelled=name)
        session.report(found.at(session.here()))
        return UNKNOWN

    def __call__(self, *_arguments: object, **_named: object) -> SymbolicValue:
        """Whatever comes of it depends on the value as well."""
        return SymbolicValue(self._name)

    def _derived(self, *_others: object) -> SymbolicValue:
        return SymbolicValue(self._name)

    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = _derived
    __truediv__ = __rtruediv__ = __floordiv__ = __rfloordiv__ = __mod__ = __rmod__ = _derived
    __pow__ = __rpow__ = __neg__ = __pos__ = __abs__ = __getitem__ = _derived
    __lt__ = __le__ = __gt__ = __ge__ = _derived
    __eq__ = __ne__ = _derived  # type: ignore[assignment]
    __hash__ = object.__hash__
