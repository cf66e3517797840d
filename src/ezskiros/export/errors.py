"""EZS86x: the exported skills file, which other tools read."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class NoExport(Error, code="EZS860", name="no-export"):
    """A file that is not an export of skills, or has another version."""

    title = "`{path}` is not an export of skills"
    label = "{reason}"
    help = "create the file with `ezskiros export`"
    path: str
    reason: str


class StaleExport(Error, code="EZS861", name="stale-export"):
    """An export whose sources have changed."""

    title = "`{path}` is stale: `{source}` {reason}"
    help = "create the file again with `ezskiros export`"
    path: str
    source: str
    reason: str


class NotExported(Error, code="EZS862", name="not-exported"):
    """A source of the running skills or their ontology that is not part of the export."""

    title = "`{path}` does not include `{source}`"
    label = "running skills or their ontology come from this file"
    help = "export all files with the same ontology: `ezskiros export PATHS... -o {path}`"
    path: str
    source: str


class UnknownPropertyUnit(Error, code="EZS863", name="unknown-property-unit"):
    """A data property with an unknown unit."""

    title = "the unit of `{property}` is `{unit}`, which is not a known unit"
    help = "use one of {units}"
    property: str
    unit: str
    units: str


class SameName(Error, code="EZS864", name="same-exported-name"):
    """Two individuals with the same name in an export."""

    title = "there are two {kind} `{spelled}`"
    note = "rules use this name, so it must be unique"
    help = "export them to two files, or rename one of them"
    kind: str
    spelled: str

    class Other(Remark):
        says = "the other one is here"


class DeepTree(Error, code="EZS865", name="deep-exported-tree"):
    """A behavior tree that is nested too deeply for JSON readers."""

    title = "the behavior tree has more than {most} levels here"
    note = "some programs cannot read JSON that is nested so deeply"
    help = "move a part of the tree into a compound skill"
    most: int


ALL: tuple[type[Template], ...] = (
    NoExport,
    StaleExport,
    NotExported,
    UnknownPropertyUnit,
    SameName,
    DeepTree,
)
