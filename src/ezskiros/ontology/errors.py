"""EZS1xx: files of ontologies, and names in them."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class UnknownFormat(Error, code="EZS101", name="unknown-format"):
    """A file whose name does not say what it is."""

    title = "how this file is written is not known: its name has {suffix}"
    help = "RDF/XML is .owl, .rdf or .xml, Turtle .ttl or .turtle, JSON-LD .jsonld or .json"
    suffix: str


class BrokenFile(Error, code="EZS102", name="broken-file"):
    """A file that does not parse."""

    title = "this is not {format}: {said}"
    note = "nothing of this file is known to the checks that follow"
    format: str
    said: str


class NoSuchFile(Error, code="EZS105", name="no-such-file"):
    """A path of an ontology that leads nowhere, or cannot be read."""

    title = "the ontology {path} cannot be read: {reason}"
    label = "loaded here"
    help = "paths are those of the folder that the command runs in; `--ontology DIR` names another"
    path: str
    reason: str


class NoOntology(Error, code="EZS103", name="no-ontology"):
    """RDF in which no class and no property is declared."""

    title = "no class and no property is declared here"
    help = "declare them as owl:Class, owl:ObjectProperty or owl:DatatypeProperty"


class MissingImport(Warning, code="EZS104", name="missing-import"):
    """An imported ontology that none of the files is."""

    title = "the import {iri} is none of the files that are loaded"
    label = "imported here"
    help = "add its file; nothing is fetched from the network"
    iri: str


class NothingLoaded(Error, code="EZS106", name="nothing-loaded"):
    """No file of an ontology: no path, or folders without one."""

    title = "no ontology is loaded: {reason}"
    label = "loaded here"
    help = "name it by `--ontology PATH`, by EZSKIROS_ONTOLOGY, or in the code: `load(PATH)`"
    reason: str


class BeyondLimit(Error, code="EZS107", name="beyond-limit"):
    """A file that would cost more memory or time than a file of this kind may."""

    title = "this file is beyond a limit: {reason}"
    note = "nothing of this file is known to the checks that follow"
    help = "write the file plainly, or split it; docs/reference/limits.md lists the limits"
    reason: str


class UnknownNamespace(Error, code="EZS110", name="unknown-namespace"):
    """A namespace that the ontology does not have."""

    title = "there is no namespace `{spelled}`"
    label = "no file declares anything in it"
    spelled: str

    class Use(Remark):
        says = "used here"

    class Known(Remark):
        says = "there are {known}"
        known: str


class UnknownName(Error, code="EZS111", name="unknown-name"):
    """A class or individual that its namespace does not have."""

    title = "`{namespace}` has no class `{spelled}`"
    label = "not in the ontology"
    namespace: str
    spelled: str

    class OtherNamespace(Remark):
        says = "it is in another namespace: write `{meant}`"
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
