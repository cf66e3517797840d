"""The source skills files: a check whether they have changed, and places in them."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path

from dslkit.source import SourceFile, Span, ending, is_file
from rossmarie.skills.model import SkillFile, SourcePlace

LARGEST_SOURCE = 256 * 2**20
"""The largest size of a source, such as an ontology, in bytes."""
LARGEST_SHOWN = 4 * 2**20
"""The largest size of a Python module from which messages show a line, in bytes."""

_BLOCK = 2**20


@dataclass(frozen=True)
class OutOfDate:
    """A changed source, and the description of the change."""

    path: str
    problem: str


def changed_source(skills: SkillFile, folder: Path) -> OutOfDate | None:
    """The first source that is missing or has changed; None if there is none. `folder` is the
    folder of the skills file.
    """
    for source in skills.sources:
        path = folder / source.path
        if not is_file(path):
            return OutOfDate(source.path, "is not there")
        try:
            found = _sha256(path)
        except OSError:
            return OutOfDate(source.path, "cannot be read")
        if found != source.sha256:
            return OutOfDate(source.path, "has changed since")
    return None


def _sha256(path: Path) -> str | None:
    """The digest of a file; None if it is too large."""
    digest = hashlib.sha256()
    size = 0
    with path.open("rb") as stream:
        while block := stream.read(_BLOCK):
            size += len(block)
            if size > LARGEST_SOURCE:
                return None
            digest.update(block)
    return digest.hexdigest()


def span_at(place: SourcePlace | None, folder: Path) -> Span | None:
    """The span of a place in a Python module; None if no text can be shown. Text of other files,
    and of links to them, is never shown: the author of the rules may not be allowed to read them.
    """
    if place is None:
        return None
    path = folder / place.path
    file = _module(path) if ending(path) == ".py" and is_file(path) else None
    if file is None or place.end_line > len(file.line_starts):
        return None
    start = file.line_starts[place.line - 1] + place.column - 1
    end = file.line_starts[place.end_line - 1] + place.end_column - 1
    is_inside = place.line <= place.end_line and start <= end <= len(file.text)
    return Span(file, start, end) if is_inside else None


def _module(path: Path) -> SourceFile | None:
    try:
        with path.open("rb") as stream:
            content = stream.read(LARGEST_SHOWN + 1)
        return SourceFile.decoded(str(path), content) if len(content) <= LARGEST_SHOWN else None
    except (OSError, ValueError):
        return None
