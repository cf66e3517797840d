"""Findings as data, and their renderers.

The renderers are separate modules: `dslkit.diagnostics.render_text`, `.render_json` and
`.render_sarif`; importing this package does not import them.
"""

from dslkit.diagnostics.collector import Collector
from dslkit.diagnostics.counting import summary
from dslkit.diagnostics.edits import apply_edits
from dslkit.diagnostics.listing import listed
from dslkit.diagnostics.model import Diagnostic, Edit, Fix, Label, Severity
from dslkit.diagnostics.remark import DeclaredHere, DidYouMean, NamedHere, Remark, Write, remarked
from dslkit.diagnostics.template import Error, Note, Template, Warning

__all__ = [
    "Collector",
    "DeclaredHere",
    "Diagnostic",
    "DidYouMean",
    "Edit",
    "Error",
    "Fix",
    "Label",
    "NamedHere",
    "Note",
    "Remark",
    "Severity",
    "Template",
    "Warning",
    "Write",
    "apply_edits",
    "listed",
    "remarked",
    "summary",
]
