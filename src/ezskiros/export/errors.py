"""EZS86x: the file of skills that other languages read."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class NoExport(Error, code="EZS860", name="no-export"):
    """A file that is no export of skills, or one of another version."""

    title = "`{path}` is no export of skills"
    label = "{reason}"
    help = "write it with `ezskiros export`"
    path: str
    reason: str


class StaleExport(Error, code="EZS861", name="stale-export"):
    """An export whose sources are not what they were."""

    title = "`{path}` is stale: `{source}` {reason}"
    help = "write it again with `ezskiros export`"
    path: str
    source: str
    reason: str


class NotExported(Error, code="EZS862", name="not-exported"):
    """A file of skills that run, or of their ontology, that the export was not made of."""

    title = "`{path}` was not made of `{source}`"
    label = "what runs is of this file as well"
    help = "name all files and the same ontology: `ezskiros export PATHS... -o {path}`"
    path: str
    source: str


class UnknownPropertyUnit(Error, code="EZS863", name="unknown-property-unit"):
    """A data property in a unit that nobody can convert."""

    title = "the unit of `{property}` is `{unit}`, which is no unit that is known"
    help = "use one of {units}"
    property: str
    unit: str
    units: str


class SameName(Error, code="EZS864", name="same-exported-name"):
    """Two things that a file of skills would call the same."""

    title = "there are two {kind} `{spelled}`"
    note = "rules know them by this name, and could mean either"
    help = "export them into two files, or give one of them another name"
    kind: str
    spelled: str

    class Other(Remark):
        says = "the other one"


class DeepTree(Error, code="EZS865", name="deep-exported-tree"):
    """A behavior tree that readers of a file of skills would not get to the end of."""

    title = "the behavior tree has more than {most} levels here"
    note = "not every program reads JSON that lies so deep in itself"
    help = "make a compound skill of a part of it"
    most: int


ALL: tuple[type[Template], ...] = (
    NoExport,
    StaleExport,
    NotExported,
    UnknownPropertyUnit,
    SameName,
    DeepTree,
)
