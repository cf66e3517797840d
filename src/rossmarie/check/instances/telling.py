"""Rewrites findings on a program of instances with the names that the files use: `near` inside the
file, `front.near` outside, and the imports that lead to the file.
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Iterable, Iterator
from typing import Any

from dslkit.diagnostics import Diagnostic, Edit, Fix, Label
from rossmarie.check.instances.errors import ImportedAs, ImportedWith
from rossmarie.check.instances.spaces import Instances, Path
from rossmarie.syntax import ast

_MOST_IMPORTS = 4
_STRING = re.compile(r'((?<!\btest )"[^"\n]*")')


def reported(found: Iterable[Diagnostic], instances: Instances) -> tuple[Diagnostic, ...]:
    """Findings with the names that their reader knows. A finding that several instances share is
    reported once.
    """
    if not instances.files:
        return tuple(found)
    pattern = _pattern(instances)
    merged: dict[tuple[object, ...], Diagnostic] = {}
    for number, each in enumerate(found):
        space, imports = instances.files.get(each.primary.span.file, ((), ()))
        finding = each if pattern is None else _Wording(instances, pattern, space).of(each)
        key = _likeness(finding) if imports else (number,)
        known = merged.get(key, finding)
        labels = dict.fromkeys((*known.labels, *_imported(imports)))
        most = len(finding.labels) + _MOST_IMPORTS
        merged[key] = dataclasses.replace(known, labels=tuple(labels)[:most])
    return tuple(merged.values())


def spelled(text: str, instances: Instances) -> str:
    """Tests with names of a program, in the notation of the main file. Strings are values and stay
    unchanged. Titles of tests are not strings in this sense.
    """
    pattern = _pattern(instances)
    if pattern is None:
        return text
    wording = _Wording(instances, pattern, ())
    parts = _STRING.split(text)
    parts[::2] = map(wording.text, parts[::2])
    return "".join(parts)


def _pattern(instances: Instances) -> re.Pattern[str] | None:
    """A pattern for all names that this stage created; None if there are none. A name that is also
    the name of a frame stays unchanged, because it would be ambiguous.
    """
    names = sorted(instances.names.keys() - instances.frames, key=len, reverse=True)
    return re.compile(rf"\b(?:{'|'.join(map(re.escape, names))})\b") if names else None


def _likeness(found: Diagnostic) -> tuple[object, ...]:
    """A key that is equal for findings with the same content about the same text."""
    span = found.primary.span
    return (found.code, span.file.path, span.start, span.end, found.title, found.primary.text)


def _imported(imports: tuple[ast.Import, ...]) -> Iterator[Label]:
    for each in imports:
        if each.alias is not None:
            yield ImportedAs(name=each.alias.text).at(each.path.span)
        else:
            yield ImportedWith().at(each.path.span)


class _Wording:
    """The names of a program in the notation of the files of one name space."""

    def __init__(self, instances: Instances, pattern: re.Pattern[str], space: Path) -> None:
        self._instances = instances
        self._pattern = pattern
        self._space = space

    def of(self, found: Diagnostic) -> Diagnostic:
        """A finding with these names."""
        label = dataclasses.replace(found.primary, text=self.text(found.primary.text))
        labels = tuple(
            dataclasses.replace(each, text=self.text(each.text)) for each in found.labels
        )
        texts: dict[str, Any] = {
            "title": self.text(found.title),
            "notes": tuple(map(self.text, found.notes)),
            "help": None if found.help is None else self.text(found.help),
            "fix": None if found.fix is None else self._fix(found.fix),
        }
        return dataclasses.replace(found, primary=label, labels=labels, **texts)

    def _fix(self, fix: Fix) -> Fix:
        edits = tuple(Edit(each.span, self.text(each.replacement)) for each in fix.edits)
        return Fix(self.text(fix.title), edits)

    def text(self, text: str) -> str:
        """A text with these names."""
        return self._pattern.sub(self._name, text)

    def _name(self, match: re.Match[str]) -> str:
        path, name = self._instances.names[match.group()]
        shared = len(self._space) if path[: len(self._space)] == self._space else 0
        return ".".join((*path[shared:], name))
