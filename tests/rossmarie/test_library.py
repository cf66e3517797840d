"""Each file of the library: what it says of itself, its findings, its tests, and its proof."""

from __future__ import annotations

from pathlib import Path

import pytest

from rossmarie.driver.testing import run_test_file
from rossmarie.driver.verifying import prove, queries_of
from rossmarie.testing.goals import Aspect
from rossmarie.verification.prover import ProofVerdict, Prover
from support.command_line import run
from support.generated import generated_tests
from support.library import BOUNDARIES, LABELS, library_files, name_of, paragraphs, rules_of
from support.parts import PROVER, needs

_DECIDING = (Aspect.ACTIVE, Aspect.CLEARED, Aspect.TRUE, Aspect.FALSE)

FILES = library_files()
WITH_RULES = [path for path in FILES if rules_of(path)]

of_all = pytest.mark.parametrize("path", FILES, ids=name_of)
of_rules = pytest.mark.parametrize("path", WITH_RULES, ids=name_of)


@of_all
def test_the_first_line_says_that_nothing_is_certified(path: Path) -> None:
    assert path.read_text(encoding="utf-8").startswith("// Not certified")


@of_all
def test_a_file_has_no_findings(path: Path) -> None:
    found = run("rossmarie", "check", path, is_merged=True)
    assert found.stdout == "no errors in 1 file\n"
    assert found.returncode == 0


@of_rules
def test_each_rule_says_its_hazard_its_limit_and_how_the_number_is_derived(path: Path) -> None:
    for rule in rules_of(path):
        says = paragraphs(rule.documentation or "")
        assert rule.name is not None
        assert [label for label in LABELS if label in says] == list(says), rule.name.text
        assert {*LABELS[:3]} <= {*says}, rule.name.text
        parts = (rule.steps, rule.mitigates, rule.category, rule.task)
        assert all(parts), rule.name.text


@pytest.mark.parametrize("folders", [("base", "scan"), ("arm", "gripper", "people")], ids="-".join)
def test_files_of_a_robot_go_together(folders: tuple[str, ...], tmp_path: Path) -> None:
    shared = ("health", "power")
    commands = "" if "base" in folders else " with commands = /servo_node/delta_twist_cmds"
    imports = [
        f'import "rossmarie/{name_of(path)}"{commands if path.parent.name in shared else ""} '
        f"as {path.parent.name}_{path.stem};\n"
        for path in WITH_RULES
        if path.parent.name in (*folders, *shared)
    ]
    main = tmp_path / "robot.ross"
    model = (
        "system robot { frame base_link in world at [0, 0, 0] m; topic /odom : nav_msgs/Odometry;"
        " topic /tcp_pose : geometry_msgs/PoseStamped from base_link; }\n"
    )
    main.write_text(model + "".join(imports), encoding="utf-8")
    found = run("rossmarie", "check", main, is_merged=True)
    assert found.stdout == "no errors in 1 file\n"


def test_there_are_forty_rules() -> None:
    names = [rule.name.text for path in WITH_RULES for rule in rules_of(path) if rule.name]
    assert len(names) >= 40


@of_rules
def test_the_tests_of_a_file_pass_and_decide_every_condition(path: Path) -> None:
    outcome = run_test_file(path)
    assert [finding.title for ran in outcome.ran for finding in ran.found] == []
    assert [finding.title for finding in outcome.findings] == []
    assert outcome.has_c
    missing = [goal for goal in outcome.coverage.goals if goal not in outcome.coverage.reached]
    assert [goal for goal in missing if goal.aspect in _DECIDING] == []


@of_rules
def test_the_generated_tests_are_those_of_the_rules(path: Path, bless: bool) -> None:
    written = generated_tests(path)
    beside = path.with_name(path.stem + BOUNDARIES)
    if bless:
        beside.write_text(written, encoding="utf-8")
    assert beside.read_text(encoding="utf-8") == written


@pytest.mark.deep
@needs(PROVER)
@of_rules
def test_the_generated_c_of_a_file_is_proved(path: Path) -> None:
    proofs = prove(queries_of(path), Prover(), seconds=120)
    unproved = [each for each in proofs.outcomes if each.verdict is not ProofVerdict.PROVED]
    assert [outcome.check.about for outcome in unproved] == []
