"""All diagnostics of the checker, by code. Each is defined beside the code that reports it."""

from __future__ import annotations

from dslkit.diagnostics import Template
from rossmarie.check.actions import errors as action_errors
from rossmarie.check.actions import retrace_errors, tree_errors
from rossmarie.check.expressions import errors as expression_errors
from rossmarie.check.foresight import errors as foresight_errors
from rossmarie.check.instances import errors as instance_errors
from rossmarie.check.names import errors as name_errors
from rossmarie.check.names import frame_errors, region_errors
from rossmarie.check.operations import errors as operation_errors
from rossmarie.check.operations import function_errors, list_errors, range_errors, sector_errors
from rossmarie.check.rules import errors as rule_errors
from rossmarie.check.scopes import errors as scope_errors
from rossmarie.check.skills import errors as skill_errors
from rossmarie.check.system import errors as system_errors
from rossmarie.check.tests import errors as test_errors
from rossmarie.check.units import errors as unit_errors
from rossmarie.check.zones import errors as zone_errors

_DECLARED: tuple[type[Template], ...] = (
    *scope_errors.ALL,
    *instance_errors.ALL,
    *skill_errors.ALL,
    *unit_errors.ALL,
    *name_errors.ALL,
    *region_errors.ALL,
    *frame_errors.ALL,
    *operation_errors.ALL,
    *function_errors.ALL,
    *list_errors.ALL,
    *sector_errors.ALL,
    *range_errors.ALL,
    *expression_errors.ALL,
    *foresight_errors.ALL,
    *zone_errors.ALL,
    *system_errors.ALL,
    *action_errors.ALL,
    *retrace_errors.ALL,
    *tree_errors.ALL,
    *rule_errors.ALL,
    *test_errors.ALL,
)

ALL = tuple(sorted(_DECLARED, key=lambda found: found.code))
