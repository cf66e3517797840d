"""The page of each finding about SkiROS2: its example has it, what to write instead has not.

Modules called `not_hosted` belong to a library that SkiROS2 does not have.
"""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from dslkit.diagnostics import Collector
from ezskiros.catalog import CATALOG
from ezskiros.hosts import skiros2_errors as errors
from ezskiros.hosts.skiros2_library import CheckedLibrary, check_library
from support import expectations
from support.markdown import blocks

CODES = [each.code for each in errors.ALL]


@pytest.fixture(autouse=True)
def in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.syspath_prepend(tmp_path)
    known = {*sys.modules}
    yield
    for name in {*sys.modules} - known:
        if str(getattr(sys.modules[name], "__file__", "")).startswith(str(tmp_path)):
            del sys.modules[name]


def library(folder: Path, texts: dict[str, str]) -> CheckedLibrary:
    for name, text in texts.items():
        (folder / name).write_text(text)
    importlib.invalidate_caches()
    names = [name.removesuffix(".py") for name in texts if name != "not_hosted.py"]
    return check_library([importlib.import_module(name) for name in names], Collector())


def files(code: str, heading: str) -> dict[str, str]:
    found = [each for each in blocks(CATALOG.page(code)) if each.heading == heading]
    return {each.name or "skills.py": each.text for each in found}


@pytest.mark.parametrize("code", CODES)
def test_the_example_has_the_finding(code: str, tmp_path: Path) -> None:
    texts = files(code, "Example")
    found = library(tmp_path, texts).diagnostics
    assert code in {each.code for each in found}
    for name, text in texts.items():
        own = [each for each in found if Path(each.primary.span.file.path).name == name]
        assert expectations.compare(text, own, "#") == []


@pytest.mark.parametrize("code", CODES)
def test_what_to_write_instead_is_accepted(code: str, tmp_path: Path) -> None:
    texts = {**files(code, "Example"), **files(code, "Write instead")}
    checked = library(tmp_path, texts)
    assert checked.diagnostics == ()
    assert not checked.refused
