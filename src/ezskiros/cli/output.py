"""The voice of the `ezskiros` command."""

from __future__ import annotations

from typing import TYPE_CHECKING

from dslkit.command_line import CommandLine

if TYPE_CHECKING:  # for `explain` and SARIF only
    from dslkit.catalog import Catalog


def _catalog() -> Catalog:
    from ezskiros.catalog import CATALOG

    return CATALOG


output = CommandLine(
    tool="ezskiros",
    subject="your skills",
    internal_code="EZS900",
    unreadable=frozenset({"EZS001", "EZS105", "EZS106"}),
    catalog=_catalog,
)
