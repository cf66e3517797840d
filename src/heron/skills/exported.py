"""The export of the skills, which rules are checked with."""

from __future__ import annotations

from dslkit.diagnostics import Diagnostic
from ezskiros.export import read_export
from heron.skills import EXPORT


def digest() -> str:
    """The digest of the export. Raises `ValueError` if it is none."""
    export = read_export(EXPORT)
    if isinstance(export, Diagnostic):
        raise ValueError(export.title)
    return export.digest
