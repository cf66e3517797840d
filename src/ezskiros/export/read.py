"""Reading of an exported skills file, and the test that its sources have not changed."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from dslkit.diagnostics import Diagnostic
from dslkit.source import SourceFile, Span, is_file, shown
from dslkit.writing import reason
from ezskiros.export.errors import NoExport, NotExported, StaleExport
from ezskiros.export.sources import (
    FORMAT,
    VERSION,
    ExportedSource,
    digest_of,
    path_from,
    sha256_of,
)

LARGEST_EXPORT = 1 << 26
"""The most bytes of an export."""
_HEXADECIMAL = re.compile(r"[0-9a-f]{64}")


@dataclass(frozen=True)
class Export:
    """The head of an export: its digest and its sources."""

    path: Path
    digest: str
    sources: tuple[ExportedSource, ...]
    file: SourceFile

    def place_of(self, source: ExportedSource) -> Span:
        """The place of a source in the export."""
        named = json.dumps(source.path)
        start = max(self.file.text.find(named), 0)
        return Span(self.file, start, start + len(named))


class NotJsonError(Exception):
    """A file that is not JSON. The text gives the reason, `place` the position."""

    def __init__(self, why: str, place: Span) -> None:
        super().__init__(why)
        self.place = place


def read_json(path: Path) -> tuple[SourceFile, Any]:
    """A file and its content. Raises `NotJsonError`, and `OSError` if the file cannot be read."""
    file = SourceFile(shown(str(path)), "")
    with path.open("rb") as opened:
        content = opened.read(LARGEST_EXPORT + 1)
    if len(content) > LARGEST_EXPORT:
        raise NotJsonError(f"it is larger than {LARGEST_EXPORT >> 20} MiB", Span(file, 0, 0))
    try:
        file = SourceFile.decoded(file.path, content)
        return file, json.loads(file.text, parse_constant=_refuse_constant)
    except UnicodeDecodeError as problem:
        why = f"byte {problem.start + 1} is not UTF-8"
        raise NotJsonError(why, Span(file, 0, 0)) from problem
    except json.JSONDecodeError as problem:
        at = Span(file, problem.pos, min(problem.pos + 1, len(file.text)))
        raise NotJsonError(f"it is not JSON: {problem.msg}", at) from problem
    except (ValueError, RecursionError) as problem:
        why = str(problem) if isinstance(problem, ValueError) else "it is nested too deeply"
        raise NotJsonError(why, Span(file, 0, min(1, len(file.text)))) from problem


def place_of_key(file: SourceFile, key: str) -> Span:
    """The first place of a key; the start of the file if the key is missing."""
    start = max(file.text.find(json.dumps(key)), 0)
    return Span(file, start, min(start + 1, len(file.text)))


def read_export(path: Path) -> Export | Diagnostic:
    """The head of an export, or the finding for an invalid file. Raises `OSError` if the file
    cannot be read.
    """
    try:
        file, found = read_json(path)
    except NotJsonError as problem:
        return _no_export(problem.place, str(problem))
    wrong = _fault(found)
    if wrong is not None:
        return _no_export(place_of_key(file, wrong[0]), wrong[1])
    sources = tuple(ExportedSource(each["path"], each["sha256"]) for each in found["sources"])
    return Export(path, found["digest"], sources, file)


def _refuse_constant(spelled: str) -> None:
    raise ValueError(f"`{spelled}` is not a JSON number")


def _no_export(place: Span, why: str) -> Diagnostic:
    return NoExport(path=place.file.path, reason=why).at(place)


def _fault(found: Any) -> tuple[str, str] | None:
    """The wrong key and the reason; None if the head is valid."""
    wrong = wrong_format(found, FORMAT, VERSION)
    if wrong is not None:
        return wrong
    sources = found.get("sources")
    if not isinstance(sources, list) or not all(map(_is_source, sources)):
        return "sources", "its `sources` are not paths with their SHA-256"
    known = [ExportedSource(each["path"], each["sha256"]) for each in sources]
    if found.get("digest") != digest_of(known):
        return "digest", "its `digest` does not match its `sources`"
    return None


def wrong_format(found: Any, form: str, version: int) -> tuple[str, str] | None:
    """The key that shows another format or version, and the reason; None if both are right."""
    if not isinstance(found, dict) or found.get("format") != form:
        return "format", f"its `format` is not `{form}`"
    own = found.get("version")
    if type(own) is not int or own != version:
        return (
            "version",
            f"its `version` is not {version}, the only version that this EzSkiROS reads",
        )
    return None


def _is_source(found: Any) -> bool:
    if not isinstance(found, dict):
        return False
    path, sha256 = found.get("path"), found.get("sha256")
    is_path = isinstance(path, str) and path != "" and not path.startswith("/")
    return is_path and isinstance(sha256, str) and _HEXADECIMAL.fullmatch(sha256) is not None


def changed_sources(export: Export) -> Iterator[Diagnostic]:
    """Findings for sources that have changed since the export, which is then stale."""
    folder = export.path.absolute().parent
    for source in export.sources:
        why = _change(folder / source.path, source)
        if why is not None:
            found = StaleExport(path=export.file.path, source=source.path, reason=why)
            yield found.at(export.place_of(source))


def _change(file: Path, source: ExportedSource) -> str | None:
    if not is_file(file):
        return "no longer exists"
    try:
        is_same = sha256_of(file) == source.sha256
    except OSError as problem:
        return f"cannot be read: {reason(problem)}"
    return None if is_same else "has changed"


def not_exported(export: Export, files: Iterable[Path]) -> Iterator[Diagnostic]:
    """Findings for files of the running skills that are not sources of the export."""
    folder = export.path.absolute().parent
    known = {each.path for each in export.sources}
    for file in sorted({path_from(folder, each) for each in files} - known):
        found = NotExported(path=export.file.path, source=file)
        yield found.at(Span(export.file, 0, 0))
