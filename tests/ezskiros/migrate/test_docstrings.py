"""Comments on parameters move to the docstring of the method."""

from __future__ import annotations

import ast

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ezskiros.migrate.module import migrate_text

DOCS = ["", '"""What it does."""', "'''Two\n\n        lines.'''", "'one'", '"two" " parts"']
TEXTS = st.text(st.characters(codec="utf-8", exclude_categories=("C", "Z")), min_size=1)


def docstring(doc: str, text: str) -> str:
    call = f"self.addParam('Speed', 1.0, ParamTypes.Required, description={text!r})"
    body = "".join(f"        {line}\n" for line in (doc, call) if line)
    old = f"class Go(SkillDescription):\n    def createDescription(self):\n{body}"
    method = ast.parse(migrate_text("skills.py", old).text).body[-1]
    assert isinstance(method, ast.ClassDef)
    assert isinstance(method.body[0], ast.FunctionDef)
    return ast.get_docstring(method.body[0]) or ""


@given(st.sampled_from(DOCS), TEXTS)
def test_any_text_is_kept(doc: str, text: str) -> None:
    lines = docstring(doc, text).split("\n")
    assert lines[-2:] == ["Args:", f"    Speed: {text}"]


@pytest.mark.parametrize(
    ("doc", "before"),
    [
        ("", ""),
        ('"""What it does."""', "What it does.\n\n"),
        ('\'one """ \\\\\'', 'one """ \\\n\n'),
        ("r'''raw \\d'''", "raw \\d\n\n"),
    ],
)
def test_what_was_there_stays(doc: str, before: str) -> None:
    assert docstring(doc, "in m/s") == f"{before}Args:\n    Speed: in m/s"


def test_a_section_that_is_there_is_continued() -> None:
    doc = '"""Goes.\n\n        Args:\n            Other: of another kind.\n\n        """'
    assert docstring(doc, "in m/s") == (
        "Goes.\n\nArgs:\n    Other: of another kind.\n    Speed: in m/s"
    )
