"""`ezskiros check --fix`, as users call it, and what it writes."""

from __future__ import annotations

import subprocess
from pathlib import Path
from textwrap import dedent

import pytest

from ezskiros.repair.pre_conditions import with_pre_conditions
from support import command_line
from support.skills import ONTOLOGY

PARTS = ONTOLOGY.parent / "contract_parts.py"
SKILLS = '''\
from contract_parts import Burn, Drive, Fill, Grab, Put, cora, rparts, skiros

from ezskiros import SkillDescription


class Fetch(SkillDescription):
    """Fetches something."""

    def description(self, Robot: cora.Robot, Gripper: rparts.GripperEffector,
                    Object: skiros.Product, From: skiros.Location):  # all of it

        self.pre_conditions += Robot.at( From )  # it is there

        # and then
        self.post_conditions += Gripper.contain(Object)


class fetch(Fetch.SkillBase):
    def expandBT(self, params):
        self.serialstar(Grab())


class Outer(SkillDescription):
    def description(me, Robot: cora.Robot, Gripper: rparts.GripperEffector,
                    Piece: skiros.Product, From: skiros.Location): pass


class outer(Outer.SkillBase):
    def expandBT(self, params):
        self.serialstar(Fetch(Object=params.Piece))
'''


def run(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    words = ["check", *arguments, "--ontology", str(ONTOLOGY)]
    return command_line.run("ezskiros", *words, folder=folder)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "contract_parts.py").write_text(PARTS.read_text())
    (tmp_path / "skills.py").write_text(SKILLS)
    return tmp_path


def test_what_is_missing_is_added_and_all_else_stays(folder: Path) -> None:
    assert "EZS551" in run(folder, "skills.py").stdout
    done = run(folder, "--fix", "skills.py")
    assert "EZS551" not in done.stdout
    assert done.stderr.splitlines() == [
        "skills.py: added to `Fetch`:",
        "    self.pre_conditions += From.contain(Object)",
        "skills.py: added to `Outer`:",
        "    self.pre_conditions += Robot.at(From)",
        "    self.pre_conditions += From.contain(Piece)",
    ]
    fetched = SKILLS.replace(
        "# it is there\n", "# it is there\n        self.pre_conditions += From.contain(Object)\n"
    )
    expected = fetched.replace(
        "From: skiros.Location): pass\n",
        "From: skiros.Location):\n"
        "        me.pre_conditions += Robot.at(From)\n"
        "        me.pre_conditions += From.contain(Piece)\n",
    )
    assert (folder / "skills.py").read_text() == expected


def test_twice_changes_nothing(folder: Path) -> None:
    run(folder, "--fix", "skills.py")
    before = (folder / "skills.py").read_bytes()
    done = run(folder, "--fix", "skills.py")
    assert done.stderr == ""
    assert (folder / "skills.py").read_bytes() == before


def test_what_would_exclude_what_is_asked_for_is_not_added(folder: Path) -> None:
    two_trees = SKILLS + dedent("""

        class fetch_elsewhere(Fetch.SkillBase):
            def expandBT(self, params):
                self.serialstar(Away())


        class Away(SkillDescription):
            def description(self, From: skiros.Location, Object: skiros.Product):
                self.pre_conditions += ~From.contain(Object)


        class away(Away.SkillBase):
            def execute(self):
                return self.success("away")
    """)
    (folder / "skills.py").write_text(two_trees)
    done = run(folder, "--fix", "skills.py")
    assert "~From.contain" not in done.stderr
    assert "EZS550" in done.stdout


def test_fix_and_watch_are_two_things(folder: Path) -> None:
    done = run(folder, "--fix", "--watch", "skills.py")
    assert done.returncode == 2
    assert "not both" in done.stderr


LINE = "self.pre_conditions += A.at(B)"


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (
            "class S(D):\n  def description(self):\n    'Does.'\n    self.post_conditions += A.b\n",
            "class S(D):\n  def description(self):\n    'Does.'\n"
            f"    {LINE}\n    self.post_conditions += A.b\n",
        ),
        (
            "class S(D):\r\n\tdef description(self):\r\n\t\t...\r\n",
            f"class S(D):\r\n\tdef description(self):\r\n\t\t{LINE}\r\n",
        ),
        (
            "class S(D):\n    def description(self):\n        if x:\n"
            "            self.pre_conditions += A.c(B)\n        y()\n",
            "class S(D):\n    def description(self):\n        if x:\n"
            f"            self.pre_conditions += A.c(B)\n        {LINE}\n        y()\n",
        ),
    ],
)
def test_where_a_condition_is_written(before: str, after: str) -> None:
    assert with_pre_conditions(before, "S", [LINE]) == after


@pytest.mark.parametrize(
    "text",
    [
        "class T(D):\n    def description(self):\n        pass\n",
        "class S(D):\n    description = other\n",
        "class S(D):\n    def inner(self):\n        def description(self):\n            pass\n",
        "class S(D:\n",
    ],
)
def test_a_description_that_is_not_there_is_left(text: str) -> None:
    assert with_pre_conditions(text, "S", [LINE]) is None


@pytest.mark.parametrize(
    ("header", "is_done"),
    [
        ("", False),
        ("from ezskiros import of_type\nx = load()\n", True),
        ("from ezskiros import *\nx = load()\n", True),
        ("from ezskiros import of_type\n", False),
    ],
)
def test_names_that_are_missing_are_not_invented(header: str, is_done: bool) -> None:
    text = f"{header}class S(D):\n    def description(self):\n        pass\n"
    found = with_pre_conditions(text, "S", ["self.pre_conditions += of_type(A, x.Y)"])
    assert (found is not None) == is_done
