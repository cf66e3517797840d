"""All diagnostic classes, by stage: the one list for pages, SARIF and tests."""

from __future__ import annotations

from dslkit.catalog import Catalog
from dslkit.diagnostics import Template
from rossmarie.analysis import errors as analysis_errors
from rossmarie.analysis import rate_errors
from rossmarie.catalog import errors as catalog_errors
from rossmarie.check import errors as check_errors
from rossmarie.driver import errors as driver_errors
from rossmarie.recordings import errors as recordings_errors
from rossmarie.report.safety import errors as safety_errors
from rossmarie.starter import errors as starter_errors
from rossmarie.syntax import errors as syntax_errors
from rossmarie.targets import errors as targets_errors
from rossmarie.testing import errors as testing_errors
from rossmarie.verification import errors as verification_errors

DIAGNOSTICS: tuple[type[Template], ...] = (
    *syntax_errors.ALL,
    *check_errors.ALL,
    *targets_errors.ALL,
    *recordings_errors.ALL,
    *starter_errors.ALL,
    *testing_errors.ALL,
    *analysis_errors.ALL,
    *rate_errors.ALL,
    *safety_errors.ALL,
    *verification_errors.ALL,
    *driver_errors.ALL,
    *catalog_errors.ALL,
)

CATALOG = Catalog("rossmarie", "rossmarie.catalog", DIAGNOSTICS)
