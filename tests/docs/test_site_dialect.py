"""Pages are put into the dialect of Markdown that the generator of the site reads."""

from __future__ import annotations

from pathlib import Path

import pytest

from support.site import program

dialect = program("dialect")


def same(target: str) -> str:
    return target


@pytest.mark.parametrize(
    ("page", "expected"),
    [
        ("- a\n  - b\n    - c\n", "- a\n    - b\n        - c\n"),
        ("- a\n  b\n- c\n", "- a\n    b\n- c\n"),
        (
            "1. a\n\n   ```text\n   b\n     c\n   ```\n",
            "1. a\n\n    ```text\n    b\n      c\n    ```\n",
        ),
        ("10. a\n    - b\n", "10. a\n    - b\n"),
        ("Text:\n- a\n- b\n", "Text:\n\n- a\n- b\n"),
        ("Text:\n| a |\n| --- |\n| b |\n", "Text:\n\n| a |\n| --- |\n| b |\n"),
        ("```ross near.ross\nconst a = 1\n```\n", '```ross title="near.ross"\nconst a = 1\n```\n'),
        ("```text\n- a\n  - b\n```ross a.ross\n", "```text\n- a\n  - b\n```ross a.ross\n"),
    ],
)
def test_a_page_gets_the_dialect(page: str, expected: str) -> None:
    assert dialect.to_site(page, same) == expected


@pytest.mark.parametrize(
    ("page", "expected"),
    [
        ("[a](b.md) and ![c](d.png)", "[a](B.MD) and ![c](D.PNG)"),
        ("[a [b]](c.md)\n[d]: e.md\n", "[a [b]](C.MD)\n[d]: E.MD\n"),
        ('<img alt="a" src="b.png">', '<img alt="a" src="B.PNG">'),
        ("[`a](b)`](c.md)", "[`a](b)`](C.MD)"),
        ("`[a](b.md)` ``[a](b`c.md)``", "`[a](b.md)` ``[a](b`c.md)``"),
        ("```python\n[a](b.md)\n```\n[a](b.md)", "```python\n[a](b.md)\n```\n[a](B.MD)"),
    ],
)
def test_links_get_new_addresses_and_code_does_not(page: str, expected: str) -> None:
    assert dialect.to_site(page, str.upper) == expected


def test_the_title_is_the_first_heading_as_plain_text() -> None:
    assert dialect.title("text\n\n# The `ross` *language*\n\n# Two\n") == "The ross language"


def test_files_that_a_page_links_to_become_pages(tmp_path: Path) -> None:
    for name, text in {
        "README.md": "# Home\n[code](src/a.py#L3) [folder](src) [page](docs/b.md#part)\n",
        "docs/README.md": "# Contents\n[page](b.md)\n",
        "docs/b.md": "# B\n[home](../README.md) [gone](gone.md) [web](https://example.org/x)\n",
        "src/a.py": "print('``````')\n",
        **dict.fromkeys(("ARCHITECTURE.md", "CHANGELOG.md", "CONTRIBUTING.md"), "# One\n"),
    }.items():
        (tmp_path / "project" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "project" / name).write_text(text, encoding="utf-8")
    pages = program("pages").Pages(tmp_path / "project", tmp_path / "out")
    pages.write()

    def written(name: str) -> str:
        return (tmp_path / "out" / name).read_text(encoding="utf-8")

    links = "[code](files/src/a.py.md) [folder](files/src/index.md) [page](b.md#part)"
    assert links in written("index.md")
    assert "[home](index.md) [gone](gone.md) [web](https://example.org/x)" in written("b.md")
    assert "[a.py](a.py.md)" in written("files/src/index.md")
    assert "print(" in written("files/src/a.py.md")
    assert pages.titles["files/src/a.py.md"] == "src/a.py"
