"""Values that are known at launch: branches go one way; a file that is wrong is reported."""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros.driver import check_paths

SKILLS = """\
import enum

from ezskiros import SkillDescription


class Mode(enum.Enum):
    FAST = 1
    SLOW = 2


class Wait(SkillDescription):
    def description(self, Duration: float): ...


class wait(Wait.SkillBase):
    def execute(self):
        return self.success("waited")


class Task(SkillDescription):
    def description(self, Speed: float = 0.1, Mode: Mode = Mode.FAST, Names: str = "a b"): ...


class task(Task.SkillBase):
    def expandBT(self, params):
        if params.Speed * 2 > 1:
            Wait(Time=1.0)
        elif params.Mode == Mode.SLOW:
            Wait(Tine=1.0)
        elif "c" in params.Names.split():
            Wait(Duration=len(params.Names) * 1.0)
        else:
            Wait(Duration=params.Speed + abs(-params.Speed) + 1 / params.Speed)
"""


def found(folder: Path, values: str | None) -> list[tuple[str, str]]:
    """Codes, and the texts at their places."""
    skills = folder / "skills.py"
    skills.write_text(SKILLS, encoding="utf-8")
    path = folder / "values.yaml"
    if values is not None:
        path.write_text(values, encoding="utf-8")
    result = check_paths([skills], path if values is not None else None)
    return [(each.code, each.primary.span.text) for each in result.diagnostics]


def test_without_values_all_ways_are_looked_at(tmp_path: Path) -> None:
    codes = [place for code, place in found(tmp_path, None) if code == "EZS523"]
    assert codes == ["Time", "Tine"]


@pytest.mark.parametrize(
    ("values", "places"),
    [
        ("Task: {Speed: 0.6}", ["Time"]),
        ("Task: {Speed: 1}", ["Time"]),
        ("Task: {Speed: 0.1, Mode: SLOW}", ["Tine"]),
        ("Task: {Speed: 0.1, Mode: FAST, Names: a c}", []),
        ("Task: {Speed: 0.1, Mode: FAST, Names: a b}", []),
        ("Task: {Speed: 0.1}", ["Tine"]),
        ("# nothing", ["Time", "Tine"]),
    ],
)
def test_known_values_decide(tmp_path: Path, values: str, places: list[str]) -> None:
    every = found(tmp_path, values)
    assert [place for code, place in every if code == "EZS523"] == places
    assert {code for code, _ in every} <= {"EZS523", "EZS530"}


@pytest.mark.parametrize(
    ("values", "code", "place"),
    [
        ("Tsk: {Speed: 0.6}", "EZS513", "Tsk"),
        ("Task:\n  Sped: 0.6\n", "EZS513", "Sped"),
        ("Task:\n  Speed: fast\n", "EZS514", "fast"),
        ("Task:\n  Speed: [1, 2]\n", "EZS514", "[1, 2]"),
        ("Task:\n  Mode: QUICK\n", "EZS514", "QUICK"),
        ("Task:\n  Speed: null\n", "EZS514", "null"),
        ("Task: 3", "EZS512", "Task"),
        ("- Task", "EZS512", ""),
        ("Task: {", "EZS511", ""),
        ("Task: 1\nTask: 2", "EZS511", ""),
        ("\x00", "EZS511", ""),
    ],
)
def test_what_is_wrong_is_reported(tmp_path: Path, values: str, code: str, place: str) -> None:
    assert (code, place) in found(tmp_path, values)


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    (tmp_path / "skills.py").write_text(SKILLS, encoding="utf-8")
    result = check_paths([tmp_path / "skills.py"], tmp_path / "nowhere.yaml")
    (only,) = [each for each in result.diagnostics if each.code == "EZS511"]
    assert "no such file" in only.title


@pytest.mark.parametrize("end", ["\r", "\x85", "\u2028"])
def test_lines_that_only_yaml_knows_of_hide_no_finding(tmp_path: Path, end: str) -> None:
    values = f"# one{end}# two{end}# three{end}Task: {{Sped: 0.3}}"
    assert ("EZS513", "Sped") in found(tmp_path, values)
