"""Every fault of rules that know skills is noticed, whoever has it: the compiler, the Python that
answers queries, or the C++ of nodes.
"""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from random import Random
from shutil import copytree

import pytest

import rossmarie
from mutation.past_faults import Damage
from mutation.skill_faults import COMPILER, NODE
from support.depth import deep, is_deep
from support.parts import GXX, needs
from support.skill_node import RUNTIME, bits, of_node
from support.skill_tales import any_context
from support.skill_worlds import Asked, asked_of, random_world

PACKAGE = Path(rossmarie.__file__).parent
TESTS = Path(__file__).parents[1]
EXAMPLES = (
    "rossmarie/ir/test_skills.py",
    "rossmarie/lowering/test_skills.py",
    "rossmarie/lowering/test_calls.py",
    "rossmarie/skills/test_closed.py",
    "rossmarie/test_fixtures.py",
    "rossmarie/testing/test_skills.py",
)
"""Tests of skills by examples, which are distinguished from those by random rules and messages."""

FAULTS = [(file, damage) for file, found in COMPILER.items() for damage in found]
IN_EACH_RUN = FAULTS[::8]
Fault = tuple[str, Damage]


def copied(folder: Path, file: str, damage: Damage | None) -> Path:
    """A copy of the package, where one file has a fault."""
    package = Path(copytree(PACKAGE, folder / "rossmarie", copy_function=os.symlink))
    if damage is not None:
        text = (package / file).read_text("utf-8")
        assert text.count(damage.old) == 1, (text.count(damage.old), file, damage)
        (package / file).unlink()
        (package / file).write_text(text.replace(damage.old, damage.new), "utf-8")
    return folder


def run_with(copy: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Python with a copy of the package."""
    path = os.pathsep.join([str(copy), str(TESTS), *filter(None, sys.path)])
    return subprocess.run(
        [sys.executable, *arguments],
        cwd=TESTS,
        env={**os.environ, "PYTHONPATH": path, "PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True,
        text=True,
        check=False,
    )


def watched(copy: Path) -> frozenset[str]:
    """The checks that detect a difference in a copy of the package."""
    done = run_with(copy, "-m", "mutation.skill_watch")
    return frozenset([*done.stdout.splitlines(), *(["a crash"] if done.returncode else [])])


def fails_examples(copy: Path) -> bool:
    """Say whether tests by examples fail with a copy of the package."""
    options = ("-q", "-x", "-p", "no:cacheprovider", "-p", "no:randomly")
    return run_with(copy, "-m", "pytest", *options, *EXAMPLES).returncode != 0


@pytest.fixture(scope="module")
def noticed(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Mapping[Fault, frozenset[str]]]:
    faults = FAULTS if is_deep() else IN_EACH_RUN
    copies = [copied(tmp_path_factory.mktemp("damaged"), *each) for each in faults]
    with ThreadPoolExecutor(2) as pool:
        yield dict(zip(faults, pool.map(watched, copies), strict=True))


@pytest.mark.parametrize(
    "fault",
    [*IN_EACH_RUN, *deep((each,) for each in FAULTS if each not in IN_EACH_RUN)],
    ids=lambda each: f"{each[0]}: {each[1].name}",
)
def test_a_fault_is_noticed(noticed: Mapping[Fault, frozenset[str]], fault: Fault) -> None:
    assert noticed[fault]


def test_an_undamaged_copy_is_as_it_should_be(tmp_path: Path) -> None:
    assert watched(copied(tmp_path, "", None)) == frozenset()


@pytest.mark.deep
def test_the_rates_are_reported(
    noticed: Mapping[Fault, frozenset[str]],
    tmp_path: Path,
    record_property: Callable[[str, object], None],
) -> None:
    copies = []
    for number, each in enumerate(FAULTS):
        folder = tmp_path / str(number)
        folder.mkdir()
        copies.append(copied(folder, *each))
    with ThreadPoolExecutor(2) as pool:
        by_examples = sum(pool.map(fails_examples, copies))
    lines = ["mutants of rules that know skills, that are noticed"]
    lines.append(f"  by tests of examples: {by_examples} of {len(FAULTS)}")
    by_random = sum(map(bool, noticed.values()))
    lines.append(f"  by random rules and messages: {by_random} of {len(FAULTS)}")
    record_property("reported", "\n".join(lines))
    assert by_examples > len(FAULTS) / 2


# --- the C++ of nodes ----------------------------------------------------------------------------


@pytest.fixture(scope="module")
def asked(tmp_path_factory: pytest.TempPathFactory) -> Sequence[Asked]:
    random = Random(64)
    folder = tmp_path_factory.mktemp("skills")
    return [asked_of(random, random_world(random), folder) for _ in range(10)]


def is_noticed(asked: Sequence[Asked], folder: Path, damage: Damage | None) -> bool:
    """Say whether a node with a fault answers otherwise than S58 says."""
    text = (RUNTIME / "skills.h").read_text("utf-8")
    if damage is not None:
        assert text.count(damage.old) == 1, (text.count(damage.old), damage)
        text = text.replace(damage.old, damage.new)
    (folder / "skills.h").write_text(text, "utf-8")
    random = Random(65)
    worlds = [each.world for each in asked]
    contexts = [any_context(random, each, worlds) for each in worlds * 60]
    wanted = [
        [each.world.answer(one, context) for each in asked for one in each.queries]
        for context in contexts
    ]
    steps = [step for each in asked for step in each.steps()]
    found = of_node(folder, steps, contexts, folder, ("-std=c++17", "-O0", "-w"))
    return bits(found) != bits(wanted)


@needs(GXX)
def test_an_undamaged_node_answers_as_the_semantics_say(
    asked: Sequence[Asked], tmp_path: Path
) -> None:
    assert not is_noticed(asked, tmp_path, None)


@needs(GXX)
@pytest.mark.parametrize(
    "damage", [*NODE[::5], *deep(each for each in NODE if each not in NODE[::5])],
    ids=lambda each: each.name,
)  # fmt: skip
def test_a_fault_of_a_node_is_noticed(
    asked: Sequence[Asked], tmp_path: Path, damage: Damage
) -> None:
    assert is_noticed(asked, tmp_path, damage)
