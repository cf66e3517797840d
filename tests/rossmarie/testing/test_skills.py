"""Skills that run in tests that nobody wrote, and in tests that show a finding."""

from __future__ import annotations

import shutil
from pathlib import Path

from rossmarie import ir
from rossmarie.driver import compile_file
from rossmarie.driver.generating import generate_tests
from rossmarie.ir.script import Script
from rossmarie.testing.run import expectations_of

RULES = Path(__file__).parents[2] / "fixtures" / "skillful"


def test_tests_of_boundaries_let_skills_run(tmp_path: Path) -> None:
    rules = Path(shutil.copytree(RULES, tmp_path / "rules")) / "skillful.ross"
    found = generate_tests(rules)
    assert "doing Push(Object: skiros.Fragile)" in found.text
    path = rules.with_name("skillful.tests.ross")
    path.write_text(found.text, encoding="utf-8")
    compiled = compile_file(path)
    scripts = {each.name: each for each in compiled.tests}
    for name in ("doing Push(Object: Fragile)", "skill_context falls silent"):
        script = scripts[f"contact: {name}"]
        assert shows_both(compiled.machine, script), name
    assert "heavy: weight > 5 kg, around 5 kg" in scripts


def shows_both(machine: ir.Machine, script: Script) -> bool:
    """Say whether the rule `contact` is active and cleared, as the test expects."""
    rule = next(index for index, each in enumerate(machine.rules) if each.name == "contact")
    last_ns = max(each.last_ns for each in script.expectations)
    own = expectations_of(machine, script, rule, last_ns)
    assert {each.is_active for each in own} == {True, False}
    expected = [(each.first_ns, each.is_active) for each in script.expectations]
    return expected == [(each.first_ns, each.is_active) for each in own]


def test_a_quantity_is_unknown_while_no_skill_has_it(tmp_path: Path) -> None:
    rules = Path(shutil.copytree(RULES, tmp_path / "rules")) / "skillful.ross"
    text = """
test "weights" {
    every 0.1 s from 0 s to 2 s force;
    at 0 s doing Push(Object: Glass), weight = 7 kg;
    at 0.5 s doing nothing;
    at 1 s doing Push(Object: Glass), doing Push;
    at 1.5 s doing Push;
    expect light active from 0.5 s until 1.5 s;
    expect light inactive from 1.5 s to 2 s;
}
rule light: if not (weight > 5 kg) then { creep; };
"""
    rules.write_text(rules.read_text(encoding="utf-8") + text, encoding="utf-8")
    compiled = compile_file(rules)
    rule = next(i for i, each in enumerate(compiled.machine.rules) if each.name == "light")
    own = expectations_of(compiled.machine, compiled.tests[0], rule, 2_000_000_000)
    found = [(each.first_ns, each.is_active) for each in own]
    assert found == [(0, False), (500_000_000, True), (1_500_000_000, False)]
