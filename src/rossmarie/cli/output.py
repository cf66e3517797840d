"""The output of the `rossmarie` command."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import TYPE_CHECKING

from dslkit.command_line import CommandLine
from dslkit.diagnostics import Diagnostic

if TYPE_CHECKING:  # for `explain` and SARIF only
    from dslkit.catalog import Catalog
    from dslkit.extras import Extras


def _catalog() -> Catalog:
    from rossmarie.catalog import CATALOG

    return CATALOG


def _extras() -> Extras:
    from rossmarie.extras import EXTRAS

    return EXTRAS


output = CommandLine(
    tool="rossmarie",
    subject="your rules",
    internal_code="ROSS900",
    unreadable=frozenset({"ROSS610", "ROSS611", "ROSS780", "ROSS801", "ROSS802"}),
    catalog=_catalog,
    distribution="rossmarie",
    extras=_extras,
)


def each_once(found: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    """The findings, each once: a file that two rules files import is checked with each of them."""
    kept: dict[tuple[object, ...], Diagnostic] = {}
    for finding in found:
        span = finding.primary.span
        place = (os.path.realpath(span.file.path), span.start, span.end)
        kept.setdefault((finding.code, finding.title, *place), finding)
    return tuple(kept.values())
