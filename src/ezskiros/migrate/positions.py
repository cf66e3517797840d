"""The positions of the parts of a module in its file."""

from __future__ import annotations

from collections.abc import Mapping

import libcst as cst
from libcst.metadata import CodePosition, CodeRange, MetadataWrapper, PositionProvider

from dslkit.source import SourceFile, Span
from ezskiros.migrate.tree_context import PartPosition


class Positions:
    """The positions of all parts of a module."""

    def __init__(self, file: SourceFile, module: cst.Module) -> None:
        wrapper = MetadataWrapper(module, unsafe_skip_copy=True)
        self._file, self._step = file, module.default_indent
        self._places: Mapping[cst.CSTNode, CodeRange] = wrapper.resolve(PositionProvider)

    def span(self, node: cst.CSTNode) -> Span:
        """The span of a part, for findings."""
        place = self._places[node]
        return Span(self._file, self._offset(place.start), self._offset(place.end))

    def _offset(self, place: CodePosition) -> int:
        line, column = place.line, place.column
        return min(self._file.line_starts[line - 1] + column, len(self._file.text))

    def place(self, node: cst.CSTNode) -> PartPosition:
        """The column of a part, and the indentation of its line."""
        start = self._places[node].start
        line = self._file.line_text(start.line)
        return PartPosition(start.column, line[: len(line) - len(line.lstrip())])

    def indents(self, function: cst.FunctionDef) -> tuple[str, str]:
        """The indentation of a method, and the indentation step of the file."""
        return self.place(function.name).indent, self._step
