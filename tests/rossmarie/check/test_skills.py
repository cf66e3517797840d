"""Findings about skills point into the skills as well."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

import pytest

from dslkit.diagnostics import Diagnostic
from rossmarie.driver.pipeline import check_file, compile_file
from support.rule_skills import content

MODULE = """\
class Push(SkillDescription):
    def description(self, Object: skiros.Product, Force: float):
        pass
"""
RULES = """\
skills "skills/skills.json";
action stop;
input force = topic /force : std_msgs/Float32 in N timeout 1 sec;
rule it: if force > 5 N and {} then {{ stop; }};
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with skills whose file says where they stand."""
    found = content()
    digest = hashlib.sha256(MODULE.encode()).hexdigest()
    found["sources"] = [{"path": "push.py", "sha256": digest}]
    push = found["skills"][2]
    push["place"] = {"path": "push.py", "line": 1, "column": 7, "end_line": 1, "end_column": 11}
    individual = push["parameters"][0]
    individual["place"] = {
        "path": "push.py",
        "line": 2,
        "column": 27,
        "end_line": 2,
        "end_column": 33,
    }
    (tmp_path / "skills").mkdir()
    (tmp_path / "skills" / "push.py").write_text(MODULE, encoding="utf-8")
    (tmp_path / "skills" / "skills.json").write_text(json.dumps(found), encoding="utf-8")
    return tmp_path


def finding(folder: Path, condition: str) -> Diagnostic:
    path = folder / "rules.ross"
    path.write_text(RULES.format(condition), encoding="utf-8")
    (found,) = check_file(path).diagnostics
    return found


@pytest.mark.parametrize(
    ("condition", "code", "place", "words"),
    [
        ("doing Pusch", "ROSS144", "Push", "`Push` stands here"),
        ("doing Push(Objekt: Box)", "ROSS145", "Object", "`Object` stands here"),
        ("doing Push(Zzz: Box)", "ROSS145", "Push", "`Push` stands here"),
        ("doing Push(Object: Shelf)", "ROSS245", "Object", "`Object` stands here"),
    ],
)
def test_a_finding_shows_the_skill_in_its_module(
    folder: Path, condition: str, code: str, place: str, words: str
) -> None:
    found = finding(folder, condition)
    assert found.code == code
    assert found.primary.span.file.path == str(folder / "rules.ross")
    (label,) = found.labels
    assert label.span.file.path == str(folder / "skills" / "push.py")
    assert (label.span.text, label.text) == (place, words)


def test_the_file_is_one_of_the_sources_of_the_machine(folder: Path) -> None:
    path = folder / "rules.ross"
    path.write_text(RULES.format("doing Push"), encoding="utf-8")
    sources = [Path(source.path).name for source in compile_file(path).sources]
    assert sources == ["skills.json", "rules.ross"]


def test_two_files_that_import_each_other_may_name_the_same_skills(folder: Path) -> None:
    other = folder / "more.ross"
    other.write_text('skills "skills/skills.json";\n', encoding="utf-8")
    path = folder / "rules.ross"
    path.write_text('import "more.ross";\n' + RULES.format("doing Push"), encoding="utf-8")
    assert check_file(path).diagnostics == ()
