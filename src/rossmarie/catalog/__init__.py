"""Every diagnostic there is, and the page that explains it."""

from rossmarie.catalog.index import DIAGNOSTICS
from rossmarie.catalog.pages import UnknownCodeError, page, sarif_rules

__all__ = ["DIAGNOSTICS", "UnknownCodeError", "page", "sarif_rules"]
