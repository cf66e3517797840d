"""An ontology as RDF/XML files in which SkiROS2 finds its prefixes.

SkiROS2 derives the prefix of a namespace from the ontology IRI that a file declares. A file
replaces an earlier loaded file with the same name, so no file here may have the name of a file of
SkiROS2.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any
from xml.parsers import expat

import pyoxigraph

from dslkit.diagnostics import Diagnostic
from dslkit.source import Span
from ezskiros.hosts import owl_errors as errors
from ezskiros.ontology import Ontology
from ezskiros.ontology.iris import OWL, RDF, RDFS, RESERVED, XSD, split, stem
from ezskiros.ontology.places import declaration
from ezskiros.ontology.read import Document

MARK = "Written by `ezskiros owl`. Change the ontology instead."
START = "ezskiros-"
"""The beginning of the file names. No file of SkiROS2 has it."""

_XML = pyoxigraph.RdfFormat.RDF_XML
_IEEE = "http://www.inf.ufrgs.br/phi-group/ontologies/"
_OF_SKIROS2 = {
    "skiros": "http://rvmi.aau.dk/ontologies/skiros.owl#",
    **{each.lower(): f"{_IEEE}{each}.owl#" for each in ("cora", "coraX", "RParts", "sumo")},
}
"""The namespaces of SkiROS2's own ontology, by its prefixes."""
_LANGUAGE = {"owl": OWL, "rdf": RDF, "rdfs": RDFS, "xsd": XSD}
_NAME = re.compile(r"[a-z_][\w.-]*", re.ASCII)
_TYPE = pyoxigraph.NamedNode(RDF + "type")
_ONTOLOGY = pyoxigraph.NamedNode(OWL + "Ontology")
_RELATION = pyoxigraph.NamedNode(OWL + "ObjectProperty")

Triples = Sequence[pyoxigraph.Triple]


def owl_files(ontology: Ontology) -> tuple[dict[str, str], list[Diagnostic]]:
    """The texts of the files by name, and the findings. After an error there are no texts."""
    found = [*_prefix_findings(ontology), *_name_findings(ontology.documents)]
    for document in ontology.documents:
        found += _triple_findings(document)
    if found:
        return {}, found
    prefixes = {name: start for name, start in ontology.model.names.items() if _NAME.match(name)}
    relations = ontology.model.relations
    files = {
        file_name(document): _text(_triples(document, prefixes, relations), prefixes)
        for document in ontology.documents
    }
    for name, start in _unnamed(ontology):
        header = pyoxigraph.Triple(pyoxigraph.NamedNode(start[:-1]), _TYPE, _ONTOLOGY)
        files[f"{START}{name}-namespace.owl"] = _text([header], prefixes)
    return files, []


def file_name(document: Document) -> str:
    """The name of the file of a document."""
    return f"{START}{Path(document.file.path).stem}.owl"


# --- content for SkiROS2 --------------------------------------------------------------------------


def _triples(document: Document, prefixes: Mapping[str, str], relations: Iterable[str]) -> Triples:
    """The triples of a document in the form that SkiROS2 understands.

    SkiROS2 knows relations only as owl:ObjectProperty. The IRI of an ontology must not take the
    prefix of another namespace.
    """
    said = _with_fixed_names([each.triple for each in document.triples])
    kept = [each for each in said if not _is_misleading(each, prefixes)]
    known = {each.subject for each in said if (each.predicate, each.object) == (_TYPE, _RELATION)}
    wanted = set(map(pyoxigraph.NamedNode, relations)) - known
    typed = dict.fromkeys(each.subject for each in said if each.predicate == _TYPE)
    return [*kept, *(pyoxigraph.Triple(each, _TYPE, _RELATION) for each in typed if each in wanted)]


def _with_fixed_names(triples: Triples) -> Triples:
    """Triples with the same names of blank nodes each time that they are read."""
    names: dict[pyoxigraph.BlankNode, pyoxigraph.BlankNode] = {}

    def fixed(term: Any) -> Any:
        if not isinstance(term, pyoxigraph.BlankNode):
            return term
        return names.setdefault(term, pyoxigraph.BlankNode(f"b{len(names)}"))

    return [
        pyoxigraph.Triple(fixed(each.subject), each.predicate, fixed(each.object))
        for each in triples
    ]


