"""The part of very many findings that is shown: the first of each file, and that there are more."""

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
    """Findings, in their order, without those of a file after its first `MAXIMUM_ERRORS` errors
    and its first as many warnings: a finding that is as bad stands in the place of these.
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
            shown.append(finding)  # notes are as many as were asked for
        elif count == MAXIMUM_ERRORS + 1:
            here = Span(span.file, span.start, span.start)
            shown.append(_CLOSING[severity](limit=MAXIMUM_ERRORS).at(here))
    return tuple(shown)
