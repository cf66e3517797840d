"""The planted faults: each tool finds exactly those that the list says it finds."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest
from study_kit import tools
from study_kit.faults import (
    CONDITIONS,
    KIT,
    Condition,
    State,
    plant,
    planted_in,
    read_faults,
    states,
)
from study_kit.matrix import PAGE, Answers, answers, matrix_text

from support.parts import GXX, needs

needs_cpp = needs(GXX)
each_condition = pytest.mark.parametrize(
    "condition", CONDITIONS.values(), ids=lambda each: each.name
)


@pytest.fixture(scope="module")
def found() -> Answers:
    return answers()


@needs_cpp
def test_each_fault_is_found_as_the_list_says(found: Answers) -> None:
    wrong = []
    for fault in read_faults():
        for name, variant in fault.variants.items():
            got = found.get((name, fault.id), ())
            if variant.absent:
                is_right = not got
            elif CONDITIONS[name].is_ours:
                is_right = set(variant.codes) <= set(got) and bool(variant.codes) == bool(got)
            else:
                is_right = list(got) == [variant.stage]
            if not is_right:
                wrong.append((name, fault.id, got))
    assert wrong == []


@needs_cpp
def test_the_matrix_is_made_of_the_answers(found: Answers, bless: bool) -> None:
    text = matrix_text(found)
    if bless:
        PAGE.write_text(text, encoding="utf-8")
    assert PAGE.read_text(encoding="utf-8") == text


@needs_cpp
@each_condition
def test_no_tool_finds_anything_in_a_model_solution(condition: Condition, tmp_path: Path) -> None:
    file = tools.lay_out(condition, condition.solution, tmp_path / "task")
    if condition.is_ours:
        assert tools.codes(condition, file) == []
    else:
        assert tools.plain_stage(condition, file) == "never"
    if condition.name == "ezskiros":
        assert tools.mypy_accepts(file, is_strict=False)


@needs_cpp
def test_the_model_solutions_of_rules_agree_on_the_trace(tmp_path: Path) -> None:
    """The robot's speed, row by row; and the rules are active as long as the plain ones."""
    printed = {}
    for name in ("python", "cpp"):
        condition = CONDITIONS[name]
        folder = tools.lay_out(condition, condition.solution, tmp_path / name).parent
        printed[name] = tools.output(condition, folder)
    assert printed["python"] == printed["cpp"]
    speeds = Counter(line.split()[1] for line in printed["python"].splitlines())
    assert speeds["0.00"] > 50 < speeds["0.20"]


@needs_cpp
@pytest.mark.parametrize("name", ["python", "cpp"])
def test_each_fault_of_rules_that_no_plain_tool_finds_changes_the_robot(
    name: str, tmp_path: Path
) -> None:
    condition = CONDITIONS[name]
    right = tools.lay_out(condition, condition.solution, tmp_path / "right").parent
    expected = tools.output(condition, right)
    same = []
    for fault in read_faults():
        variant = fault.variants.get(name)
        if variant is None or variant.absent or variant.stage != "never":
            continue
        file = tools.lay_out(condition, plant(condition, [fault]), tmp_path / fault.id)
        if tools.output(condition, file.parent) == expected:
            same.append(fault.id)
    assert same == []


@each_condition
def test_a_starting_file_has_all_its_faults_and_a_solution_none(condition: Condition) -> None:
    start = plant(condition, planted_in(condition))
    assert len(planted_in(condition)) == 8
    assert set(states(condition, start).values()) == {State.KEPT}
    assert set(states(condition, condition.solution).values()) == {State.FIXED}


@each_condition
def test_each_repair_is_seen_by_itself(condition: Condition) -> None:
    planted = planted_in(condition)
    for repaired in planted:
        text = plant(condition, [each for each in planted if each is not repaired])
        fixed = [name for name, state in states(condition, text).items() if state is State.FIXED]
        assert fixed == [repaired.id]


def test_another_text_is_for_the_leader_to_judge() -> None:
    condition = CONDITIONS["rossmarie"]
    text = condition.solution.replace("level = [-10, 10] deg", "level = [-10.0, 10.0] deg")
    changed = [name for name, state in states(condition, text).items() if state is State.CHANGED]
    assert changed == ["swapped-ends"]


def test_white_space_does_not_count() -> None:
    condition = CONDITIONS["python"]
    text = condition.solution.replace("FASTEST = 0.8", "FASTEST  =  0.8").replace(
        "(-0.2, 0.2)", "(-0.2,0.2)"
    )
    assert set(states(condition, text).values()) == {State.FIXED}


def test_one_fault_of_each_task_is_found_by_no_check() -> None:
    for name in ("rossmarie", "ezskiros"):
        condition = CONDITIONS[name]
        codes = [each.variants[name].codes for each in planted_in(condition)]
        assert codes.count(()) == 1


def test_a_participant_does_not_get_the_list() -> None:
    texts = [each for each in (KIT / "tasks").rglob("*") if each.is_file()]
    names = {each.id for each in read_faults()}
    assert [path for path in texts if any(name in path.read_text("utf-8") for name in names)] == []
