"""Conversion of spans to places in the export: paths relative to its folder, lines and columns from
1.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from dslkit.source import SourceFile, Span, is_file
from ezskiros.export.sources import path_from


class ExportPlaces:
    """The places for an export in a folder. `files` are the files with a place."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._paths: dict[str, str | None] = {}
        self.files: set[Path] = set()

    def of(self, span: Span | None) -> dict[str, Any] | None:
        """The place of a span; None if the span is not in a file, as for generated code."""
        path = self._path(span.file) if span is not None else None
        if span is None or path is None:
            return None
        begin, finish = span.begin, span.finish
        return {
            "path": path,
            "line": begin.line,
            "column": begin.column,
            "end_line": finish.line,
            "end_column": finish.column,
        }

    def _path(self, file: SourceFile) -> str | None:
        if file.path not in self._paths:
            known = Path(file.path)
            is_there = is_file(known)
            self._paths[file.path] = path_from(self._folder, known) if is_there else None
            self.files |= {known.absolute()} if is_there else set()
        return self._paths[file.path]
