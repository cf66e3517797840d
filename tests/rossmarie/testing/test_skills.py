"""Skills in tests: those that are written run, and generated tests and witnesses say which run."""

from __future__ import annotations

from pathlib import Path

import pytest

from rossmarie import ir
from rossmarie.analysis.errors import NeverActive
from rossmarie.driver.analyze import analyze_file
from rossmarie.driver.generating import generate_tests
from rossmarie.driver.pipeline import compile_file
from rossmarie.driver.testing import run_test_file
from rossmarie.testing.play import steps_of
from support.rule_skills import HEAD

RULES = (
    HEAD.replace("N;", "N timeout 1 sec;")
    + """\
input weight = doing Push.Object.Weight;
rule contact: if force > 5 N then { stop; }
    unless doing Push(Object: Fragile) then if force > 20 N then { stop; };
rule heavy: if doing Push and weight > 3 kg then { stop; };
rule shelf: if force > 3 N while doing Drive(Target: Shelf), doing Insert then { stop; };
"""
)


def sent(folder: Path, *settings: str) -> list[dict[str, float]]:
    """The answers in the messages that settings make, one after the other."""
    statements = [f"at {second} s {each};" for second, each in enumerate(settings)]
    path = folder / "rules.ross"
    path.write_text(f'{RULES}test "a" {{ {" ".join(statements)} expect heavy active at 9 s; }}')
    compiled = compile_file(path)
    machine = compiled.machine
    (script,) = compiled.tests
    topics = [channel.topic for channel in machine.channels]
    found = []
    for step in steps_of(machine, script):
        slots = step.messages[topics.index("/skill_context")].slots
        named = {str(machine.slots[slot].path[0]): value for slot, value in slots.items()}
        found.append({name: value for name, value in named.items() if value})
    return found


FRAGILE, SHELF = "doing Push(Object: Fragile)", "doing Drive(Target: Shelf)"


def test_exactly_the_skills_run_that_are_written(tmp_path: Path) -> None:
    found = sent(
        tmp_path,
        "doing Push(Object: skiros.Box), weight = 2 kg",
        "doing",
        "doing Push(Object: Glass), doing Drive(Target: Shelf), weight = unknown",
        "doing Drive",
        "doing nothing",
    )
    weight = "Push.Object.Weight"
    assert found[0] == {"doing Push": 1.0, weight: 2.0}
    assert found[1] == found[0]
    assert {name: found[2][name] for name in ("doing Push", FRAGILE, SHELF)} == {
        "doing Push": 1.0,
        FRAGILE: 1.0,
        SHELF: 1.0,
    }
    assert found[3].keys() <= {weight}
    assert found[4].keys() <= {weight}


def test_generated_tests_say_which_skills_run_and_pass(tmp_path: Path) -> None:
    path = tmp_path / "rules.ross"
    path.write_text(RULES)
    written = generate_tests(path)
    assert "doing Push(Object: skiros.Fragile);" in written.text
    assert "skill_context" not in "".join(
        line for line in written.text.splitlines() if not line.startswith("test")
    )
    written.path.write_text(written.text)
    outcome = run_test_file(path)
    assert [one.title for ran in outcome.ran for one in ran.found] == []
    missing = set(outcome.coverage.goals) - outcome.coverage.reached
    assert len(missing) <= len(outcome.coverage.goals) / 10


@pytest.mark.parametrize(
    ("condition", "is_never"),
    [
        ("doing Push(Object: Fragile) and not doing Push", True),
        ("doing Push(Object: Fragile) and not doing Push(Object: Glass)", False),
        ("doing Push(Object: skiros.Box) and doing Push(Object: Fragile)", False),
        ("doing Push and not doing Push(Object: Product)", False),
        ("doing Drive and not doing Move", True),
        ("doing Move and not doing Drive", False),
    ],
)
def test_queries_know_what_skills_can_answer(
    tmp_path: Path, condition: str, is_never: bool
) -> None:
    path = tmp_path / "rules.ross"
    path.write_text(HEAD + f"rule it: if {condition} and force > 1 N then {{ stop; }};")
    found = analyze_file(path, thorough=True).diagnostics
    assert (NeverActive.code in {one.code for one in found}) is is_never


def test_the_machine_without_its_calls_knows_less(tmp_path: Path) -> None:
    path = tmp_path / "rules.ross"
    path.write_text(RULES)
    machine = compile_file(path).machine
    assert [call.text for call in machine.calls][:2] == [
        "doing Drive(Target: skiros.Shelf)",
        "doing Push",
    ]
    assert ir.SkillCall("Insert", (("Object", "skiros.Product"),), "doing Insert") in machine.calls
