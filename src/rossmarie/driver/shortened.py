"""The visible part of very many findings: the first findings of each file, and a note that there
are more.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping

from dslkit.diagnostics import Diagnostic, Severity
from dslkit.source import Span
from rossmarie.driver.errors import TooManyWarnings
from rossmarie.syntax.errors import TooManyErrors
from rossmarie.syntax.limits import MAXIMUM_ERRORS

_CLOSING: Mapping[Severity, type[TooManyErrors | TooManyWarnings]] = {
    Severity.ERROR: TooManyErrors,
    Severity.WARNING: TooManyWarnings,
}


def shortened(found: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Findings in order, limited to the first `MAXIMUM_ERRORS` errors and as many warnings of each
    file. A finding of the same severity replaces the remaining findings.
    """
    counts: Counter[tuple[int, Severity]] = Counter()
    shown = []
    for finding in found:
        span, severity = finding.primary.span, finding.severity
        counts[id(span.file), severity] += 1
        count = counts[id(span.file), severity]
        if count <= MAXIMUM_ERRORS:
            shown.append(finding)
        elif severity not in _CLOSING:
            shown.append(finding)  # the user asked for the notes, so all are shown
        elif count == MAXIMUM_ERRORS + 1:
            here = Span(span.file, span.start, span.start)
            shown.append(_CLOSING[severity](limit=MAXIMUM_ERRORS).at(here))
    return tuple(shown)
