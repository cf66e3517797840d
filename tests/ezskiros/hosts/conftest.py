"""Libraries of skills for tests: texts in, packages that can be imported out."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from textwrap import dedent

import pytest

from support.ontologies import HALL

HOST = "from ezskiros.hosts.skiros2 import host\n\nhost(__name__)\n"
HEADER = f"""\
import enum
from typing import Annotated

from ezskiros import INFERRED, OPTIONAL, OUTPUT, Key, SkillDescription
from ezskiros.ontology import load

world = load({str(HALL)!r})
cora, skiros = world.cora, world.skiros

"""

Package = Callable[..., str]


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Package]:
    """Writes a package with a module `skills`, and others by their names; it can be imported."""
    monkeypatch.syspath_prepend(tmp_path)
    known = {*sys.modules}

    def write(name: str, skills: str, init: str = HOST, **others: str) -> str:
        folder = tmp_path / name
        folder.mkdir()
        (folder / "__init__.py").write_text(init)
        for module, text in {"skills": skills, **others}.items():
            (folder / f"{module}.py").write_text(HEADER + dedent(text))
        importlib.invalidate_caches()
        return name

    yield write
    for name in {*sys.modules} - known:
        if str(getattr(sys.modules[name], "__file__", "")).startswith(str(tmp_path)):
            del sys.modules[name]
