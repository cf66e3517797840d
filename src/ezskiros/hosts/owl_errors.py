"""EZS88x: ontologies that SkiROS2 cannot load, or reads differently from the checks."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class NoPrefix(Error, code="EZS884", name="no-prefix"):
    """A namespace for which SkiROS2 has no prefix."""

    title = "SkiROS2 has no prefix for the namespace {namespace}"
    label = "declared here"
    note = "SkiROS2 derives the prefix `hall` from http://example.org/hall.owl#; use this form"
    help = "end the namespace with a name and `#`"
    namespace: str


class PrefixTaken(Error, code="EZS885", name="prefix-taken"):
    """Two namespaces with the same SkiROS2 prefix."""

    title = "SkiROS2 uses the prefix `{prefix}` for two namespaces: {namespace} and {other}"
    label = "declared here"
    note = "SkiROS2 keeps one of them and cannot find names of the other"
    help = "rename a namespace; the prefix is the last part before `#`"
    prefix: str
    namespace: str
    other: str

    class Other(Remark):
        says = "the other namespace"


class FileNameTaken(Error, code="EZS886", name="file-name-taken"):
    """Two ontology files with the same generated name."""

    title = "two files of the ontology would be written to {file}"
    label = "the other file is {other}"
    note = "SkiROS2 identifies loaded files by their lower-case names"
    help = "rename one of the files"
    file: str
    other: str


class NotInXml(Error, code="EZS887", name="not-in-xml"):
    """A statement that cannot be written in RDF/XML, the format that SkiROS2 reads."""

    title = "RDF/XML cannot contain {statement}"
    label = "the statement is about this"
    note = "SkiROS2 only reads RDF/XML"
    help = "remove control characters, and use valid XML names for properties"
    statement: str


ALL: tuple[type[Template], ...] = (NoPrefix, PrefixTaken, FileNameTaken, NotInXml)
