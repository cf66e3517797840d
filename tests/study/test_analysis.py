"""The analysis finds the effects that a simulation puts in, and none where there is none."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from pathlib import Path

import pytest
from study_kit.analysis import COMPARED, Analysis, Comparison, analyse
from study_kit.lifetimes import lifetimes
from study_kit.records import read_study
from study_kit.sessions import SessionError
from study_kit.simulate import NONE, SESSION_S, Effects, simulate
from study_kit.statistics import difference, mean, median_time


def analysed(folder: Path, participants: int, seed: int, effects: Effects) -> Analysis:
    simulate(folder, participants, seed, effects)
    return analyse(read_study(folder))


def compared(found: Analysis) -> Mapping[tuple[str, str, str], Comparison]:
    return {(each.measure, each.ours, each.plain): each for each in found.comparisons}


def test_effects_that_were_put_in_are_found(tmp_path: Path) -> None:
    found = compared(analysed(tmp_path / "study", 16, 3, Effects()))
    for ours, plain in COMPARED:
        for measure, sign in (("fixed", 1), ("seconds", -1), ("sus", 1)):
            each = found[measure, ours, plain]
            assert each.difference.value * sign > 0
            assert each.p_adjusted < 0.05, each


def test_the_size_of_an_effect_is_in_the_interval(tmp_path: Path) -> None:
    found = analysed(tmp_path / "study", 40, 1, Effects(ours_sus=75.0, plain_sus=60.0))
    sus = compared(found)["sus", "ezskiros", "skiros2"].difference
    assert sus.low is not None
    assert sus.high is not None
    assert sus.low < 15.0 < sus.high
    assert sus.low > 0


def test_an_opposite_effect_is_found_as_one(tmp_path: Path) -> None:
    worse = Effects(ours_s=1500.0, plain_s=200.0, ours_sus=40.0, plain_sus=80.0)
    found = compared(analysed(tmp_path / "study", 16, 3, worse))
    assert found["seconds", "ezskiros", "skiros2"].difference.value > 0
    assert found["seconds", "ezskiros", "skiros2"].p_adjusted < 0.05
    assert found["sus", "ezskiros", "skiros2"].difference.value < 0


def test_no_effect_is_found_where_there_is_none(tmp_path: Path) -> None:
    """At a false discovery rate of 5 %, three studies of ten with a finding are beyond chance."""
    wrong = [
        seed
        for seed in range(10)
        if any(
            each.p_adjusted < 0.05
            for each in analysed(tmp_path / str(seed), 16, seed, NONE).comparisons
        )
    ]
    assert len(wrong) < 3, wrong


def test_codes_vanish_when_their_faults_are_fixed(tmp_path: Path) -> None:
    found = analysed(tmp_path / "study", 40, 1, Effects(ours_s=200.0))
    codes = {each.code: each for each in found.codes}
    assert set(codes) >= {"ROSS302", "ROSS703", "EZS401", "EZS551"}
    times = [each.median_s for each in codes.values() if each.median_s is not None]
    assert 60.0 < sum(times) / len(times) < 300.0  # the median of the distribution is 139 s
    unfound = [each for each in found.faults if each.fault == "wrong-direction"]
    assert {each.condition for each in unfound} == {"rossmarie", "python", "cpp"}


def run(second: int, *findings: str, file: str = "a.ross") -> dict[str, object]:
    return {
        "time": f"2030-01-01T09:00:{second:02d}.000+00:00",
        "files": [{"name": file}],
        "findings": [{"code": code, "file": file} for code in findings],
    }


def test_a_finding_vanishes_comes_back_and_stays() -> None:
    found = lifetimes([run(0, "A"), run(10), run(20, "A"), run(50, "A", "B")])
    told = [(each.code, each.seconds, each.vanished, each.came_back) for each in found]
    assert sorted(told) == [
        ("A", 10.0, True, False),
        ("A", 30.0, False, True),
        ("B", 0.0, False, False),
    ]


def test_one_of_two_findings_of_a_code_vanishes() -> None:
    found = lifetimes([run(0, "A"), run(10, "A", "A"), run(30, "A")])
    assert sorted((each.seconds, each.vanished) for each in found) == [(20.0, False), (30.0, True)]


def test_a_run_over_another_file_says_nothing() -> None:
    found = lifetimes([run(0, "A"), run(10, file="b.ross"), run(20)])
    assert [(each.seconds, each.vanished) for each in found] == [(20.0, True)]


def test_times_without_an_end_are_lower_bounds() -> None:
    assert median_time([10.0, 20.0, 30.0, 40.0], [True, True, True, True]) == 20.0
    assert median_time([10.0, 20.0, 30.0, 40.0], [True, False, True, True]) == 30.0
    assert median_time([10.0, 20.0], [False, False]) is None


def test_small_groups_have_exact_tests_and_no_invented_intervals() -> None:
    assert difference([1.0], [2.0, 3.0]) is None
    found = difference([1.0, 2.0, 3.0], [7.0, 8.0, 9.0])
    assert found is not None
    assert found.p == pytest.approx(2 / 20)
    alone = mean([50.0])
    assert (alone.low, alone.high) == (None, None)
    assert mean([50.0, 50.0]).low is None


def change(path: Path, column: str, value: str) -> None:
    with path.open(newline="", encoding="utf-8") as opened:
        rows = list(csv.DictReader(opened))
    rows[0][column] = value
    with path.open("w", newline="", encoding="utf-8") as opened:
        table = csv.DictWriter(opened, rows[0])
        table.writeheader()
        table.writerows(rows)


@pytest.mark.parametrize(
    ("column", "value", "reason"),
    [
        ("sus3", "6", "questionnaire.csv:2:1: `sus3` is '6', not one of 1 to 5"),
        ("sus3", "", "questionnaire.csv:2:1: `sus3` is '', not one of 1 to 5"),
        ("condition", "rust", "questionnaire.csv:2:1: a condition is one of"),
    ],
)
def test_a_wrong_answer_has_its_place(tmp_path: Path, column: str, value: str, reason: str) -> None:
    simulate(tmp_path / "study", 1, 1, NONE)
    change(tmp_path / "study" / "questionnaire.csv", column, value)
    with pytest.raises(SessionError) as caught:
        read_study(tmp_path / "study")
    assert reason in str(caught.value)


def test_a_judgement_replaces_the_text(tmp_path: Path) -> None:
    simulate(tmp_path / "study", 1, 1, Effects(ours_s=1e9, plain_s=1e9))
    (tmp_path / "study" / "judgements.csv").write_text(
        "participant,condition,fault,verdict,seconds\n"
        "P01,rossmarie,no-timeout,fixed,100\n"
        "P01,rossmarie,wrong-direction,found,\n"
    )
    (attempt,) = (
        each for each in read_study(tmp_path / "study").attempts if each.condition == "rossmarie"
    )
    by_fault = {each.fault: each for each in attempt.outcomes}
    assert (by_fault["no-timeout"].is_fixed, by_fault["no-timeout"].seconds) == (True, 100.0)
    assert by_fault["wrong-direction"].is_found
    assert not by_fault["wrong-direction"].is_fixed
    assert by_fault["wrong-direction"].seconds == SESSION_S
    assert not by_fault["swapped-ends"].is_found


@pytest.mark.parametrize(
    ("answers", "score"),
    [((5, 1) * 5, 100.0), ((1, 5) * 5, 0.0), ((3,) * 10, 50.0), ((4, 2) * 5, 75.0)],
)
def test_the_score_is_that_of_brooke(answers: tuple[int, ...], score: float) -> None:
    from study_kit.records import Answers

    assert Answers("P01", "rossmarie", answers).score == score


def test_the_figure_shows_both_tasks_and_the_scores(tmp_path: Path) -> None:
    from study_kit.figure import draw

    simulate(tmp_path / "study", 8, 1, Effects())
    draw(read_study(tmp_path / "study"), tmp_path / "figure.svg")
    text = (tmp_path / "figure.svg").read_text(encoding="utf-8")
    assert text.startswith("<?xml")
    assert len(text) > 10_000
