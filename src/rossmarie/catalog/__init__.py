"""All diagnostics, and the page that explains each."""

from rossmarie.catalog.index import CATALOG, DIAGNOSTICS

__all__ = ["CATALOG", "DIAGNOSTICS"]
