"""The voice of the `ezskiros` command."""

from __future__ import annotations

from dslkit.catalog import Catalog
from dslkit.command_line import CommandLine


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
