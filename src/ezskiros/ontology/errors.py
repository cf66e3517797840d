"""EZS1xx: ontology files and the names in them."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class UnknownFormat(Error, code="EZS101", name="unknown-format"):
    """A file whose name has no known suffix."""

    title = "the format of this file is unknown: its name has {suffix}"
    help = "use .owl, .rdf or .xml for RDF/XML, .ttl or .turtle for Turtle, .jsonld for JSON-LD"
    suffix: str


class BrokenFile(Error, code="EZS102", name="broken-file"):
    """A file with a syntax error."""

    title = "this is not valid {format}: {said}"
    note = "the remaining checks ignore this file"
    format: str
    said: str


class NoSuchFile(Error, code="EZS105", name="no-such-file"):
    """An ontology path that does not exist or cannot be read."""

    title = "the ontology {path} cannot be read: {reason}"
    label = "loaded here"
    help = "the path is relative to the current folder; `--ontology DIR` gives another folder"
    path: str
    reason: str


class NoOntology(Error, code="EZS103", name="no-ontology"):
    """RDF that declares neither a class nor a property."""

    title = "this file declares neither a class nor a property"
    help = "declare them as owl:Class, owl:ObjectProperty or owl:DatatypeProperty"


class MissingImport(Warning, code="EZS104", name="missing-import"):
    """An imported ontology that is not among the loaded files."""

    title = "no loaded file contains the imported ontology {iri}"
    label = "imported here"
    help = "add the file of {iri}; imports are not downloaded"
    iri: str


class NothingLoaded(Error, code="EZS106", name="nothing-loaded"):
    """No ontology file: no path, or only folders without ontology files."""

    title = "no ontology is loaded: {reason}"
    label = "loaded here"
    help = "give the path by `--ontology PATH`, by EZSKIROS_ONTOLOGY, or in the code: `load(PATH)`"
    reason: str


class BeyondLimit(Error, code="EZS107", name="beyond-limit"):
    """A file that exceeds a limit on memory or time."""

    title = "this file exceeds a limit: {reason}"
    note = "the remaining checks ignore this file"
    help = "simplify or split the file; docs/reference/limits.md lists the limits"
    reason: str


class UnknownNamespace(Error, code="EZS110", name="unknown-namespace"):
    """A namespace that the ontology does not have."""

    title = "the ontology has no namespace `{spelled}`"
    label = "no loaded file declares a name in this namespace"
    spelled: str

    class Use(Remark):
        says = "used here"

    class Known(Remark):
        says = "the namespaces are {known}"
        known: str


class UnknownName(Error, code="EZS111", name="unknown-name"):
    """A class or individual that its namespace does not have."""

    title = "`{namespace}` has no class `{spelled}`"
    label = "not in the ontology"
    namespace: str
    spelled: str

    class OtherNamespace(Remark):
        says = "another namespace has this name: write `{meant}`"
        meant: str


ALL: tuple[type[Template], ...] = (
    UnknownFormat,
    BrokenFile,
    NoSuchFile,
    NoOntology,
    MissingImport,
    NothingLoaded,
    BeyondLimit,
    UnknownNamespace,
    UnknownName,
)
