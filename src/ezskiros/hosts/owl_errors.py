"""EZS88x: ontologies that SkiROS2 cannot load, or does not understand as the checks do."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class NoPrefix(Error, code="EZS884", name="no-prefix"):
    """A namespace that SkiROS2 has no prefix for."""

    title = "SkiROS2 has no prefix for the namespace {namespace}"
    label = "declared here"
    note = "SkiROS2 makes the prefix `hall` of http://example.org/hall.owl#, and of no other form"
    help = "let the namespace end with a name and `#`"
    namespace: str


class PrefixTaken(Error, code="EZS885", name="prefix-taken"):
    """Two namespaces that SkiROS2 calls the same."""

    title = "SkiROS2 calls two namespaces `{prefix}`: {namespace} and {other}"
    label = "declared here"
    note = "SkiROS2 keeps one of them, and does not find the names of the other"
    help = "rename a namespace; its prefix is the last part before `#`"
    prefix: str
    namespace: str
    other: str

    class Other(Remark):
        says = "the other one"


class FileNameTaken(Error, code="EZS886", name="file-name-taken"):
    """Two files of an ontology that would be one."""

    title = "two files of the ontology become {file}"
    label = "the other is {other}"
    note = "SkiROS2 keeps what it has loaded by the names of files, in lower case"
    help = "rename a file"
    file: str
    other: str


class NotInXml(Error, code="EZS887", name="not-in-xml"):
    """A statement that RDF/XML, the form that SkiROS2 reads, cannot hold."""

    title = "RDF/XML cannot hold {statement}"
    label = "said of this"
    note = "SkiROS2 reads RDF/XML"
    help = "leave out control characters, and let names of properties be words"
    statement: str


ALL: tuple[type[Template], ...] = (NoPrefix, PrefixTaken, FileNameTaken, NotInXml)
