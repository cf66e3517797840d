"""Classes of texts with `{placeholders}`, whose annotated fields hold the values.

The fields are declared by name, like those of a frozen dataclass that takes only keywords. Unlike a
dataclass, no decorator makes methods for each class, and the fields are collected at the first use:
there are some hundred classes, and a run needs few of them or none.

A misspelt placeholder is found when the class is first used with any value, and by
`check_placeholders`, which a test calls for every class.
"""

from __future__ import annotations

import string
from collections.abc import Mapping
from functools import cache
from typing import TYPE_CHECKING, ClassVar, NoReturn

if TYPE_CHECKING:
    from typing_extensions import dataclass_transform
else:

    def dataclass_transform(**_: bool):  # noqa: D103
        return lambda kind: kind


@dataclass_transform(kw_only_default=True, frozen_default=True)
class Wording:
    """The base of `Template` and `Remark`; `worded` names the attributes that hold texts."""

    worded: ClassVar[tuple[str, ...]]

    if not TYPE_CHECKING:  # mypy derives the constructor, with the type of each field

        def __init__(self, **values: object) -> None:
            fields, defaults = _fields(type(self))
            values = {**defaults, **values}
            if values.keys() != fields:
                raise TypeError(f"{type(self).__name__} has the fields {sorted(fields)}")
            vars(self).update(values)

    def __setattr__(self, name: str, value: object) -> NoReturn:
        raise AttributeError(f"cannot assign to field `{name}`")

    def __delattr__(self, name: str) -> NoReturn:
        raise AttributeError(f"cannot delete field `{name}`")

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and vars(self) == vars(other)

    def __hash__(self) -> int:
        return hash((type(self), frozenset(vars(self).items())))

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value!r}" for name, value in vars(self).items())
        return f"{type(self).__qualname__}({values})"

    @classmethod
    def check_placeholders(cls) -> None:
        """Raise `ValueError` if a text names a field that the class does not have."""
        fields, _ = _fields(cls)  # type: ignore[arg-type] # mypy asks instances to be hashable as `type`
        for name in cls.worded:
            for _, field, _, _ in string.Formatter().parse(getattr(cls, name) or ""):
                if field is not None and field not in fields:
                    raise ValueError(f"{cls.__qualname__}: no field named {field!r}")


@cache
def _fields(kind: type[Wording]) -> tuple[frozenset[str], Mapping[str, object]]:
    """The fields of a class and of its bases, and the defaults of those that have any."""
    names: set[str] = set()
    defaults: dict[str, object] = {}
    for base in reversed(kind.__mro__):
        if issubclass(base, Wording):
            own = {name for name, each in base.__annotations__.items() if _is_field(each)}
            names |= own
            defaults |= {name: vars(base)[name] for name in own if name in vars(base)}
    return frozenset(names), defaults


def _is_field(annotation: object) -> bool:
    return not str(annotation).startswith(("ClassVar", "typing.ClassVar"))
