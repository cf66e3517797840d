"""The output of the `ezskiros` command."""

from __future__ import annotations

from typing import TYPE_CHECKING

from dslkit.command_line import CommandLine

if TYPE_CHECKING:  # only for `explain` and SARIF
    from dslkit.catalog import Catalog
    from dslkit.extras import Extras


def _catalog() -> Catalog:
    from ezskiros.catalog import CATALOG

    return CATALOG


def _extras() -> Extras:
    from ezskiros.extras import EXTRAS

    return EXTRAS


output = CommandLine(
    tool="ezskiros",
    subject="your skills",
    internal_code="EZS900",
    unreadable=frozenset({"EZS001", "EZS105", "EZS106"}),
    catalog=_catalog,
    distribution="ezskiros",
    extras=_extras,
)