def _is_misleading(triple: pyoxigraph.Triple, prefixes: Mapping[str, str]) -> bool:
    iri = _declared(triple)
    return iri is not None and prefixes.get(stem(iri), f"{iri}#") != f"{iri}#"


def _declared(triple: pyoxigraph.Triple) -> str | None:
    """The IRI of the ontology that a triple declares."""
    is_header = (triple.predicate, triple.object) == (_TYPE, _ONTOLOGY)
    subject = triple.subject
    return subject.value if is_header and isinstance(subject, pyoxigraph.NamedNode) else None


def _unnamed(ontology: Ontology) -> Iterator[tuple[str, str]]:
    """The namespaces without an ontology file, by name. If a file has several ontologies, SkiROS2
    uses one.
    """
    named = set()
    for document in ontology.documents:
        declared = {iri for each in document.triples if (iri := _declared(each.triple))}
        named |= {f"{iri}#" for iri in declared if len(declared) == 1}
    for name, start in ontology.model.names.items():
        if start not in named:
            yield name, start


# --- findings -------------------------------------------------------------------------------------


def _prefix_findings(ontology: Ontology) -> Iterator[Diagnostic]:
    """Findings for namespaces that SkiROS2 cannot distinguish by prefix."""
    taken: dict[str, str] = dict(_OF_SKIROS2)
    firsts: dict[str, str] = {}
    for iri in ontology.model.entities():
        firsts.setdefault(split(iri)[0], iri)
    for start, iri in sorted(firsts.items()):
        if start.startswith(RESERVED):
            continue
        name, place = stem(start), _place(ontology.documents, iri)
        if not start.endswith("#") or start[-2:-1] == "/" or not _NAME.fullmatch(name):
            yield errors.NoPrefix(namespace=start or iri).at(place)
            continue
        other = taken.setdefault(name, start)
        if other != start:
            others = [firsts[other]] if other in firsts else []
            found = errors.PrefixTaken(prefix=name, namespace=start, other=other)
            labels = [found.Other().at(_place(ontology.documents, each)) for each in others]
            yield found.at(place, *labels)


def _name_findings(documents: Iterable[Document]) -> Iterator[Diagnostic]:
    """Findings for files that SkiROS2 would treat as one."""
    seen: dict[str, Document] = {}
    for document in documents:
        name = file_name(document)
        other = seen.setdefault(name.lower(), document)
        if other is not document:
            found = errors.FileNameTaken(file=name, other=other.file.path)
            yield found.at(Span(document.file, 0, 0))


def _triple_findings(document: Document) -> Iterator[Diagnostic]:
    """Findings for triples that differ after they are written and read again. If all triples
    together are equal, no single triple is examined.
    """
    triples = [each.triple for each in document.triples]
    if _is_kept(triples):
        return
    for triple in triples:
        if not _is_kept([triple]):
            found = errors.NotInXml(statement=str(triple).encode("unicode_escape").decode())
            yield found.at(_place([document], getattr(triple.subject, "value", "")))


def _is_kept(triples: Triples) -> bool:
    text = _serialized(triples, {})
    try:
        expat.ParserCreate().Parse(text, True)
        again = [each.triple for each in pyoxigraph.parse(text, format=_XML)]
    except (expat.ExpatError, SyntaxError, ValueError):
        return False
    return Counter(map(_without_names, triples)) == Counter(map(_without_names, again))


def _without_names(triple: pyoxigraph.Triple) -> tuple[object, ...]:
    """A triple with one name for all blank nodes. Triple terms are never kept."""
    terms = (triple.subject, triple.predicate, triple.object)
    if isinstance(triple.object, pyoxigraph.Triple):
        return (object(),)
    return tuple(None if isinstance(each, pyoxigraph.BlankNode) else each for each in terms)


def _place(documents: Sequence[Document], iri: str) -> Span:
    return declaration(documents, iri) or Span(documents[0].file, 0, 0)


# --- text -----------------------------------------------------------------------------------------


def _text(triples: Triples, prefixes: Mapping[str, str]) -> str:
    text = _serialized(triples, {**prefixes, **_LANGUAGE}).decode()
    head, _, rest = text.partition("\n")
    return f"{head}\n<!-- {MARK} -->\n{rest}\n"


def _serialized(triples: Triples, prefixes: Mapping[str, str]) -> bytes:
    return pyoxigraph.serialize(triples, format=_XML, prefixes=dict(prefixes)) or b""
