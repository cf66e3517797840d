"""The declared findings: codes are unique, sorted by stage, and every text can be filled in."""

from __future__ import annotations

import pytest

from dslkit.diagnostics import Template
from rossmarie.check import errors


def test_codes_and_names_are_unique() -> None:
    assert len({found.code for found in errors.ALL}) == len(errors.ALL)
    assert len({found.name for found in errors.ALL}) == len(errors.ALL)


@pytest.mark.parametrize("template", errors.ALL, ids=lambda template: template.code)
def test_texts_name_only_fields_that_exist(template: type[Template]) -> None:
    template.check_placeholders()
    assert template.code[:5] in {"ROSS1", "ROSS2", "ROSS3", "ROSS4"}
