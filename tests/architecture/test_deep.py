"""What `make deep` says of its parts, and when it is due."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import pytest

PROGRAM = Path(__file__).parents[2] / "tools" / "deep.py"


@pytest.fixture
def deep(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> ModuleType:
    """The program, for a project that has a generator and nothing else."""
    spec = importlib.util.spec_from_file_location("deep", PROGRAM)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, "deep", module)
    spec.loader.exec_module(module)
    (tmp_path / "src/rossmarie/targets").mkdir(parents=True)
    (tmp_path / "src/rossmarie/targets/names.py").write_text("one")
    monkeypatch.setattr(module, "ROOT", tmp_path)
    monkeypatch.setattr(module, "PAGE", tmp_path / "page.md")
    return module


def run(deep: ModuleType, monkeypatch: pytest.MonkeyPatch, *codes: str, kept: int = 2) -> int:
    """Run it with a part for each program in Python; its exit code."""
    made = tuple(deep.Part(f"part {n}", (sys.executable, "-c", code), kept) for n, code in
                 enumerate(codes))  # fmt: skip
    monkeypatch.setattr(deep, "parts", lambda _soak, _fuzz: made)
    monkeypatch.setattr(sys, "argv", ["deep.py"])
    return int(deep.main())


def test_all_parts_run_and_a_failure_is_the_exit_code(
    deep: ModuleType, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    assert run(deep, monkeypatch, "raise SystemExit(3)", "print('fine')") == 1
    page = deep.PAGE.read_text()
    assert "| part 0 | failed, exit code 3 | 0.0 |" in page
    assert "| part 1 | passed | 0.0 |" in page
    assert "    fine\n" in page
    assert "failed, exit code 3" in capfd.readouterr().out
    assert run(deep, monkeypatch, "print('fine')") == 0


def test_the_page_has_the_last_lines_without_those_of_progress(
    deep: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    printed = r"one\ntwo\n..s [ 50%]\n... [100%]\nthree\n"
    run(deep, monkeypatch, f"print('{printed}', end='')")
    assert deep.PAGE.read_text().endswith("    two\n    three\n")


def test_it_is_due_when_the_generator_has_changed(
    deep: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert "is due" in deep.reminder()
    run(deep, monkeypatch, "")
    assert "has run on this generator" in deep.reminder()
    (deep.ROOT / "src/rossmarie/targets/names.py").write_text("two")
    assert "is due" in deep.reminder()
