"""Every diagnostic of EzSkiROS, and the page that explains it."""

from ezskiros.catalog.index import CATALOG, DIAGNOSTICS

__all__ = ["CATALOG", "DIAGNOSTICS"]
