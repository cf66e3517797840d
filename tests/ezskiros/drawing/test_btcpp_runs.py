"""BehaviorTree.CPP itself loads what is exported, and gives the results of real SkiROS2."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from ezskiros.drawing.btcpp import export
from ezskiros.driver import Checked, trees_of
from support.btcpp import played
from support.parts import BEHAVIOR_TREE_CPP, TRACES, needs
from support.shared import SKIROS2_TRACES
from support.tree_files import checked_text

STARTED_AGAIN = {"ParallelFf RRS,RS"}
"""Trees in which SkiROS2 restarts finished children and EzSkiROS does not."""
pytestmark = needs(BEHAVIOR_TREE_CPP)


def exported(found: Checked, skill: str, depth: int) -> str:
    text, said = export(trees_of(skill, found), found.trees, found.library, depth=depth)
    assert list(said) == []
    return text


@pytest.mark.parametrize("depth", [0, 1])
def test_it_loads_a_tree(gripping: Checked, depth: int, tmp_path: Path) -> None:
    happened = played(exported(gripping, "fetch", depth), tmp_path, {})
    assert happened[-1].endswith("=S")


ACTIONS = "".join(
    f"class Skill_{name}(SkillDescription):\n    def description(self): pass\n"
    f"class {name}(Skill_{name}.SkillBase):\n    def execute(self): return self.success('')\n"
    for name in "abc"
)


def rows() -> dict[str, list[str]]:
    """The recorded traces whose processors there is a word for, with scripts for each child."""
    known = json.loads(SKIROS2_TRACES.read_text("utf-8"))
    return {
        row: ticks for row, ticks in known.items() if " " in row and "NoFail(Serial)" not in row
    }


def body(row: str) -> str:
    head, _, scripts = row.partition(" ")
    names = [f"Skill_{name}.{name}()" for name, _ in zip("abc", scripts.split(","), strict=False)]
    outer, _, inner = head.partition(">")
    if inner:
        return f"self.{outer.lower()}(self.{inner.lower()}({names[0]}, {names[1]}), {names[2]})"
    return f"self.{'nofail' if 'NoFail' in outer else outer.lower()}({', '.join(names)})"


@needs(TRACES)
def test_results_are_those_of_skiros2(tmp_path: Path) -> None:
    written: dict[str, str] = {}
    different = set()
    for row, ticks in rows().items():
        tree = body(row)
        if tree not in written:
            text = ACTIONS + (
                "class Top(SkillDescription):\n    def description(self): pass\n"
                f"class top(Top.SkillBase):\n    def expandBT(self, params): {tree}\n"
            )
            folder = tmp_path / str(len(written))
            folder.mkdir()
            written[tree] = exported(checked_text(text, folder), "top", 0)
        scripts = dict(zip("abc", row.partition(" ")[2].split(","), strict=False))
        happened = played(written[tree], tmp_path, scripts)
        if "ParallelFf" in row:
            is_same = [each[-1] for each in happened] == [each[-1] for each in ticks]
        else:
            is_same = happened == [re.sub(r"[abc]\$", "", each) for each in ticks]
        if not is_same:
            different.add(row)
    assert different == STARTED_AGAIN
