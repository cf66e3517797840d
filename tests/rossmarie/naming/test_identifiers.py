"""The prefix of public names in the generated C."""

from __future__ import annotations

from rossmarie.naming import public_prefix


def test_a_file_keeps_its_name_unless_c_has_it() -> None:
    assert [public_prefix(name) for name in ("husky", "rules", "limits", "rule", "int")] == [
        "husky",
        "rules",
        "limits",
        "ross_rule",
        "int_",
    ]
