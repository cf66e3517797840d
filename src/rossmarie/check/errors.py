"""Every diagnostic of the checker, by the hundreds of its code."""

from __future__ import annotations

from dslkit.diagnostics import Template
from rossmarie.check import (
    action_errors,
    meaning_errors,
    name_errors,
    rule_errors,
    test_errors,
    type_errors,
    unit_errors,
)

ALL: tuple[type[Template], ...] = (
    *name_errors.ALL,
    *type_errors.ALL,
    *unit_errors.ALL,
    *meaning_errors.ALL,
    *action_errors.ALL,
    *rule_errors.ALL,
    *test_errors.ALL,
)
