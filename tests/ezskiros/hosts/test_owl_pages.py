"""The page of each finding of `ezskiros owl`: its example has it, what to write instead has not."""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros.catalog import CATALOG
from ezskiros.hosts import owl_errors as errors
from ezskiros.hosts.owl_files import owl_files
from ezskiros.ontology import load
from support import expectations
from support.markdown import blocks

CODES = [each.code for each in errors.ALL]


def files(code: str, heading: str) -> dict[str, str]:
    found = [each for each in blocks(CATALOG.page(code)) if each.heading == heading]
    return {each.name or "": each.text for each in found}


def write(folder: Path, texts: dict[str, str]) -> Path:
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder


@pytest.mark.parametrize("code", CODES)
def test_the_example_has_the_finding(code: str, tmp_path: Path) -> None:
    texts = files(code, "Example")
    written, found = owl_files(load(write(tmp_path, texts), relations=False))
    assert (written, {each.code for each in found}) == ({}, {code})
    for name, text in texts.items():
        own = [each for each in found if Path(each.primary.span.file.path).name == name]
        assert expectations.compare(text, own, "#") == []


@pytest.mark.parametrize("code", CODES)
def test_what_to_write_instead_is_fine(code: str, tmp_path: Path) -> None:
    written, found = owl_files(load(write(tmp_path, files(code, "Write instead")), relations=False))
    assert written
    assert found == []
