"""The report of `make deep` on its parts, and the days when it is due."""

from __future__ import annotations

import importlib.util
import sys
from datetime import date
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
    assert f"| part 0 | failed, exit code 3 | {date.today().isoformat()} | 0.0 |" in page
    assert f"| part 1 | passed | {date.today().isoformat()} | 0.0 |" in page
    assert "    fine\n" in page
    assert "failed, exit code 3" in capfd.readouterr().out
    assert run(deep, monkeypatch, "print('fine')") == 0


def test_the_page_has_the_last_lines_without_those_of_progress(
    deep: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    printed = r"one\ntwo\n..s [ 50%]\n... [100%]\nthree\n"
    run(deep, monkeypatch, f"print('{printed}', end='')")
    assert deep.PAGE.read_text().endswith("    two\n    three\n")


def test_a_part_that_passed_on_these_sources_is_not_run_again(
    deep: ModuleType, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    reported = (
        f"open({str(tmp_path / 'runs')!r}, 'a').write('x'); print('one'); print(); print('two')"
    )
    again = (
        f"import pathlib; raise SystemExit(not pathlib.Path({str(tmp_path / 'there')!r}).exists())"
    )
    assert run(deep, monkeypatch, reported, again, kept=3) == 1
    first = deep.PAGE.read_text()
    (tmp_path / "there").touch()
    assert run(deep, monkeypatch, reported, again, kept=3) == 0
    assert (tmp_path / "runs").read_text() == "x"
    assert deep.PAGE.read_text() == first.replace("failed, exit code 1", "passed")
    (deep.ROOT / "src/rossmarie/targets/names.py").write_text("two")
    assert run(deep, monkeypatch, reported, again, kept=3) == 0
    assert (tmp_path / "runs").read_text() == "xx"


def test_a_run_that_is_interrupted_keeps_what_it_has(
    deep: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Interrupted(BaseException):
        """Comes between two parts."""

    def ran(part: object, first: list[object] = []) -> object:  # noqa: B006 - counts the calls
        if first:
            raise Interrupted
        first.append(part)
        return original(part)

    original = deep.ran
    monkeypatch.setattr(deep, "ran", ran)
    with pytest.raises(Interrupted):
        run(deep, monkeypatch, "print('fine')", "print('never')")
    assert "| part 0 | passed |" in deep.PAGE.read_text()


def test_it_is_due_until_all_parts_have_passed_on_this_generator(
    deep: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    def reminder() -> str:
        return str(deep.reminder(deep.parts(0, 0)))

    assert "is due" in reminder()
    run(deep, monkeypatch, "", "raise SystemExit(1)")
    assert "is due" in reminder()
    run(deep, monkeypatch, "", "")
    assert "has passed for the current generator" in reminder()
    (deep.ROOT / "src/rossmarie/targets/names.py").write_text("two")
    assert "is due" in reminder()
