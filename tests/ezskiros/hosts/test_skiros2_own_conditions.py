"""SkiROS2 and the engine choose the same implementation for a child that names none."""
# mypy: disable-error-code="no-untyped-call"

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest

from support import skiros2_core
from support.own_conditions import NATIVE, PAIRS, TREES, skills
from support.parts import SKIROS2, needs

pytestmark = [
    needs(SKIROS2),
    pytest.mark.filterwarnings("ignore::DeprecationWarning"),  # of what SkiROS2 uses
]
PRIMITIVES = ("lift", "shove", "leave")


def individuals(core: Any) -> dict[str, Any]:
    """The nut, the bolt and the feather."""
    found = {}
    for label, weight in {"nut": 2.0, "bolt": 5.0, "feather": None}.items():
        found[label] = core.add("skiros:Product", label)
        if weight is not None:
            found[label].setProperty("skiros:Weight", weight)
            core.wm.update_element(found[label])
    return found


def reported(found: list[str]) -> list[str]:
    """The texts of the primitives that have succeeded."""
    parts = (each.split(" ", 2) for each in found)
    return [text for label, state, text in parts if state == "Success" and label in PRIMITIVES]


ORDERS = [("lift", "push", "leave"), ("leave", "push", "lift"), ()]


@pytest.mark.parametrize("loaded", ORDERS, ids=["loaded", "turned round", "not loaded"])
@pytest.mark.parametrize(("one", "tree", "expected"), TREES)
def test_the_implementation_whose_conditions_hold_is_taken(
    package: Any, one: str, tree: str, expected: list[str] | str, loaded: tuple[str, ...]
) -> None:
    name = package("library", skills(tree))
    core = skiros2_core.Core()
    core.load(name, *loaded, "task")
    known = individuals(core)
    state, found = core.run("Task", "task", One=known[one], Object=known["feather"])
    if isinstance(expected, str):
        assert state == "Failure"
        assert reported(found) == []
    else:
        assert reported(found) == expected
        assert (state == "Success") or "inverter" in tree


def test_the_order_in_which_skiros2_has_loaded_them_counts(package: Any) -> None:
    """The first of the file can always start, and SkiROS2 has loaded another one before it."""
    conditions = "    def conditions(self, Object):\n        self.pre_conditions += "
    text = skills("Move(Object=params.One)").replace(f"{conditions}Object.Weight == 2.0\n", "")
    name = package("library", text)
    for one, expected in (("feather", ["left feather"]), ("nut", ["lifted nut"])):
        core = skiros2_core.Core()
        core.load(name, "leave", "lift", "task")
        known = individuals(core)
        state, found = core.run("Task", "task", One=known[one], Object=known["feather"])
        assert (state, reported(found)) == ("Success", expected)


@pytest.mark.parametrize(("one", "two", "expected"), PAIRS)
def test_skiros2_itself_takes_the_first(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, one: str, two: str, expected: list[str]
) -> None:
    monkeypatch.syspath_prepend(tmp_path)
    folder = tmp_path / f"native_{one}"
    folder.mkdir()
    (folder / "__init__.py").touch()
    (folder / "skills.py").write_text(NATIVE)
    core = skiros2_core.Core()
    core.load(folder.name, "lift", "push", "leave", "shove", "task")
    known = individuals(core)
    state, found = core.run("Task", "task", One=known[one], Two=known[two])
    lifted = expected if expected[0] == "lifted nut" else []
    assert (state, reported(found)) == ("Failure", lifted[:1])
    for module in [each for each in sys.modules if each.partition(".")[0] == folder.name]:
        del sys.modules[module]
