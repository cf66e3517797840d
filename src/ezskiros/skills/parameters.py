"""The signature of `description` in, `Parameter`s out."""

from __future__ import annotations

import enum
import inspect
import sys
from dataclasses import dataclass
from functools import lru_cache
from types import FunctionType
from typing import Annotated, Any, get_args, get_origin

from dslkit.source import Span
from ezskiros import session
from ezskiros.ontology.things import UNKNOWN, ThingClass, Unknown
from ezskiros.skills import errors
from ezskiros.skills.interface import BASIC, Parameter
from ezskiros.skills.markers import Kind, Option
from ezskiros.skills.syntax import Definition, definition

_EMPTY = inspect.Parameter.empty
_PACKED: dict[object, str] = {
    inspect.Parameter.VAR_POSITIONAL: "*",
    inspect.Parameter.VAR_KEYWORD: "**",
}


@lru_cache(maxsize=4096)
def signature_of(function: FunctionType) -> inspect.Signature:
    """What `inspect.signature` says, which takes its time."""
    return inspect.signature(function)


def read_parameters(description: FunctionType) -> list[Parameter]:
    """The parameters, without those that are wrong, which are reported."""
    written = definition(description)
    found = []
    for given in list(signature_of(description).parameters.values())[1:]:
        reader = _Reader(given, written, description)
        parameter = reader.read()
        if parameter is not None:
            found.append(parameter)
    return found


@dataclass
class _Reader:
    """One parameter."""

    given: inspect.Parameter
    written: Definition
    function: FunctionType

    @property
    def name(self) -> str:
        return self.given.name

    @property
    def name_span(self) -> Span:
        return self.written.name_of(self.name)

    @property
    def annotation_span(self) -> Span:
        return self.written.annotations.get(self.name) or self.name_span

    def read(self) -> Parameter | None:
        """What is meant; None if that is not clear, after a finding."""
        packed = _PACKED.get(self.given.kind)
        if packed:
            spelling = packed + self.name
            session.report(errors.PackedParameters(spelling=spelling).at(self.name_span))
            return None
        if self.given.annotation is _EMPTY:
            session.report(errors.NoAnnotation(parameter=self.name).at(self.name_span))
            return None
        annotation = self._evaluated(self.given.annotation)
        if isinstance(annotation, Unknown):
            return None
        kind, options = Kind.REQUIRED, []
        if get_origin(annotation) is Annotated:
            annotation, *marks = get_args(annotation)
            kind = next((mark for mark in marks if isinstance(mark, Kind)), Kind.REQUIRED)
            options = [mark for mark in marks if isinstance(mark, Option)]
        if isinstance(annotation, Unknown):
            return None
        return self._typed(annotation, kind, tuple(options))

    def _typed(self, kind_of: Any, kind: Kind, options: tuple[Option, ...]) -> Parameter | None:
        if isinstance(kind_of, ThingClass):
            if self.given.default is not _EMPTY:
                span = self.written.defaults.get(self.name, self.annotation_span)
                session.report(errors.ThingDefault(parameter=self.name).at(span))
            return self._parameter(kind_of, kind, options, None)
        is_enumeration = isinstance(kind_of, type) and issubclass(kind_of, enum.Enum)
        if kind_of not in BASIC and not is_enumeration:
            wrong = errors.NoParameterType(parameter=self.name, found=_spelled(kind_of))
            session.report(wrong.at(self.annotation_span))
            return None
        if kind is Kind.INFERRED or options:
            marker = (options[0].name if options else kind.name).upper()
            found = errors.MarkedBasic(marker=marker, type=_spelled(kind_of), parameter=self.name)
            session.report(found.at(self.annotation_span))
            kind = Kind.REQUIRED
        return self._parameter(kind_of, kind, (), self._default(kind_of))

    def _default(self, kind_of: type) -> Any:
        """The default if it is of the type; a whole number is a float as well."""
        default = self.given.default
        if default is _EMPTY:
            return None
        if kind_of is float and type(default) is int:
            return float(default)
        if type(default) is kind_of or (isinstance(default, kind_of) and kind_of not in BASIC):
            return default
        span = self.written.defaults.get(self.name, self.annotation_span)
        found = errors.WrongDefault(
            parameter=self.name, found=repr(default), expected=kind_of.__name__
        )
        session.report(found.at(span))
        return None

    def _parameter(
        self, kind_of: type, kind: Kind, options: tuple[Option, ...], default: Any
    ) -> Parameter:
        span, doc = self.name_span, self.written.docs.get(self.name, "")
        return Parameter(self.name, kind, kind_of, span, default, options, doc)

    def _evaluated(self, annotation: Any) -> Any:
        """What a text stands for: with `from __future__ import annotations` all types are texts."""
        if not isinstance(annotation, str):
            return annotation
        module = sys.modules.get(self.function.__module__)
        names = {**vars(module)} if module else {}
        names |= self.function.__globals__
        try:
            return eval(annotation, names)
        except Exception as problem:
            found = errors.TextAnnotation(
                parameter=self.name,
                text=repr(annotation),
                reason=str(problem).partition("(")[0].strip() or type(problem).__name__,
                example=_python_of(annotation),
            )
            session.report(found.at(self.annotation_span))
            return UNKNOWN


def _python_of(text: str) -> str:
    """`cora:Robot` as a class of Python."""
    return f"`{text.strip().replace(':', '.')}`"


def _spelled(kind: Any) -> str:
    if isinstance(kind, type) and get_origin(kind) is None:
        article = "an" if kind.__name__[0].lower() in "aeiou" else "a"
        return f"{article} {kind.__name__}"
    return f"`{kind!r}`".replace("typing.", "")
