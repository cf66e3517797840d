"""Parameter values that are given at launch, from a YAML file: `Pick: {Speed: 0.3}`."""

from __future__ import annotations

import difflib
import enum
import re
import warnings
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError, ReusedAnchorWarning, YAMLError

from dslkit.diagnostics import DidYouMean
from dslkit.source import SourceFile, Span, ending
from dslkit.source.python_file import too_deep
from ezskiros import session
from ezskiros.skills.interface import Parameter, SkillInterface
from ezskiros.trees import errors
from ezskiros.trees.library import LaunchValues

_ENDINGS = (".yaml", ".yml", ".json")
LARGEST_FILE = 256 << 10
"""The most bytes of a file, because files are slow to read."""
_LINE_END = re.compile("\r\n?|[\n\x85\u2028\u2029]")
"""The line ends of YAML, which has more than editors."""
_TOO_DEEP = "its lists and mappings are nested too deeply"


class _UnreadableError(Exception):
    """The reason and the place of an error in a parameter file."""

    def __init__(self, said: str, span: Span) -> None:
        self.said, self.span = said, span
        super().__init__(said)


def read_launch_values(path: Path, skills: Iterable[SkillInterface]) -> LaunchValues:
    """Read the values of parameters of some skills from a file, and report the mistakes in it."""
    try:
        file = _file(path)
        content = _content(file)
    except _UnreadableError as problem:
        session.report(errors.UnreadableValues(said=problem.said).at(problem.span))
        return {}
    return dict(_Reader(file, {each.name: each for each in skills}).skills(content))


def _file(path: Path) -> SourceFile:
    nowhere = Span(SourceFile(str(path), ""), 0, 0)
    if ending(path) not in _ENDINGS:
        said = f"the name of the file must end in one of {', '.join(_ENDINGS)}"
        raise _UnreadableError(said, nowhere)
    try:
        with path.open("rb") as opened:
            text = opened.read(LARGEST_FILE + 1)
        if len(text) > LARGEST_FILE:
            raise _UnreadableError(f"it is larger than {LARGEST_FILE >> 10} KiB", nowhere)
        return SourceFile(str(path), text.decode("utf-8"))
    except (OSError, UnicodeDecodeError) as problem:
        said = getattr(problem, "strerror", None) or "it is not text"
        raise _UnreadableError(said.lower(), nowhere) from None


def _content(file: SourceFile) -> Any:
    deep = too_deep(file.text)
    if deep is not None:
        raise _UnreadableError(_TOO_DEEP, Span(file, deep, deep + 1))
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ReusedAnchorWarning)  # valid in YAML
            return YAML(typ="rt", pure=True).load(file.text)
    except RecursionError:
        raise _UnreadableError(_TOO_DEEP, Span(file, 0, 0)) from None
    except YAMLError as problem:
        place = problem.problem_mark if isinstance(problem, MarkedYAMLError) else None
        said = getattr(problem, "problem", None) or "it is not YAML"
        start = min(place.index, len(file.text)) if place else 0
        raise _UnreadableError(said, Span(file, start, start)) from None


class _Reader:
    """One file, with the skills that it may name."""

    def __init__(self, file: SourceFile, skills: Mapping[str, SkillInterface]) -> None:
        self._file, self._all = file, skills
        self._line_starts = (0, *(end.end() for end in _LINE_END.finditer(file.text)))

    def skills(self, content: Any) -> Iterator[tuple[str, Mapping[str, object]]]:
        """Each named skill, with its parameter values."""
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
                known = [each.name for each in skill.parameters if not each.is_individual]
                self._unknown(self._key(values, name), str(name), "parameter", known)
                continue
            found = _as_value(value, parameter)
            if parameter.takes(found):
                yield parameter.name, found
            else:
                span = self._value(values, name, str(value))
                wanted = (
                    "an individual of the world"
                    if parameter.is_individual
                    else parameter.type.__name__
                )
                wrong = errors.WrongLaunchValue(
                    parameter=parameter.name, wanted=wanted, found=repr(value)
                )
                session.report(wrong.at(span))

    def _unknown(self, span: Span, spelled: str, kind: str, known: Iterable[str]) -> None:
        near = difflib.get_close_matches(spelled, list(known), n=1)
        help = DidYouMean(near=near[0]) if near else None
        found = errors.UnknownLaunchName(kind=kind, spelled=spelled)
        session.report(found.at(span, help=help))

    def _key(self, mapping: Any, name: object) -> Span:
        return self._at(mapping.lc.key(name), len(str(name)))

    def _value(self, mapping: Any, name: object, text: str) -> Span:
        return self._at(mapping.lc.value(name), len(text))

    def _at(self, place: tuple[int, int], length: int) -> Span:
        line, column = place
        start = self._line_starts[line] + column
        return Span(self._file, start, min(start + length, len(self._file.text)))


def _as_value(value: Any, parameter: Parameter) -> object:
    """A YAML value as a plain Python value, without layout information."""
    if issubclass(parameter.type, enum.Enum):
        return parameter.type.__members__.get(str(value), value)
    for kind in (bool, int, float, str):
        if isinstance(value, kind) and type(value) is not kind:
            return kind(value)
    return value
