"""Every diagnostic there is, and the page that explains it."""

from rossmarie.catalog.index import CATALOG, DIAGNOSTICS

__all__ = ["CATALOG", "DIAGNOSTICS"]
