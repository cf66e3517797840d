"""The pages about learning: their examples have the finding, what to write instead has not."""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros.catalog import CATALOG
from support import command_line
from support.markdown import blocks

OF_RECORDS = ("EZS866", "EZS867", "EZS868")
OF_KNOWLEDGE = ("EZS869", "EZS870", "EZS871")


def write(code: str, heading: str, folder: Path) -> None:
    for each in blocks(CATALOG.page(code)):
        if each.name and each.heading in ("Example", heading):
            (folder / each.name).write_text(each.text, encoding="utf-8")


@pytest.mark.parametrize("code", OF_RECORDS)
@pytest.mark.parametrize("heading", ["Example", "Write instead"])
def test_the_records_have_the_finding(code: str, heading: str, tmp_path: Path) -> None:
    write(code, heading, tmp_path)
    files = sorted(each.name for each in tmp_path.glob("*.jsonl"))
    done = command_line.run("ezskiros", "learn", *files, folder=tmp_path)
    is_wrong = heading == "Example"
    assert (f"error[{code}]" in done.stdout) is is_wrong, done.stdout
    assert done.returncode == is_wrong, done.stderr


@pytest.mark.parametrize("code", OF_KNOWLEDGE)
@pytest.mark.parametrize("heading", ["Example", "Write instead"])
def test_the_knowledge_has_the_finding(code: str, heading: str, tmp_path: Path) -> None:
    write(code, heading, tmp_path)
    arguments = ("check", "skill.py", "--knowledge", "knowledge.json")
    done = command_line.run("ezskiros", *arguments, folder=tmp_path)
    assert (f"[{code}]" in done.stdout) is (heading == "Example"), done.stdout
