"""Values of a JSON file, each with its path, so that errors are reported with their place."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, NoReturn, TypeVar

Made = TypeVar("Made")

_KINDS = {dict: "an object", list: "a list", str: "a text", bool: "a boolean", type(None): "null"}
_LONGEST_SHOWN = 40


class UnreadableJson(Exception):
    """A text that is not JSON, or not the expected JSON. `offset` is the place of the error; None
    if only the message contains the place.
    """

    def __init__(self, problem: str, offset: int | None = None) -> None:
        super().__init__(problem)
        self.problem = problem
        self.offset = offset


@dataclass(frozen=True)
class Json:
    """A value and its path: `skills[3].name`."""

    value: Any
    path: str = ""

    def fail(self, problem: str) -> NoReturn:
        """Raise `UnreadableJson` with the place of the value."""
        raise UnreadableJson(f"`{self.path}` {problem}" if self.path else f"the file {problem}")

    def get(self, key: str) -> Json:
        """The member of an object."""
        found = self.find(key)
        if found is None:
            Json(None, self._path_to(key)).fail("is missing")
        return found

    def find(self, key: str) -> Json | None:
        """The member of an object, if it exists."""
        fields = self.fields()
        return Json(fields[key], self._path_to(key)) if key in fields else None

    def _path_to(self, key: str) -> str:
        return f"{self.path}.{key}" if self.path else key

    def fields(self) -> Mapping[str, Any]:
        """The members of an object, unchecked."""
        if not isinstance(self.value, dict):
            self._expected("an object")
        return self.value

    def elements(self) -> Iterator[Json]:
        """The elements of a list."""
        if not isinstance(self.value, list):
            self._expected("a list")
        for place, element in enumerate(self.value):
            yield Json(element, f"{self.path}[{place}]")

    def members(self, make: Callable[[Json], Made]) -> dict[str, Made]:
        """The results for the members of an object."""
        if not isinstance(self.value, dict):
            self._expected("an object")
        return {key: make(Json(each, self._path_to(key))) for key, each in self.value.items()}

    def each(self, make: Callable[[Json], Made]) -> tuple[Made, ...]:
        """The results for the elements of a list."""
        return tuple(make(element) for element in self.elements())

    def optional(self, make: Callable[[Json], Made]) -> Made | None:
        """The result for a value that may be null."""
        return None if self.value is None else make(self)

    def text(self) -> str:
        """A text that is not empty."""
        if not isinstance(self.value, str):
            self._expected("a text")
        if not self.value:
            self.fail("is empty")
        return self.value

    def texts(self) -> tuple[str, ...]:
        """A list of texts."""
        return self.each(Json.text)

    def one_of(self, *words: str) -> str:
        """One of some texts."""
        found = self.text()
        if found not in words:
            shown = found if len(found) <= _LONGEST_SHOWN else f"{found[:_LONGEST_SHOWN]}..."
            self.fail(f"is `{shown}`, and none of {', '.join(words)}")
        return found

    def number(self) -> float:
        """A finite number."""
        if isinstance(self.value, bool) or not isinstance(self.value, int | float):
            self._expected("a number")
        try:
            found = float(self.value)
        except OverflowError:
            found = math.inf
        if not math.isfinite(found):
            self.fail("is not a finite number")
        return found

    def boolean(self) -> bool:
        """True or false."""
        if not isinstance(self.value, bool):
            self._expected("a boolean")
        return bool(self.value)

    def whole(self) -> int:
        """A whole number above zero."""
        if isinstance(self.value, bool) or not isinstance(self.value, int):
            self._expected("a whole number")
        if self.value < 1:
            self.fail("is below 1")
        return self.value

    def _expected(self, kind: str) -> NoReturn:
        found = _KINDS.get(type(self.value), "a number")
        self.fail(f"is {found}, not {kind}")


def parse_json(text: str) -> Json:
    """The value in a text. Raises `UnreadableJson`."""
    try:
        return Json(json.loads(text, parse_constant=_no_number, object_pairs_hook=_object))
    except json.JSONDecodeError as error:
        raise UnreadableJson(f"it is not JSON: {error.msg.lower()}", error.pos) from error
    except RecursionError as error:
        raise UnreadableJson("its brackets are nested too deeply") from error
    except ValueError as error:  # a whole number with more digits than Python converts
        raise UnreadableJson("it has a number with too many digits") from error


def _no_number(word: str) -> NoReturn:
    raise UnreadableJson(f"it contains `{word}`, which is not a finite number")


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for key, value in pairs:
        if key in found:
            shown = key if len(key) <= _LONGEST_SHOWN else f"{key[:_LONGEST_SHOWN]}..."
            raise UnreadableJson(f"an object has the key `{shown}` twice")
        found[key] = value
    return found
