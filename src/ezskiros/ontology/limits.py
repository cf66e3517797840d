"""Limits of files with ontologies and scenes, so that no small file costs gigabytes or minutes.

Constructs that would use up the memory or the stack of a parser are found before the parser reads
them. The page docs/reference/limits.md lists these limits.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from xml.parsers import expat

import pyoxigraph

LARGEST_FILE = 64 << 20
"""The most bytes of one file."""
DEEPEST = 200
"""The greatest nesting depth of elements, objects, lists and triple terms."""
MOST_NAMESPACES = 200
"""The most namespaces that are in scope at one element."""
MOST_TRIPLES = 1_000_000
"""The most triples of one file."""
LONGEST_TEXT = 128 << 20
"""The most characters of all triples with full IRIs, because a short prefix may stand for a long
IRI.
"""

_ENTITY = re.compile(r"<!ENTITY")
_PLAIN_ENTITY = re.compile(r"""<!ENTITY\s+([^\s%&"']+)\s+(?:"([^"%&<]*)"|'([^'%&<]*)')\s*>""")
_REFERENCE = re.compile(r"&([^\s;&<]+);")
_JSON_BRACKET = re.compile(r'"(?:[^"\\]|\\.)*"|([\[{])|([\]}])', re.DOTALL)
_TRIPLE_TERM = re.compile(r"(<<\()|(\)>>)")


class LimitError(Exception):
    """A file exceeds a limit at an offset of its text."""

    def __init__(self, reason: str, at: int = 0) -> None:
        self.reason, self.at = reason, at
        super().__init__(reason)


def check_text(text: str, kind: pyoxigraph.RdfFormat) -> None:
    """Raise `LimitError` for text that would cost a parser too much."""
    if kind is pyoxigraph.RdfFormat.RDF_XML:
        _check_entities(text)
    elif kind is pyoxigraph.RdfFormat.JSON_LD:
        _check_depth(text, _JSON_BRACKET, "objects and lists")
    else:
        _check_depth(text, _TRIPLE_TERM, "triple terms")


def _check_entities(text: str) -> None:
    """Check that entities are plain texts, as in OWL files, and not longer than `LONGEST_TEXT` in
    all.

    pyoxigraph also reads declarations in comments. Therefore the text itself is searched; an XML
    parser would not find these.
    """
    lengths: dict[str, int] = {}
    for declared in _ENTITY.finditer(text):
        plain = _PLAIN_ENTITY.match(text, declared.start())
        if plain is None:
            reason = "an entity is not a plain quoted string"
            raise LimitError(reason, declared.start())
        name, *values = plain.groups(default="")
        lengths[name] = max(map(len, values))
    written = 0
    for reference in _REFERENCE.finditer(text) if lengths else ():
        written += lengths.get(reference[1], 0)
        if written > LONGEST_TEXT:
            reason = f"with its entities it is longer than {LONGEST_TEXT >> 20} MiB"
            raise LimitError(reason, reference.start())


def _check_depth(text: str, bracket: re.Pattern[str], what: str) -> None:
    depth = 0
    for found in bracket.finditer(text):
        opening, closing = found.groups()
        depth += bool(opening) - bool(closing)
        if depth > DEEPEST:
            raise LimitError(f"more than {DEEPEST} {what} are nested", found.start())


class XmlDepth:
    """Follows the elements of an XML parser, up to the first one that exceeds a limit."""

    def __init__(self, parser: expat.XMLParserType) -> None:
        self._parser = parser
        self._namespaces: list[int] = []
        parser.StartElementHandler = self._begin
        parser.EndElementHandler = self._end
        self.root: dict[str, str] | None = None
        """The attributes of the first element."""

    def _begin(self, _: str, attributes: dict[str, str]) -> None:
        if self.root is None:
            self.root = attributes
        before = self._namespaces[-1] if self._namespaces else 0
        self._namespaces.append(before + sum(name.startswith("xmlns") for name in attributes))
        if len(self._namespaces) > DEEPEST:
            self._refuse(f"more than {DEEPEST} elements are nested")
        if self._namespaces[-1] > MOST_NAMESPACES:
            self._refuse(f"an element has more than {MOST_NAMESPACES} namespaces")

    def _end(self, _: str) -> None:
        self._namespaces.pop()

    def _refuse(self, reason: str) -> None:
        raise LimitError(reason, self._parser.CurrentByteIndex)


def within_limits(triples: Iterable[pyoxigraph.Quad]) -> list[pyoxigraph.Quad]:
    """The triples. Raises `LimitError` before there are too many or too long ones."""
    kept: list[pyoxigraph.Quad] = []
    length = 0
    for triple in triples:
        length += sum(map(_length, (triple.subject, triple.predicate, triple.object)))
        if len(kept) == MOST_TRIPLES:
            raise LimitError(f"it has more than {MOST_TRIPLES} triples")
        if length > LONGEST_TEXT:
            reason = f"with its names in full it is longer than {LONGEST_TEXT >> 20} MiB"
            raise LimitError(f"{reason} from the {len(kept) + 1}th triple on")
        kept.append(triple)
    return kept


def _length(term: object) -> int:
    if isinstance(term, pyoxigraph.Triple):
        return len(str(term))
    length = len(getattr(term, "value", ""))
    return length + (len(term.datatype.value) if isinstance(term, pyoxigraph.Literal) else 0)
