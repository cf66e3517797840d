"""The command, as users call it."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest

from support import command_line
from support.ontologies import HALL

EXAMPLE = HALL.parent


def run(*arguments: str, folder: Path) -> subprocess.CompletedProcess[str]:
    return command_line.run("ezskiros", *arguments, folder=folder)


@pytest.fixture
def broken(tmp_path: Path) -> Path:
    """A copy of listing 5 with the mistake of the thesis (Paper IV, section 6)."""
    skills = tmp_path / "skills"
    skills.mkdir()
    for name in ("__init__.py", "world.py", "pick.py"):
        text = (EXAMPLE / "skills" / name).read_text()
        (skills / name).write_text(text.replace("hasA(GraspPose)", "hasA(Gripper)"))
    (tmp_path / "ontology").symlink_to(EXAMPLE / "ontology")
    return tmp_path


def test_an_error_is_shown_at_its_place(broken: Path) -> None:
    done = run("check", "skills", folder=broken)
    assert done.returncode == 1
    assert "Object.hasA(Gripper)\n" in done.stdout
    assert "skiros:hasA a owl:ObjectProperty ;\n" in done.stdout
    assert done.stdout.endswith("1 error, 1 warning in 3 files\n")
    assert done.stderr == ""


def test_findings_for_programs(broken: Path) -> None:
    done = run("check", "skills", "--format", "json", folder=broken)
    codes = [each["code"] for each in json.loads(done.stdout)["diagnostics"]]
    assert codes.count("EZS401") == 1


def test_all_is_well() -> None:
    done = run("check", "examples/pick_place/skills", folder=EXAMPLE.parents[1])
    assert (done.returncode, done.stdout.splitlines()[-1]) == (0, "no errors in 10 files")


def test_a_path_that_leads_nowhere() -> None:
    assert run("check", "nowhere.py", folder=EXAMPLE).returncode == 2


def test_how_inferred_parameters_get_their_values() -> None:
    done = run("explain", "Pick", "skills", folder=EXAMPLE)
    assert done.returncode == 0
    lines = done.stdout.splitlines()
    assert "Robot: cora.Robot  from Workstation, by Robot.at(Workstation)" in lines[0]
    assert lines[1].endswith("any individual of this class: no pre-condition restricts the choice")
    assert lines[7] == "Object: skiros.Product  given"


def test_keys_and_outputs_are_explained(tmp_path: Path) -> None:
    text = (
        "from typing import Annotated\nfrom ezskiros.ontology import load\nfrom ezskiros import *\n"
        "skiros = load().skiros\n"
        "class Look(SkillDescription):\n"
        "    def description(\n"
        "        self,\n"
        "        Place: Annotated[skiros.Location, Key('Start place')],\n"
        "        Found: OUTPUT[skiros.Product],\n"
        "        Limit: Annotated[float, Key('Time limit (s)')] = 2.0,\n"
        "    ):\n"
        "        self.post_conditions += Place.contain(Found)\n"
    )
    (tmp_path / "skills.py").write_text(text)
    done = run("explain", "Look", "skills.py", "--ontology", str(HALL), folder=tmp_path)
    assert done.stdout.splitlines() == [
        "Place ('Start place'): skiros.Location  given",
        "Found: skiros.Product  set by the skill",
        "Limit ('Time limit (s)')  given, or 2.0",
    ]


def test_a_skill_that_is_not_there() -> None:
    done = run("explain", "Pikc", "skills", folder=EXAMPLE)
    assert (done.returncode, done.stdout) == (2, "")
    assert "there is no skill `Pikc` in these files; did you mean `Pick`?" in done.stderr


def test_the_ontology_may_be_named_by_an_option(tmp_path: Path) -> None:
    text = "from ezskiros.ontology import load\nfrom ezskiros import *\nskiros = load().skiros\n"
    skill = "class S(SkillDescription):\n    def description(self, P: skiros.Product): P.hasAA(P)\n"
    (tmp_path / "skills.py").write_text(text + skill)
    done = run("check", "skills.py", "--ontology", str(HALL), folder=tmp_path)
    assert "error[EZS301]" in done.stdout


def test_an_ontology_that_is_not_there_is_reported_even_if_no_skill_loads_it(
    tmp_path: Path,
) -> None:
    (tmp_path / "skills.py").write_text("from ezskiros import *\nclass S(SkillDescription): pass\n")
    done = run("check", "skills.py", "--ontology", "nowhere", folder=tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    assert "'nowhere' does not exist" in done.stderr
