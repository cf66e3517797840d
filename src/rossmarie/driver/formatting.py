"""The formatter: rules files in canonical layout."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from dslkit.diagnostics import Collector, Diagnostic
from dslkit.source import SourceFile
from rossmarie.driver.shortened import shortened
from rossmarie.driver.workspace import read_source
from rossmarie.syntax import format_module, parse


@dataclass(frozen=True)
class Formatted:
    """The canonical text of a file, and whether it differs from the present text."""

    text: str
    has_changed: bool


def format_text(text: str) -> str:
    """Rules in canonical layout; the same text if it has syntax errors."""
    collector = Collector()
    module = parse(SourceFile("", text), collector)
    return text if collector.has_errors else format_module(module)


def format_file(path: Path) -> Formatted | tuple[Diagnostic, ...]:
    """The canonical text of a rules file; its findings instead if it cannot be parsed.

    Reads only. A file with syntax errors stays unchanged.
    """
    collector = Collector()
    source = read_source(path, collector)
    if source is None:
        return collector.sorted()
    module = parse(source, collector)
    if collector.has_errors:
        return shortened(collector.sorted())
    text = format_module(module)
    return Formatted(text, text != source.text)
