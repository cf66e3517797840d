"""The example in real SkiROS2: its world model loads what `ezskiros owl` writes, and the scene; its
visitor runs the task. The how-to shows the same with a ROS master.
"""
# mypy: disable-error-code="no-untyped-call,no-any-return"

from __future__ import annotations

import shutil
import sys
from collections.abc import Iterator
from itertools import count
from pathlib import Path
from types import SimpleNamespace

import pytest

from ezskiros.hosts.owl_files import owl_files
from ezskiros.ontology import load
from support import skiros2_core
from support.ontologies import HALL
from support.parts import SKIROS2, needs

EXAMPLE = HALL.parent
LIBRARY = "pick_place_library"
LABEL = "skiros:heron"
"""The label of the robot: the launch file of the example has both parts of it."""

pytestmark = [
    needs(SKIROS2),
    pytest.mark.filterwarnings("ignore::DeprecationWarning"),  # of what SkiROS2 uses
]


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """The folder that SkiROS2's parameter `workspace_dir` names."""
    files, found = owl_files(load(HALL, relations=False))
    assert found == []
    for name, text in files.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    shutil.copy(EXAMPLE / "lab.turtle", tmp_path)
    return tmp_path


@pytest.fixture
def library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """The skills of the example, under a name that no other test uses."""
    folder = tmp_path / "libraries"
    shutil.copytree(EXAMPLE / "skills", folder / LIBRARY)
    shutil.copytree(HALL, folder / "ontology")
    monkeypatch.syspath_prepend(folder)
    yield LIBRARY
    for name in [name for name in sys.modules if name.partition(".")[0] == LIBRARY]:
        del sys.modules[name]


def test_the_task_is_done(workspace: Path, library: str, monkeypatch: pytest.MonkeyPatch) -> None:
    clock = SimpleNamespace(monotonic=count(0.0, 0.1).__next__)  # nobody waits for real
    monkeypatch.setattr("ezskiros.hosts.skiros2_skills.time", clock)
    core = skiros2_core.Core(workspace, "lab.turtle")
    robot = core.labelled("cora:Robot", LABEL)
    assert robot.id == "cora:Robot-1"
    core.load(library, "pick_and_place")
    given = {
        "Object": core.labelled("skiros:Product", "cable"),
        "Gripper": core.labelled("rparts:GripperEffector", "gripper"),
        "PlacingLocation": core.labelled("skiros:Location", "shelf"),
    }
    state, reported = core.run("PickAndPlace", "pick_and_place", 500, **given)
    assert state == "Success", reported[-5:]
    assert reported[-1] == "wm_move_object Success skiros:Location-13 contains skiros:Product-10"
    shelf = core.wm.get_element("skiros:Location-13")
    contained = [each["dst"] for each in shelf.getRelations("-1", "skiros:contain")]
    assert contained == ["skiros:Product-10"]


def test_skiros2_knows_the_numbers_of_all_individuals(workspace: Path) -> None:
    core = skiros2_core.Core(workspace, "lab.turtle")
    known = {each.id.partition("-")[2] for each in core.individuals()}
    assert known == {str(number) for number in range(1, 14)}
    assert core.add("skiros:Product", "screw").id == "skiros:Product-14"


@pytest.mark.parametrize("name", ["cora", "rparts", "scalable", "skiros", "sumo"])
def test_namespaces_have_their_prefixes(workspace: Path, name: str) -> None:
    core = skiros2_core.Core(workspace, "lab.turtle")
    ontology = core.wm._ontology_query.__self__._ontology
    start = dict(ontology.ontology().namespaces())[name]
    assert load(HALL, relations=False).model.names[name] == str(start)


def test_skiros2_keeps_its_own_ontology(workspace: Path) -> None:
    core = skiros2_core.Core(workspace, "lab.turtle")
    assert core.wm.get_type("skiros:Skill") is not None
    assert "skiros:PrimitiveSkill" in core.wm.get_sub_classes("skiros:Skill", True)
    assert "scalable:Workstation" in core.wm.get_sub_classes("skiros:Location", True)
