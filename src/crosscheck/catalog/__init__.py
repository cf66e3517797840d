"""Every diagnostic of crosscheck, and the page that explains it."""

from crosscheck.catalog.index import CATALOG, DIAGNOSTICS

__all__ = ["CATALOG", "DIAGNOSTICS"]
