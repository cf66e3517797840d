"""The mock generator of Early Dynamic Checking (thesis, Paper IV, section 4.2): mocks replace the
results of calls that a check skips.

A mock of an object has the methods and accessors of its class, and no others; none of them has an
effect. Their results are mocks again: of the declared return type, or of an unknown type.
"""

from __future__ import annotations

import dis
import inspect
import typing
from collections.abc import Iterator
from functools import lru_cache
from types import CodeType, FunctionType

from ezskiros.skills.interface import BASIC
from ezskiros.skills.values import Symbol


class Mock(Symbol):
    """The result of a call that was not made.

    `source` is the call, for messages. `kind` is the class of its result, if known. `function` is
    the object that a call of the mock would call.
    """

    def __init__(self, source: str, kind: type | None = None, function: object = None) -> None:
        self._source, self._kind, self._function = source, kind, function

    def described(self) -> str:
        """The description, for messages."""
        return f"the result of `{self._source}`"

    def __derived__(self) -> Mock:
        """The mock of a dependent value."""
        return Mock(self._source)

    def __repr__(self) -> str:
        return self._source

    def __getattr__(self, name: str) -> object:
        if name.startswith("__"):
            raise AttributeError(name)
        member = inspect.getattr_static(self._kind, name, None)
        if isinstance(member, property):
            return mock_of(member.fget, self._source)
        return Mock(self._source, function=member)

    def __call__(self, *_arguments: object, **_named: object) -> object:
        """Do nothing, and return a mock."""
        return mock_of(self._function, self._source)


class MockInstance(Mock):
    """An object of a class whose `__init__` did not run. It has the attributes of such objects."""

    def __init__(self, source: str, kind: type) -> None:
        super().__init__(source, kind)
        self._names = members(kind)
        self._shown = Mock if issubclass(kind, BASIC) else kind

    __class__ = property(lambda self: self._shown)
    """The class for `isinstance`."""

    def __getattr__(self, name: str) -> object:
        if self._names is not None and name not in self._names:
            raise AttributeError(f"{self._shown.__name__!r} object has no attribute {name!r}")
        return super().__getattr__(name)


def mock_of(function: object, source: str) -> object:
    """The mock for the result of a function, or for a class."""
    if isinstance(function, type):
        return MockInstance(source, function)
    kind = _returned(function)
    return None if kind is type(None) else Mock(source, kind)


def _returned(function: object) -> type | None:
    """The declared return class of a function; None if it is unknown."""
    function = getattr(function, "__func__", function)
    try:
        found = typing.get_type_hints(inspect.unwrap(function)).get("return")  # type: ignore[arg-type]
    except Exception:
        return None  # annotations can be any objects
    return found if isinstance(found, type) else None


@lru_cache(maxsize=256)
def members(kind: type) -> frozenset[str] | None:
    """The names of the attributes of a class's objects; None if some are unknown."""
    found = set(dir(kind))
    for each in kind.__mro__[:-1]:
        own = vars(each)
        is_open = "__getattr__" in own or "__getattribute__" in own or not _is_of_python(each)
        functions = [getattr(method, "__func__", method) for method in own.values()]
        codes = [each.__code__ for each in functions if isinstance(each, FunctionType)]
        if is_open or any(_ANY_NAME.intersection(code.co_names) for code in codes):
            return None
        assigned = (name for code in codes for name in _assigned(code))
        found.update(own.get("__annotations__", ()), assigned)
    return frozenset(found)


def _is_of_python(kind: type) -> bool:
    """Say whether a class is written in Python, so that assignments in its methods are visible."""
    return bool(kind.__flags__ & _HEAP_TYPE) and "__module__" in vars(kind)


_HEAP_TYPE = 1 << 9
_ANY_NAME = frozenset(("setattr", "__dict__", "__setattr__"))
"""With these names, methods can assign attributes invisibly."""


def _assigned(code: CodeType) -> Iterator[str]:
    """The attributes that a method assigns, on any object."""
    for step in dis.get_instructions(code):
        if step.opname == "STORE_ATTR":
            yield step.argval
