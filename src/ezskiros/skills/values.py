"""Symbols for values that are unknown before the skill runs: parameters of basic types, and results
of calls that a check skips (see `mocks.py`).

Operations on symbols give symbols. If Python needs the truth value of a symbol, both results are
followed one after the other.
"""

from __future__ import annotations

import dis
import enum
import sys
from abc import abstractmethod
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from types import FrameType
from typing import Any

from dslkit.source import Span
from ezskiros import session
from ezskiros.ontology import condition_errors as errors
from ezskiros.ontology.symbols import SYMBOL_IN_TEXT, UNKNOWN, Described, UnknownValue
from ezskiros.skills.growing import times
from ezskiros.skills.guard import CodeTimeOverError

MOST_PATHS = 64
MOST_DECISIONS = 1000
"""The maximum number of decisions in one run. More decisions indicate an endless loop."""


@dataclass
class Decisions:
    """The decisions of one run, with their places."""

    planned: list[bool] = field(default_factory=list)
    taken: list[bool] = field(default_factory=list)
    asked: list[tuple[Span, Described]] = field(default_factory=list)

    def decide(self, span: Span, symbol: Described) -> bool:
        """The next decision: the planned one, then always true."""
        number = len(self.taken)
        if number >= MOST_DECISIONS:
            raise CodeTimeOverError
        answer = self.planned[number] if number < len(self.planned) else True
        self.taken.append(answer)
        self.asked.append((span, symbol))
        return answer

    def following(self) -> list[bool] | None:
        """The decisions of the next run; None if all combinations have been tried."""
        found = list(self.taken)
        while found and not found[-1]:
            found.pop()
        return [*found[:-1], False] if found else None

    def last_planned(self) -> tuple[Span, Described]:
        """The place and the symbol of the last planned decision."""
        return self.asked[len(self.planned) - 1]


_decisions: ContextVar[Decisions | None] = ContextVar("decisions", default=None)


@contextmanager
def deciding(decisions: Decisions) -> Iterator[None]:
    """While the context is active, `decisions` determine the truth values of symbols."""
    token = _decisions.set(decisions)
    try:
        yield
    finally:
        _decisions.reset(token)


def decided(symbol: Described) -> bool:
    """Decide the truth value of an object that is unknown before the skill runs."""
    decisions = _decisions.get()
    return decisions is None or decisions.decide(session.here(), symbol)


def has_decided() -> bool:
    """Say whether the current path of the running method depends on an unknown value."""
    decisions = _decisions.get()
    return decisions is not None and bool(decisions.asked)


class Symbol(Described):
    """A value that is unknown before the skill runs.

    The names of its own attributes cannot be names of the value's attributes.
    """

    @abstractmethod
    def __derived__(self) -> Symbol:
        """The symbol of a dependent value."""

    def __plain__(self) -> object:
        """The value, if it is known."""
        return self

    def __bool__(self) -> bool:
        return decided(self)

    def __iter__(self) -> Iterator[Symbol]:
        return self.__parts__(sys._getframe(1))  # noqa: SLF001

    def __parts__(self, frame: FrameType) -> Iterator[Symbol]:
        """As many parts as a frame unpacks into names; for a loop, none or one."""
        count = _names_for_parts(frame)
        if count is None:
            count = int(_decisions.get() is not None and bool(self))
        return iter([self.__derived__() for _ in range(count)])

    def __str__(self) -> str:
        return f"{SYMBOL_IN_TEXT}{self!r}"

    def __contains__(self, _part: object) -> bool:
        return bool(self)

    def __enter__(self) -> Symbol:
        return self.__derived__()

    def __exit__(self, *_problem: object) -> None:
        """Suppress no exception."""

    def __setitem__(self, _key: object, _value: object) -> None:
        """Do nothing: the content is unknown."""

    # The results of operators have no type, because stand-ins for classes (`stand_ins.py`) use
    # them, too.
    def _operated(self, *_others: object) -> Any:
        return self.__derived__()

    def _times(self, other: object) -> Any:
        """A repeated list: like a loop, never or once."""
        if not isinstance(other, (list, tuple)):
            return self.__derived__()
        return times(other, int(_decisions.get() is not None and bool(self)))

    __mul__ = __rmul__ = _times
    __add__ = __radd__ = __sub__ = __rsub__ = _operated
    __truediv__ = __rtruediv__ = __floordiv__ = __rfloordiv__ = __mod__ = __rmod__ = _operated
    __pow__ = __rpow__ = __neg__ = __pos__ = __abs__ = __getitem__ = _operated
    __lt__ = __le__ = __gt__ = __ge__ = _operated
    __eq__ = __ne__ = _operated
    __hash__ = object.__hash__


def plain(value: object) -> object:
    """The known value of a symbol; any other object unchanged."""
    return value.__plain__() if isinstance(value, Symbol) else value


def _names_for_parts(frame: FrameType) -> int | None:
    """The number of parts that `a, b = ...` in a frame unpacks; None if the frame is at another
    statement.
    """
    code, place = frame.f_code.co_code, frame.f_lasti
    is_unpacking = dis.opname[code[place]] in ("UNPACK_SEQUENCE", "UNPACK_EX")
    return code[place + 1] if is_unpacking else None


class SymbolicValue(Symbol):
    """The value of a parameter. The type of values computed from it is unknown as well."""

    def __init__(self, name: str, kind: type | None = None) -> None:
        self._name, self._kind = name, kind

    def described(self) -> str:
        """The description, for messages."""
        if self._kind is None:
            return f"a value that depends on the parameter `{self._name}`"
        return f"the parameter `{self._name}`, of type {self._kind.__name__}"

    def __may_be__(self, kinds: tuple[type, ...]) -> bool:
        """Say whether the value can be of one of these types."""
        return self._kind is None or self._kind in kinds

    def __example__(self) -> object:
        """An example of its values; itself if its type is unknown."""
        return self if self._kind is None else _example(self._kind)

    def __derived__(self) -> SymbolicValue:
        """The symbol of a computed value."""
        return SymbolicValue(self._name)

    def __repr__(self) -> str:
        return self._name

    def __getattr__(self, name: str) -> SymbolicValue | UnknownValue:
        if name.startswith("__"):
            raise AttributeError(name)
        if self._kind is None or hasattr(_example(self._kind), name):
            return self.__derived__()
        found = errors.ValueRelates(parameter=self._name, type=self._kind.__name__, spelled=name)
        session.report(found.at(session.here()))
        return UNKNOWN

    def __call__(self, *_arguments: object, **_named: object) -> SymbolicValue:
        """Return a symbol, because the result depends on the value as well."""
        return self.__derived__()


def _example(value_type: type) -> object:
    """An example of a basic type or of an enumeration (its first member, if it has any)."""
    if issubclass(value_type, enum.Enum):
        return next(iter(value_type), value_type)
    return value_type()
