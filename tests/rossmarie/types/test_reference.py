from pathlib import Path

from rossmarie.types.reference import render

PAGE = Path(__file__).parents[3] / "docs" / "reference" / "units.md"


def test_the_page_of_units_is_up_to_date() -> None:
    assert PAGE.read_text(encoding="utf-8") == render(), (
        "run: python -m rossmarie.types.reference docs/reference/units.md"
    )
