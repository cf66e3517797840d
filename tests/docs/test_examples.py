"""The code that the documentation shows: rules are checked, Python and commands are run.

Each page has a folder of its own, with the examples of the project and skills files in it. A
block with a name behind its language (a fence that says `ross arm.ross`) is saved there under that
name. The commands of this project, Python, `cat` and `sed` run there. All others are taken on
trust.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from dslkit.diagnostics import Severity
from rossmarie.driver import check_file
from support import expectations, transcript
from support.checking import compare_file
from support.markdown import Block, blocks
from support.parts import LEARNERS, needs
from support.rule_skills import put_skills

ROOT = Path(__file__).parents[2]
STUDY = ROOT / "docs" / "study"
TUTORIALS = ROOT / "docs" / "tutorial"
"""Their Python finds its files from any current folder."""
CLONE = re.compile(r"in a\s+clone\s+of\s+the\s+repository")
FIRST_FOLDER = re.compile(r"Begin in (?:an empty folder|the folder of)")
"""A tutorial begins in a clone, which has the examples, or in a folder without files."""
PAGES = sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")])
NEEDS = {"docs/how-to/learn-behind-rules.md": LEARNERS}
"""Parts of a machine that pages need."""


def name(page: Path) -> str:
    return page.relative_to(ROOT).as_posix()


def examples() -> Iterator[Any]:
    """The pages, each with the part that it needs."""
    for page in PAGES:
        part = NEEDS.get(name(page))
        yield pytest.param(page, id=name(page), marks=[needs(part)] if part else [])


@pytest.mark.parametrize("page", list(examples()))
def test_the_examples_of_a_page_work(page: Path, tmp_path: Path) -> None:
    text = page.read_text(encoding="utf-8")
    folder = tmp_path / "project"
    folder.mkdir()
    is_tutorial = page.is_relative_to(TUTORIALS)
    if not is_tutorial or CLONE.search(text):
        shutil.copytree(ROOT / "examples", folder / "examples")
    else:
        assert FIRST_FOLDER.search(text), "a tutorial says in which folder a reader begins"
    if not is_tutorial:
        put_skills(folder)
    if page.is_relative_to(STUDY):
        shutil.copytree(STUDY, folder / "docs" / "study")
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    for block in blocks(text):
        problems = check_block(block, folder, elsewhere if is_tutorial else folder)
        assert not problems, f"{name(page)}:{block.line}: " + "\n".join(problems)


def check_block(block: Block, folder: Path, current: Path) -> list[str]:
    """The problems with a block that belongs in `folder`; Python runs in the folder `current`."""
    if block.language == "ross":
        return check_rules(block, folder)
    if block.language == "console":
        return transcript.run(block.text, folder)
    if block.language == "python":
        return run_python(block, folder, current)
    if block.language == "text" and block.name:
        (folder / block.name).write_text(block.text, encoding="utf-8")
    return []


def check_rules(block: Block, folder: Path) -> list[str]:
    """Rules without stated expectations have no errors; warnings are not worth a comment."""
    path = folder / (block.name or "rules.ross")
    path.write_text(block.text, encoding="utf-8")
    if expectations.parse(block.text):
        return compare_file(path, bless=False)
    found = check_file(path).diagnostics
    return [
        f"{one.primary.span}: {one.code}: {one.title}"
        for one in found
        if one.severity is Severity.ERROR
    ]


def run_python(block: Block, folder: Path, current: Path) -> list[str]:
    path = folder / (block.name or "example.py")
    path.write_text(block.text, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, path], cwd=current, capture_output=True, text=True, check=False
    )
    return [done.stderr] if done.returncode else []


LINK = re.compile(r"\]\((?!https?://|mailto:)([^)#\s]+)(?:#[^)]*)?\)")


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_links_inside_the_project_lead_somewhere(page: Path) -> None:
    targets = LINK.findall(page.read_text(encoding="utf-8"))
    assert [target for target in targets if not (page.parent / target).exists()] == []
