"""All diagnostic classes: the one list for pages, SARIF and tests."""

from __future__ import annotations

from crosscheck import errors, recovery_errors
from crosscheck.catalog import errors as catalog_errors
from crosscheck.live import errors as live_errors
from dslkit.catalog import Catalog
from dslkit.diagnostics import Template

DIAGNOSTICS: tuple[type[Template], ...] = (
    *errors.ALL,
    *recovery_errors.ALL,
    *live_errors.ALL,
    *catalog_errors.ALL,
)

CATALOG = Catalog("crosscheck", "crosscheck.catalog", DIAGNOSTICS)
