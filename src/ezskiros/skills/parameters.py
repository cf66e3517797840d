"""Conversion of the signature of `description` to `Parameter`s."""

from __future__ import annotations

import enum
import inspect
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from types import FunctionType
from typing import Annotated, Any, get_args, get_origin

from dslkit.source import Span
from ezskiros import session
from ezskiros.ontology.symbols import UNKNOWN, OntologyClass, UnknownValue
from ezskiros.skills import errors, parameter_errors
from ezskiros.skills.interface import BASIC, ROBOT, Parameter
from ezskiros.skills.markers import Key, Marker, NoType, Option, ParameterKind
from ezskiros.skills.syntax import FunctionSource, definition

_EMPTY = inspect.Parameter.empty
_PACKED: dict[object, str] = {
    inspect.Parameter.VAR_POSITIONAL: "*",
    inspect.Parameter.VAR_KEYWORD: "**",
}


@lru_cache(maxsize=4096)
def signature_of(function: FunctionType) -> inspect.Signature:
    """A faster `inspect.signature`."""
    return inspect.signature(function)


def read_parameters(description: FunctionType) -> list[Parameter]:
    """The parameters. Invalid parameters are reported and left out."""
    written = definition(description)
    found = []
    for given in list(signature_of(description).parameters.values())[1:]:
        reader = _Reader(given, written, description)
        parameter = reader.read()
        if parameter is not None:
            found.append(parameter)
    _report_repeated_keys(found)
    return found


def _report_repeated_keys(parameters: Sequence[Parameter]) -> None:
    """Report keys that an earlier parameter has, because SkiROS2 would treat both as one
    parameter.
    """
    seen: dict[str, Parameter] = {}
    for each in parameters:
        first = seen.setdefault(each.key, each)
        if first is not each:
            found = parameter_errors.DuplicateKey(parameter=each.name, key=repr(each.key))
            session.report(found.at(each.span, found.First(parameter=first.name).at(first.span)))


@dataclass
class _Reader:
    """One parameter."""

    given: inspect.Parameter
    written: FunctionSource
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
        """Read the parameter; None, after a finding, if its type is not clear."""
        packed = _PACKED.get(self.given.kind)
        if packed:
            spelling = packed + self.name
            session.report(errors.PackedParameters(spelling=spelling).at(self.name_span))
            return None
        if self.given.annotation is _EMPTY:
            session.report(errors.NoAnnotation(parameter=self.name).at(self.name_span))
            return None
        annotation, marks = self._unwrapped(self.given.annotation)
        if isinstance(annotation, UnknownValue):
            return None
        if isinstance(annotation, Marker):
            found = parameter_errors.NoBrackets(marker=repr(annotation), meant=annotation.meant)
            session.report(found.at(self.annotation_span))
            return None
        parameter = self._typed(annotation, marks)
        return parameter and self._with_key(parameter, [each for each in marks if _is_key(each)])

    def _unwrapped(self, annotation: Any) -> tuple[Any, list[Any]]:
        """The annotated type, and its markers, innermost first."""
        if isinstance(annotation, NoType) and isinstance(annotation.found, str):
            annotation = annotation.found
        if isinstance(annotation, str):
            annotation = self._evaluated(annotation)
        if get_origin(annotation) is not Annotated:
            return annotation, []
        inner, *marks = get_args(annotation)
        found, others = self._unwrapped(inner)
        return found, [*others, *marks]

    def _with_key(self, parameter: Parameter, keys: list[Any]) -> Parameter:
        """A parameter with its own key, if it has one."""
        if not keys:
            return parameter
        text = getattr(keys[0], "text", None)
        if len(keys) > 1 or not isinstance(text, str) or not text:
            found = parameter_errors.WrongKey(parameter=self.name)
            session.report(found.at(self.annotation_span))
            return parameter
        return replace(parameter, other_key=text)

    def _typed(self, kind_of: Any, marks: Sequence[Any]) -> Parameter | None:
        kinds = [each for each in marks if isinstance(each, ParameterKind)]
        options = tuple(each for each in marks if isinstance(each, Option))
        kind = kinds[0] if kinds else ParameterKind.REQUIRED
        if len({*kinds}) > 1:
            session.report(errors.TwoKinds(parameter=self.name).at(self.annotation_span))
        is_enumeration = isinstance(kind_of, type) and issubclass(kind_of, enum.Enum)
        if not isinstance(kind_of, OntologyClass) and kind_of not in BASIC and not is_enumeration:
            wrong = errors.NoParameterType(parameter=self.name, found=_spelled(kind_of))
            session.report(wrong.at(self.annotation_span))
            return None
        if self.name == ROBOT and not isinstance(kind_of, OntologyClass):
            no_robot = parameter_errors.RobotAsValue(found=_spelled(kind_of))
            session.report(no_robot.at(self.name_span))
            return None
        if Option.OUTPUT in options:
            return self._output(kind_of, kinds, options)
        if isinstance(kind_of, OntologyClass):
            if self.given.default is not _EMPTY:
                span = self.written.defaults.get(self.name, self.annotation_span)
                session.report(errors.IndividualDefault(parameter=self.name).at(span))
            return self._parameter(kind_of, kind, options, None)
        if kind is ParameterKind.INFERRED or options:
            marker = (options[0].name if options else kind.name).upper()
            found = errors.MarkedBasic(marker=marker, type=_spelled(kind_of), parameter=self.name)
            session.report(found.at(self.annotation_span))
            kind = ParameterKind.REQUIRED
        return self._parameter(kind_of, kind, (), self._default(kind_of))

    def _output(
        self, kind_of: type, kinds: Sequence[ParameterKind], options: Sequence[Option]
    ) -> Parameter:
        """A parameter that only the skill sets."""
        others = {*kinds, *options} - {ParameterKind.OPTIONAL, Option.OUTPUT}
        span, reason = self.annotation_span, ""
        if others:
            reason = f"is {min(each.name for each in others)} as well"
        elif self.given.default is not _EMPTY:
            span = self.written.defaults.get(self.name, span)
            reason = "has a default"
        if reason:
            found = parameter_errors.WrongOutput(
                parameter=self.name, reason=reason, type=kind_of.__qualname__
            )
            session.report(found.at(span))
        return self._parameter(kind_of, ParameterKind.OPTIONAL, (Option.OUTPUT,), None)

    def _default(self, kind_of: type) -> Any:
        """The default, if it has the type of the parameter. An integer is also a float."""
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
        self, kind_of: type, kind: ParameterKind, options: tuple[Option, ...], default: Any
    ) -> Parameter:
        span, doc = self.name_span, self.written.docs.get(self.name, "")
        return Parameter(self.name, kind, kind_of, span, default, options, doc)

    def _evaluated(self, annotation: str) -> Any:
        """Evaluate a text, because `from __future__ import annotations` makes all types texts."""
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


def _is_key(mark: object) -> bool:
    """Say whether a marker is a key, or, by mistake, the class of keys itself."""
    return isinstance(mark, Key) or mark is Key


def _python_of(text: str) -> str:
    """A class such as `cora:Robot` as a Python name."""
    return f"`{text.strip().replace(':', '.')}`"


def _spelled(kind: Any) -> str:
    if isinstance(kind, type) and get_origin(kind) is None:
        article = "an" if kind.__name__[0].lower() in "aeiou" else "a"
        return f"{article} {kind.__name__}"
    return f"`{kind!r}`".replace("typing.", "")
