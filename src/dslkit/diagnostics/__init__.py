"""What is wrong, as data, and how it is shown."""

from dslkit.diagnostics.collector import Collector
from dslkit.diagnostics.model import Diagnostic, Edit, Fix, Label, Severity
from dslkit.diagnostics.template import Error, Template, Warning

__all__ = [
    "Collector",
    "Diagnostic",
    "Edit",
    "Error",
    "Fix",
    "Label",
    "Severity",
    "Template",
    "Warning",
]
