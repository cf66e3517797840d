"""Reading of files into triples: RDF/XML, Turtle, N-Triples and JSON-LD, with pyoxigraph."""

from __future__ import annotations

import errno
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from xml.parsers import expat

import pyoxigraph

from dslkit.diagnostics import Diagnostic
from dslkit.source import SourceFile, Span, ending, is_file, is_folder, shown
from ezskiros.ontology import errors
from ezskiros.ontology.limits import (
    LARGEST_FILE,
    LimitError,
    XmlDepth,
    check_text,
    within_limits,
)

Quad = pyoxigraph.Quad
FORMATS = {
    ".owl": pyoxigraph.RdfFormat.RDF_XML,
    ".rdf": pyoxigraph.RdfFormat.RDF_XML,
    ".xml": pyoxigraph.RdfFormat.RDF_XML,
    ".ttl": pyoxigraph.RdfFormat.TURTLE,
    ".turtle": pyoxigraph.RdfFormat.TURTLE,
    ".nt": pyoxigraph.RdfFormat.N_TRIPLES,
    ".jsonld": pyoxigraph.RdfFormat.JSON_LD,
    ".json": pyoxigraph.RdfFormat.JSON_LD,
}
SEARCHED = (".owl", ".rdf", ".ttl", ".nt", ".jsonld")
"""The endings of files that are taken from folders. SkiROS2's scenes (`.turtle`) are not a part of
the ontology.
"""

_PLACE = re.compile(
    r" ?at line \d+ (column \d+|between columns \d+ and (line \d+ column )?\d+)|^Parser error:?"
)


@dataclass(frozen=True)
class Document:
    """One file: its triples, and its declared prefixes."""

    file: SourceFile
    triples: Sequence[Quad]
    prefixes: dict[str, str]
    base: str | None


def find(paths: Iterable[Path]) -> list[Path]:
    """The files in some files and folders, including subfolders, in a fixed order.

    Raises `FileNotFoundError` for a path that does not exist.
    """
    found: dict[Path, None] = {}
    for path in paths:
        if is_folder(path):
            inside = (each for each in path.rglob("*") if each.suffix.lower() in SEARCHED)
            found.update(dict.fromkeys(sorted(filter(is_file, inside))))
        elif is_file(path):
            found[path] = None
        else:
            raise FileNotFoundError(errno.ENOENT, "it does not exist", str(path))
    return list(found)


def read(path: Path) -> tuple[Document | None, list[Diagnostic]]:
    """The triples of a file, or the findings.

    Raises `OSError` if the file cannot be read at all.
    """
    kind = FORMATS.get(ending(path))
    if kind is None:
        nowhere = Span(SourceFile(shown(str(path)), ""), 0, 0)
        return None, [errors.UnknownFormat(suffix=_suffix(path)).at(nowhere)]
    with path.open("rb") as opened:
        content = opened.read(LARGEST_FILE + 1)
    if len(content) > LARGEST_FILE:
        too_large = errors.BeyondLimit(reason=f"it is larger than {LARGEST_FILE >> 20} MiB")
        return None, [too_large.at(Span(SourceFile(shown(str(path)), ""), 0, 0))]
    file = SourceFile(shown(str(path)), content.decode("utf-8", "replace"))
    try:
        return _parsed(file, content, kind, path.resolve().as_uri()), []
    except LimitError as problem:
        return None, [errors.BeyondLimit(reason=problem.reason).at(_rest_of_line(file, problem.at))]
    except (SyntaxError, ValueError) as problem:
        return None, [_syntax_error(file, content, kind, problem)]
    except expat.ExpatError as problem:
        said = expat.errors.messages[problem.code]
        span = _span(file, problem.lineno, problem.offset + 1)
        return None, [errors.BrokenFile(format=kind.name, said=said).at(span)]


def _parsed(file: SourceFile, content: bytes, kind: pyoxigraph.RdfFormat, base: str) -> Document:
    """Parse a file. Raises `LimitError`, `ExpatError`, or an exception of pyoxigraph."""
    check_text(file.text, kind)
    is_xml = kind is pyoxigraph.RdfFormat.RDF_XML
    prefixes, written = _xml_header(content) if is_xml else ({}, None)
    parser = pyoxigraph.parse(content, format=kind, base_iri=base)
    triples = within_limits(parser)
    if not is_xml:
        prefixes, written = dict(parser.prefixes), parser.base_iri
    return Document(file, triples, prefixes, written or base)


def _xml_header(content: bytes) -> tuple[dict[str, str], str | None]:
    """The prefixes and the base of the first element, which pyoxigraph does not report.

    Raises `ExpatError` with the place of malformed XML, which pyoxigraph does not report either,
    and `LimitError`.
    """
    parser = expat.ParserCreate()
    depth = XmlDepth(parser)
    parser.Parse(content, True)
    attributes = depth.root or {}
    prefixes = {
        name.partition(":")[2]: iri for name, iri in attributes.items() if name.startswith("xmlns")
    }
    return prefixes, attributes.get("xml:base")


def _suffix(path: Path) -> str:
    found = ending(path)
    return f"the ending `{found}`" if found else "no ending"


def _syntax_error(
    file: SourceFile, content: bytes, kind: pyoxigraph.RdfFormat, problem: Exception
) -> Diagnostic:
    """The finding for an error of the parser, at its place. For XML the parser does not give the
    place.
    """
    line, column = getattr(problem, "lineno", None), getattr(problem, "offset", None)
    said = _PLACE.sub("", str(getattr(problem, "msg", problem))).strip(" :")
    if kind is pyoxigraph.RdfFormat.RDF_XML:
        line, column = _unknown_prefix(content)
    span = _span(file, line or 1, column or 1)
    return errors.BrokenFile(format=kind.name, said=said).at(span)


def _unknown_prefix(content: bytes) -> tuple[int, int]:
    """The place of an undeclared prefix in well-formed XML; the beginning of the file if there is
    none.
    """
    parser = expat.ParserCreate(namespace_separator=" ")
    try:
        parser.Parse(content, True)
    except expat.ExpatError as problem:
        return problem.lineno, problem.offset + 1
    return 1, 1


def _span(file: SourceFile, line: int, column: int) -> Span:
    """The span from a place to the end of its line."""
    line = min(line, len(file.line_starts))
    start = min(file.line_starts[line - 1] + column - 1, len(file.text))
    end = file.line_starts[line - 1] + len(file.line_text(line))
    return Span(file, start, max(start, end))


def _rest_of_line(file: SourceFile, start: int) -> Span:
    """The span from an offset to the end of its line."""
    at = file.position(min(start, len(file.text)))
    return _span(file, at.line, at.column)
