"""Values of parameters that are known at launch, from a file in YAML: `Pick: {Speed: 0.3}`."""

from __future__ import annotations

import difflib
import enum
import warnings
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError, ReusedAnchorWarning, YAMLError

from dslkit.source import SourceFile, Span
from dslkit.source.python_file import too_deep
from ezskiros import session
from ezskiros.skills.interface import Parameter, SkillInterface
from ezskiros.trees import errors

Known = Mapping[str, Mapping[str, object]]
"""Values of parameters by their names, by the names of skills."""
LARGEST_FILE = 256 << 10
"""Bytes of a file, which is slow to read."""
_TOO_DEEP = "its lists and mappings lie too deep in each other"


def read_launch_values(path: Path, skills: Iterable[SkillInterface]) -> Known:
    """What a file says of the parameters of some skills; what is wrong with it is reported."""
    nowhere = Span(SourceFile(str(path), ""), 0, 0)
    try:
        with path.open("rb") as opened:
            text = opened.read(LARGEST_FILE + 1)
        if len(text) > LARGEST_FILE:
            said = f"it is larger than {LARGEST_FILE >> 10} KiB"
            session.report(errors.UnreadableValues(said=said).at(nowhere))
            return {}
        file = SourceFile(str(path), text.decode("utf-8"))
        deep = too_deep(file.text)
        if deep is not None:
            session.report(errors.UnreadableValues(said=_TOO_DEEP).at(Span(file, deep, deep + 1)))
            return {}
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ReusedAnchorWarning)  # YAML allows that
            content = YAML(typ="rt", pure=True).load(file.text)
    except (OSError, UnicodeDecodeError) as problem:
        said = getattr(problem, "strerror", None) or "it is no text"
        session.report(errors.UnreadableValues(said=said.lower()).at(nowhere))
        return {}
    except RecursionError:
        session.report(errors.UnreadableValues(said=_TOO_DEEP).at(nowhere))
        return {}
    except YAMLError as problem:
        session.report(_no_yaml(problem, file))
        return {}
    return dict(_Reader(file, {each.name: each for each in skills}).skills(content))


def _no_yaml(problem: YAMLError, file: SourceFile) -> Any:
    place = problem.problem_mark if isinstance(problem, MarkedYAMLError) else None
    said = getattr(problem, "problem", None) or "it is no YAML"
    start = min(place.index, len(file.text)) if place else 0
    return errors.UnreadableValues(said=said).at(Span(file, start, start))


class _Reader:
    """One file, against the skills that it may name."""

    def __init__(self, file: SourceFile, skills: Mapping[str, SkillInterface]) -> None:
        self._file, self._all = file, skills

    def skills(self, content: Any) -> Iterator[tuple[str, Mapping[str, object]]]:
        """For each skill that is named, what its parameters are."""
        if content is None:
            return
        if not isinstance(content, Mapping):
            session.report(errors.NoMapping(of="skills").at(Span(self._file, 0, 0)))
            return
        for name, values in content.items():
            span = self._key(content, name)
            skill = self._all.get(str(name))
            if skill is None:
                self._unknown(span, str(name), "skill", self._all)
            elif not isinstance(values, Mapping):
                session.report(errors.NoMapping(of=f"parameters of `{name}`").at(span))
            else:
                yield skill.name, dict(self._values(values, skill))

    def _values(self, values: Any, skill: SkillInterface) -> Iterator[tuple[str, object]]:
        for name, value in values.items():
            parameter = skill.parameter(str(name))
            if parameter is None:
                known = [each.name for each in skill.parameters if not each.is_thing]
                self._unknown(self._key(values, name), str(name), "parameter", known)
                continue
            found = _as_value(value, parameter)
            if parameter.takes(found):
                yield parameter.name, found
            else:
                span = self._value(values, name, str(value))
                wanted = "a thing of the world" if parameter.is_thing else parameter.type.__name__
                wrong = errors.WrongLaunchValue(
                    parameter=parameter.name, wanted=wanted, found=repr(value)
                )
                session.report(wrong.at(span))

    def _unknown(self, span: Span, spelled: str, kind: str, known: Iterable[str]) -> None:
        near = difflib.get_close_matches(spelled, list(known), n=1)
        help = f"did you mean `{near[0]}`?" if near else None
        found = errors.UnknownLaunchName(kind=kind, spelled=spelled)
        session.report(found.at(span, help=help))

    def _key(self, mapping: Any, name: object) -> Span:
        return self._at(mapping.lc.key(name), len(str(name)))

    def _value(self, mapping: Any, name: object, text: str) -> Span:
        return self._at(mapping.lc.value(name), len(text))

    def _at(self, place: tuple[int, int], length: int) -> Span:
        line, column = place
        start = self._file.line_starts[line] + column
        return Span(self._file, start, min(start + length, len(self._file.text)))


def _as_value(value: Any, parameter: Parameter) -> object:
    """A value of YAML as one of Python: without what remembers its layout."""
    if issubclass(parameter.type, enum.Enum):
        return parameter.type.__members__.get(str(value), value)
    for kind in (bool, int, float, str):
        if isinstance(value, kind) and type(value) is not kind:
            return kind(value)
    return value
