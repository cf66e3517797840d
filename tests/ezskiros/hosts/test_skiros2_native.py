"""Values in SkiROS2 without our host: skills by its own API have the values that are recorded, and
those that our engine has with `--compatible`.
"""
# mypy: disable-error-code="no-untyped-call"

from __future__ import annotations

import sys
from collections.abc import Iterator
from itertools import count
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from ezskiros.engine.blackboard import Remaps
from support import random_values, skiros2_core, skiros2_individuals, skiros2_values
from support.depth import examples
from support.native_trees import renamed
from support.parts import SKIROS2, needs

pytestmark = [
    needs(SKIROS2),
    pytest.mark.filterwarnings("ignore::DeprecationWarning"),  # of what SkiROS2 uses
]
_numbers = count()


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder with packages that can be imported."""
    monkeypatch.syspath_prepend(tmp_path)
    known = {*sys.modules}
    yield tmp_path
    for name in {*sys.modules} - known:
        if str(getattr(sys.modules[name], "__file__", "")).startswith(str(tmp_path)):
            del sys.modules[name]


def library(folder: Path, text: str) -> str:
    """A package with skills by SkiROS2's API; its name."""
    package = folder / f"native{next(_numbers)}"
    package.mkdir()
    (package / "__init__.py").touch()
    (package / "skills.py").write_text(text)
    return package.name


def reported(found: list[str], states: tuple[str, ...]) -> Iterator[str]:
    """The texts of the primitives that end so."""
    for each in found:
        label, state, text = each.split(" ", 2)
        if state in states and label != "task":
            yield text


@pytest.mark.parametrize(("tree", "recorded"), skiros2_values.TREES, ids=skiros2_values.IDS)
def test_values_in_skiros2_are_those_that_are_recorded(
    folder: Path, tree: str, recorded: list[str]
) -> None:
    core = skiros2_core.Core()
    core.load(library(folder, skiros2_values.skills(tree)), "task")
    state, found = core.run("Task", "task", Mine=8.0)
    assert (state, [*reported(found, ("Success", "Failure"))]) == ("Success", recorded)


@pytest.mark.parametrize(
    ("tree", "succeeds", "recorded"), skiros2_individuals.TREES, ids=skiros2_individuals.IDS
)
def test_individuals_in_skiros2_are_those_that_are_recorded(
    folder: Path, tree: str, succeeds: bool, recorded: list[str]
) -> None:
    core = skiros2_core.Core()
    core.load(library(folder, skiros2_individuals.native_skills(tree)), "task")
    individuals = {
        "A": core.add("skiros:Location", "bench"),
        "B": core.add("skiros:Location", "shelf"),
    }
    individuals["Object"], _ = product(core, "nut"), product(core, "bolt")
    state, found = core.run("Task", "task", **individuals)
    assert (state == "Success", [*reported(found, ("Success",))]) == (succeeds, recorded)


def product(core: Any, label: str) -> Any:
    """A heavy one."""
    found = core.add("skiros:Product", label)
    found.setProperty("skiros:Weight", 2.0)
    core.wm.update_element(found)
    return found


# --- random trees ---------------------------------------------------------------------------------


@settings(max_examples=examples(0.3), suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(seed=st.integers(0, 10**6))
def test_random_skills_have_the_same_values_in_both(folder: Path, core: Any, seed: int) -> None:
    skills = random_values.skills_of(seed)
    assert random_values.noted_here(skills, folder) == theirs(folder, core, skills)


@pytest.mark.parametrize("seed", random_values.recorded())
def test_what_random_skills_note_is_recorded(folder: Path, core: Any, seed: int) -> None:
    skills = random_values.skills_of(seed)
    assert theirs(folder, core, skills) == random_values.recorded()[seed]


@pytest.fixture
def core() -> Any:
    return skiros2_core.Core()


def theirs(folder: Path, core: Any, skills: list[random_values.Skill]) -> list[str]:
    """The notes of the skills in SkiROS2, and the state after each tick."""
    core.forget()
    core.load(library(folder, random_values.natively(skills)), *(each.label for each in skills))
    random_values.LOG.clear()
    for state, _ in core.ticks("Task", "task", random_values.MOST_TICKS):
        random_values.LOG.append(f"= {state.name}")
    return [*random_values.LOG]


renamings = st.dictionaries(st.sampled_from("ABCDE"), st.sampled_from(["Robot", *"ABCDE"]))


@given(st.sets(st.sampled_from("ABCD"), min_size=1), renamings, st.lists(renamings, max_size=3))
def test_keys_are_renamed_as_in_skiros2(
    own: set[str], call: dict[str, str], above: list[dict[str, str]]
) -> None:
    """The renamings of a child, and of the skills above it, which have all letters for keys."""
    skills = [*((each, set("ABCDE")) for each in above), (call, own)]
    remaps = Remaps([])
    for each, keys in skills:
        remaps_above, remaps = remaps, Remaps(keys)
        for key, other in each.items():
            remaps.add(key, other)
        remaps.add_all(remaps_above)
    found, back = renamed(skills)
    assert remaps.by_own() == found
    assert all(key == own for own, key in back.items()), "no value gets stale on the way back"
