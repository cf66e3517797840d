"""The output of the `crosscheck` command."""

from __future__ import annotations

from typing import TYPE_CHECKING

from dslkit.command_line import CommandLine

if TYPE_CHECKING:  # for `explain` and SARIF only
    from dslkit.catalog import Catalog
    from dslkit.extras import Extras

_DISTRIBUTION = "rossmarie-crosscheck"


def _catalog() -> Catalog:
    from crosscheck.catalog import CATALOG

    return CATALOG


def _extras() -> Extras:
    from dslkit.extras import Extras

    return Extras(_DISTRIBUTION, {})


output = CommandLine(
    tool="crosscheck",
    subject="your robot",
    internal_code="CHK900",
    unreadable=frozenset({"ROSS801", "ROSS802"}),
    catalog=_catalog,
    distribution=_DISTRIBUTION,
    extras=_extras,
)
