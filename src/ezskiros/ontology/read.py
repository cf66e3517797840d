"""Files in, triples out: RDF/XML, Turtle, N-Triples and JSON-LD, read by pyoxigraph."""

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
"""What is taken from folders: SkiROS2's scenes are `.turtle`, and are no part of the ontology."""

_CHUNK = 10_000
"""Bytes of XML that are looked at for its first element, until that is found."""
_PLACE = re.compile(
    r" ?at line \d+ (column \d+|between columns \d+ and (line \d+ column )?\d+)|^Parser error:?"
)


@dataclass(frozen=True)
class Document:
    """One file: its triples, and the prefixes that it declares."""

    file: SourceFile
    triples: Sequence[Quad]
    prefixes: dict[str, str]
    base: str | None


def find(paths: Iterable[Path]) -> list[Path]:
    """The files among some files and folders (with all that is in them), in a fixed order.

    Raises `FileNotFoundError` for a path that leads nowhere.
    """
    found: dict[Path, None] = {}
    for path in paths:
        if is_folder(path):
            inside = (each for each in path.rglob("*") if each.suffix.lower() in SEARCHED)
            found.update(dict.fromkeys(sorted(filter(is_file, inside))))
        elif is_file(path):
            found[path] = None
        else:
            raise FileNotFoundError(errno.ENOENT, "there is no such file", str(path))
    return list(found)


def read(path: Path) -> tuple[Document | None, list[Diagnostic]]:
    """The triples of a file, or what is wrong with it.

    Raises `OSError` if it cannot be read at all.
    """
    kind = FORMATS.get(ending(path))
    content = path.read_bytes()
    if kind is None:
        nowhere = Span(SourceFile(shown(str(path)), ""), 0, 0)
        return None, [errors.UnknownFormat(suffix=_suffix(path)).at(nowhere)]
    file = SourceFile(shown(str(path)), content.decode("utf-8", "replace"))
    base = path.resolve().as_uri()
    try:
        parser = pyoxigraph.parse(content, format=kind, base_iri=base)
        triples = list(parser)
        prefixes, written = dict(parser.prefixes), parser.base_iri
        if kind is pyoxigraph.RdfFormat.RDF_XML:
            prefixes, written = _xml_header(content)
    except (SyntaxError, ValueError, expat.ExpatError) as problem:
        return None, [_syntax_error(file, content, kind, problem)]
    return Document(file, triples, prefixes, written or base), []


def _xml_header(content: bytes) -> tuple[dict[str, str], str | None]:
    """The prefixes and the base that the first element declares; pyoxigraph does not tell them."""
    found: list[dict[str, str]] = []
    parser = expat.ParserCreate()
    parser.StartElementHandler = lambda _, attributes: found.append(attributes)
    for start in range(0, len(content), _CHUNK):
        parser.Parse(content[start : start + _CHUNK])
        if found:
            break
    else:
        parser.Parse(b"", True)  # a file without elements, which pyoxigraph takes, is no XML
    attributes = found[0]
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
    """What the parser says, at its place; of XML it does not know the place."""
    line, column = getattr(problem, "lineno", None), getattr(problem, "offset", None)
    said = _PLACE.sub("", str(getattr(problem, "msg", problem))).strip(" :")
    if kind is pyoxigraph.RdfFormat.RDF_XML:
        line, column, xml_said = _xml_error(content)
        said = xml_said or said
    span = _span(file, line or 1, column or 1)
    return errors.BrokenFile(format=kind.name, said=said).at(span)


def _xml_error(content: bytes) -> tuple[int | None, int, str]:
    """Where XML is not well-formed, and why."""
    parser = expat.ParserCreate(namespace_separator=" ")
    try:
        parser.Parse(content, True)
    except expat.ExpatError as problem:
        return problem.lineno, problem.offset + 1, expat.errors.messages[problem.code]
    return None, 1, ""


def _span(file: SourceFile, line: int, column: int) -> Span:
    """From a place to the end of its line."""
    line = min(line, len(file.line_starts))
    start = min(file.line_starts[line - 1] + column - 1, len(file.text))
    end = file.line_starts[line - 1] + len(file.line_text(line))
    return Span(file, start, max(start, end))
