"""Reading of files and folders into an `Ontology`, with findings."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from functools import lru_cache
from importlib.resources import files
from pathlib import Path

import pyoxigraph

from dslkit.diagnostics import Diagnostic, Severity
from dslkit.source import SourceFile, Span
from ezskiros import session
from ezskiros.ontology import errors
from ezskiros.ontology.iris import OWL, RDF
from ezskiros.ontology.read import Document, find, read
from ezskiros.ontology.world import Ontology

VARIABLE = "EZSKIROS_ONTOLOGY"
"""The variable with the files and folders of the ontology, separated like those of PATH."""

_MOST_LOADED = 16
"""The most ontologies in the cache. An editor loads another one after each change of a file."""

_IMPORTS = pyoxigraph.NamedNode(OWL + "imports")
_TYPE = RDF + "type"
_PROPERTIES = (
    "Functional",
    "InverseFunctional",
    "Symmetric",
    "Asymmetric",
    "Transitive",
    "Irreflexive",
)
_DECLARED = {OWL + kind for kind in ("Class", "ObjectProperty", "DatatypeProperty")}
_DECLARED |= {f"{OWL}{kind}Property" for kind in _PROPERTIES}
_NOTHING = Ontology((), is_whole=False)


def load(*paths: str | os.PathLike[str], relations: bool = True) -> Ontology:
    """The ontology of some files and folders; without arguments, that of the variable
    EZSKIROS_ONTOLOGY.

    `relations` adds the domains and ranges of SkiROS2's own relations, which its ontology does not
    declare. The same files are loaded once. Raises `SkillError` for files that cannot be read; if
    findings are collected, it continues without them.
    """
    ontology, wrong = _read(
        tuple(Path(path) for path in paths) or _named(), session.here, relations
    )
    for diagnostic in wrong:
        session.report(diagnostic)
    return ontology


def load_named() -> tuple[Ontology | None, Sequence[Diagnostic]]:
    """The ontology of the variable EZSKIROS_ONTOLOGY, or None if the variable is empty; and the
    findings.
    """
    named = _named()
    return _read(named, lambda: Span(SourceFile(VARIABLE, ""), 0, 0)) if named else (None, ())


def _named() -> tuple[Path, ...]:
    return tuple(Path(part) for part in os.environ.get(VARIABLE, "").split(os.pathsep) if part)


def _read(
    named: tuple[Path, ...], here: Callable[[], Span], relations: bool = True
) -> tuple[Ontology, Sequence[Diagnostic]]:
    """The ontology of files and folders that were named at `here`, and the findings."""
    try:
        found = find(named)
        states = tuple((path, path.stat().st_mtime_ns, path.stat().st_size) for path in found)
        ontology, wrong = _loaded(states, relations)
    except OSError as problem:
        path, reason = str(problem.filename), (problem.strerror or "it does not exist").lower()
        return _NOTHING, [errors.NoSuchFile(path=path, reason=reason).at(here())]
    if not found:
        shown = ", ".join(map(str, named))
        reason = f"no ontology file in {shown}" if named else "no path is given"
        return _NOTHING, [errors.NothingLoaded(reason=reason).at(here())]
    return ontology, wrong


@lru_cache(maxsize=_MOST_LOADED)
def _loaded(
    states: tuple[tuple[Path, int, int], ...], relations: bool
) -> tuple[Ontology, tuple[Diagnostic, ...]]:
    """The ontology of files in their current states. `states` show changes of the files."""
    documents, wrong = [], []
    for path, _, _ in states:
        document, found = read(path)
        documents += [document] if document else []
        wrong += found
    wrong += _empty(documents)
    is_whole = not any(each.severity is Severity.ERROR for each in wrong)
    wrong += _missing_imports(documents)
    documents += [core_relations()] if relations else []
    return Ontology(documents, is_whole=is_whole), tuple(wrong)


def core_relations() -> Document:
    """Domains and ranges of the relations of SkiROS2's own ontology."""
    path = files("ezskiros.ontology") / "skiros_relations.ttl"
    document, wrong = read(Path(str(path)))
    assert document is not None, wrong
    return document


def _empty(documents: Iterable[Document]) -> Iterable[Diagnostic]:
    """A finding if no file declares anything."""
    documents = list(documents)
    for document in documents:
        for triple in document.triples:
            if triple.predicate.value == _TYPE and str(triple.object).strip("<>") in _DECLARED:
                return
    if documents:
        yield errors.NoOntology().at(Span(documents[0].file, 0, 0))


def _missing_imports(documents: list[Document]) -> Iterable[Diagnostic]:
    """Findings for imports of other files, by the IRI of an ontology or by the name of its file."""
    own = {triple.subject for each in documents for triple in each.triples}
    stems = {Path(each.file.path).stem.lower() for each in documents}
    for document in documents:
        for triple in document.triples:
            if triple.predicate != _IMPORTS:
                continue
            iri = str(triple.object).strip("<>")
            stem = iri.rstrip("#/").rpartition("/")[2].partition(".")[0].lower()
            if triple.object not in own and stem not in stems:
                start = max(document.file.text.find(iri), 0)
                span = Span(document.file, start, start + len(iri))
                yield errors.MissingImport(iri=iri).at(span)
