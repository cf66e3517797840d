"""Type checkers find what is wrong with skills, and nothing else."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

from ezskiros.ontology import load
from ezskiros.stubs import write_stub
from support import command_line
from support.parts import ONTOLOGIES, needs
from support.shared import SKIROS2_ONTOLOGIES
from support.type_checkers import Checker, each_checker

HERE = Path(__file__).parent
ROOT = HERE.parents[2]
EXAMPLE = ROOT / "examples" / "pick_place"
PLANTED = HERE / "planted.py.txt"


@each_checker
def test_the_planted_errors_are_found_and_nothing_else(checker: Checker, tmp_path: Path) -> None:
    skills = planted(tmp_path)
    assert len(lines_with("  # wrong: ")) > 20
    found = {(skills.relative_to(tmp_path).as_posix(), line) for line in lines_with("  # wrong: ")}
    assert checker(tmp_path) == found


def test_check_finds_the_planted_errors_without_a_type_checker(tmp_path: Path) -> None:
    done = command_line.run("ezskiros", "check", "--format", "json", planted(tmp_path))
    found = json.loads(done.stdout)["diagnostics"]
    lines = {each["primary"]["start"]["line"] for each in found if each["severity"] == "error"}
    assert lines == lines_with("  # wrong: ")


def planted(folder: Path) -> Path:
    """The example with a module of errors in it."""
    for each in ("ontology", "skills"):
        shutil.copytree(EXAMPLE / each, folder / each)
    return Path(shutil.copy(PLANTED, folder / "skills" / "planted.py"))


def lines_with(text: str) -> set[int]:
    lines = PLANTED.read_text(encoding="utf-8").split("\n")
    return {number for number, line in enumerate(lines, 1) if text in line}


@each_checker
def test_the_stub_of_an_odd_ontology_is_right_in_itself(checker: Checker, tmp_path: Path) -> None:
    (tmp_path / "world.pyi").write_text(write_stub(load(HERE / "odd")), encoding="utf-8")
    assert checker(tmp_path) == set()


@needs(ONTOLOGIES)
@each_checker
def test_the_stub_of_the_ontologies_of_skiros2_is_right_in_itself(
    checker: Checker, tmp_path: Path
) -> None:
    (tmp_path / "world.pyi").write_text(write_stub(load(SKIROS2_ONTOLOGIES)), encoding="utf-8")
    (tmp_path / "skill.py").write_text(_REAL_SKILL, encoding="utf-8")
    assert checker(tmp_path) == {("skill.py", 8)}


_REAL_SKILL = """\
from ezskiros import INFERRED, SkillDescription
from world import cora, rparts, skiros, sumo

class Grasp(SkillDescription):
    def description(self, Robot: INFERRED[cora.Robot], Arm: rparts.ArmDevice, Box: skiros.LargeBox):
        self.pre_conditions += Robot.hasA(Arm)
        self.pre_conditions += Robot.PositionX < 3.0
        self.pre_conditions += Robot.PositionX < "left"
        self.post_conditions += Arm.contain(Box)
"""
