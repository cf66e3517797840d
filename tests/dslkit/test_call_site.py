"""The place in user code from which a function is called."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest

from dslkit.source import Span
from dslkit.source.call_site import call_site, place_of


def spans(text: str, folder: Path) -> list[Span]:
    """The places where a module calls `mark`, which is defined in this file."""
    found: list[Span] = []

    def mark(*_arguments: object) -> int:
        span = call_site(__file__)
        assert span is not None
        found.append(span)
        return 0

    path = folder / "user.py"
    path.write_text(text, encoding="utf-8")
    runpy.run_path(str(path), {"mark": mark})
    return found


@pytest.mark.parametrize(
    ("line", "texts"),
    [
        ("mark()", ["mark()"]),
        ("x = [1, mark(2)]", ["mark(2)"]),
        ("x = mark(1) + mark(2)", ["mark(1)", "mark(2)"]),
        ("x = 'äöü', mark('ß')", ["mark('ß')"]),
        ("x = '😀' ; mark('😀')", ["mark('😀')"]),
        ("mark(\n  1,\n)", ["mark(\n  1,\n)"]),
        ("if True:\n    mark()  # so", ["mark()"]),
    ],
)
def test_the_expression_is_known(line: str, texts: list[str], tmp_path: Path) -> None:
    assert [span.text for span in spans(line, tmp_path)] == texts


def test_the_file_is_the_one_of_the_user(tmp_path: Path) -> None:
    (span,) = spans("\n\nmark()\n", tmp_path)
    assert Path(span.file.path) == tmp_path / "user.py"
    assert (span.begin.line, span.begin.column) == (3, 1)


def test_files_may_be_the_users_all_the_same() -> None:
    def here(*but: str) -> Span | None:
        return call_site(f"{Path(__file__).parent}", but=but)

    places = [each.text if each else "" for each in (here(), here(__file__))]
    assert [place.startswith("call_site(") for place in places] == [False, True]


def test_code_without_a_source_has_no_place() -> None:
    found = []
    exec(
        compile("mark()", "<nowhere>", "exec"), {"mark": lambda: found.append(call_site(__file__))}
    )
    assert found == [None]


def test_an_exception_is_at_the_expression_that_raised_it(tmp_path: Path) -> None:
    path = tmp_path / "user.py"
    path.write_text("x = 'ä' + str(1 / 0)\n", encoding="utf-8")
    with pytest.raises(ZeroDivisionError) as raised:
        runpy.run_path(str(path))
    last = raised.tb
    while last.tb_next is not None:
        last = last.tb_next
    span = place_of(last)
    assert span is not None
    assert span.text == "1 / 0"
