"""Lessons: what is blamed for a rule, and what is counted."""

from __future__ import annotations

from pathlib import Path

from ezskiros.learning.learn import learn
from ezskiros.learning.lessons import Cost, Share, SkillFailure, Stale
from ezskiros.learning.runs import read_runs
from support.learning import (
    LOCATIONS,
    RAMP,
    SHELF,
    active,
    cleared,
    event,
    header,
    learnt,
    ran,
    refill,
    verdict,
    write,
)


def test_the_innermost_skill_is_blamed_with_its_place(tmp_path: Path) -> None:
    lessons = learnt(tmp_path, (refill(0, RAMP), [header(-1, 11), *active(2, 5)]))
    (trip,) = lessons.trips
    assert (trip.rule, trip.skill, trip.within) == ("tilting", "Drive", {"Refill": 1})
    assert (trip.activations, trip.lost_s, trip.evidence) == (1, 3.0, "found at 2")
    assert trip.at == {(("Target", RAMP),): Share(1, 1)}


def test_runs_are_counted_and_not_activations(tmp_path: Path) -> None:
    """The rule watched four runs, one with two activations and one with one; in a fifth it
    was not among the rules, and in a sixth the skill did not run.
    """
    often = [header(-1, 11), *active(2, 3), *active(4, 5)]
    once = [header(19, 31), *active(22, 23)]
    lessons = learnt(
        tmp_path,
        (refill(0, RAMP), often),
        (refill(20, RAMP), once),
        (refill(40, RAMP), [header(39, 51)]),
        (refill(60, SHELF), [header(59, 71)]),
        (refill(80, RAMP), [header(79, 91, ["another"])]),
        (ran(100, 110, "Wait"), [header(99, 111)]),
    )
    (trip,) = lessons.trips
    assert (lessons.runs, trip.share, trip.activations) == (6, Share(2, 4), 3)
    assert trip.at == {(("Target", RAMP),): Share(2, 3), (("Target", SHELF),): Share(0, 1)}


def test_several_runs_may_be_in_one_recording(tmp_path: Path) -> None:
    verdicts = [header(-1, 40), *active(2, 4), *active(15, 16), *active(22, 24)]
    files = [
        write(tmp_path / "second.jsonl", refill(20, SHELF)),
        write(tmp_path / "verdicts.jsonl", verdicts),
        write(tmp_path / "first.jsonl", refill(0, RAMP)),
    ]
    runs, wrong = read_runs(files)
    assert wrong == []
    (trip,) = learn(runs, LOCATIONS).trips
    assert (trip.share, trip.activations) == (Share(2, 2), 2)


def test_costs_are_of_skills_on_all_levels(tmp_path: Path) -> None:
    lessons = learnt(
        tmp_path,
        (refill(0, RAMP), [header(-1, 11), *active(2, 5)]),
        (refill(20, RAMP), [header(19, 31)]),
        (refill(40, SHELF), [header(39, 51)]),
    )
    drive, charge = (("Target", RAMP),), (("Station", RAMP),)
    assert [each for each in lessons.costs if RAMP in dict(each.places).values()] == [
        Cost("Drive", drive, 2, 1, 3.0),
        Cost("Refill", charge, 2, 1, 3.0),
        Cost("Charge", charge, 2, 0, 0.0),
    ]
    assert [each.expected_s for each in lessons.costs] == [1.5, 1.5, 0, 0, 0, 0]


def test_time_is_lost_once_and_no_longer_than_the_run(tmp_path: Path) -> None:
    """Two rules hold at the same time, and one goes on behind the end of the task."""
    verdicts = [
        header(-1, 30, ["tilting", "close"]),
        verdict(2),
        verdict(3, "close"),
        cleared(4, "close"),
        cleared(5),
        verdict(8, "close"),
        cleared(25, "close"),
    ]
    lessons = learnt(tmp_path, (refill(0, RAMP), verdicts))
    assert {each.rule: each.lost_s for each in lessons.trips} == {"tilting": 3.0, "close": 2.0}
    assert lessons.costs[0] == Cost("Drive", (("Target", RAMP),), 1, 3, 5.0)


def test_a_rule_that_never_clears_is_active_until_the_end(tmp_path: Path) -> None:
    lessons = learnt(tmp_path, (refill(0, RAMP), [header(-1, 8), verdict(2)]))
    assert lessons.trips[0].lost_s == 6.0


def test_activations_before_and_after_the_task_are_not_its_own(tmp_path: Path) -> None:
    verdicts = [header(-10, 20), *active(-5, 2), *active(12, 13)]
    assert learnt(tmp_path, (refill(0, RAMP), verdicts)).trips == []


def test_a_stale_input_is_distinguished(tmp_path: Path) -> None:
    stale = verdict(2, change="activated_stale")
    lessons = learnt(tmp_path, (refill(0, RAMP), [header(-1, 11), stale, cleared(3)]))
    assert (lessons.trips, lessons.stale) == ([], [Stale("tilting", Share(1, 1))])
    assert all(each.lost_s == 0 for each in lessons.costs)


def test_an_exemption_is_no_rule(tmp_path: Path) -> None:
    exempt = verdict(2, exempts={"rule": "tilting", "doing": "Drive", "permits": None})
    lessons = learnt(tmp_path, (refill(0, RAMP), [header(-1, 11), exempt]))
    assert (lessons.trips, lessons.stale) == ([], [])


def test_both_of_two_parallel_skills_are_blamed(tmp_path: Path) -> None:
    trace = [
        event(0, "started", "Both", {}),
        event(0, "started", "Both/Move", {}),
        event(0, "started", "Both/Look", {}),
        event(5, "succeeded", "Both/Move"),
        event(6, "succeeded", "Both/Look"),
        event(6, "succeeded", "Both"),
    ]
    lessons = learnt(tmp_path, (trace, [header(-1, 7), *active(2, 3), *active(5.5, 5.6)]))
    assert {each.skill: each.activations for each in lessons.trips} == {"Move": 1, "Look": 2}
    costs = {each.skill: (each.activations, each.lost_s) for each in lessons.costs}
    assert costs == {"Move": (1, 1.0), "Look": (2, 1.1), "Both": (2, 1.1)}


def test_during_a_recovery_its_tree_is_blamed_and_not_the_task(tmp_path: Path) -> None:
    trace = [
        event(0, "started", "Refill", {}),
        event(0, "started", "Refill/Drive", {}),
        event(2, "preempted", "Refill/Drive"),
        *ran(2, 4, "BackOff"),
        *ran(4, 9, "Refill/Drive"),
        event(9, "succeeded", "Refill"),
    ]
    verdicts = [header(-1, 10, ["tilting", "close"]), *active(1.9, 5), *active(3, 3.5, "close")]
    verdicts[1:] = sorted(verdicts[1:], key=lambda each: each["at_ns"])
    lessons = learnt(tmp_path, (trace, verdicts))
    assert {(each.rule, each.skill) for each in lessons.trips} == {
        ("tilting", "Drive"),
        ("close", "BackOff"),
    }


def test_at_one_instant_the_rule_comes_before_the_recovery_that_it_asks_for(
    tmp_path: Path,
) -> None:
    """As on the clock of a simulation: `Drive` is preempted, and a recovery starts."""
    trace = [
        event(0.0, "started", "Refill", {"Station": RAMP}),
        event(0.0, "started", "Refill/Drive", {"Target": RAMP}),
        event(2.0, "preempted", "Refill/Drive"),
        event(2.0, "started", "give_way", {}),
        event(2.0, "started", "give_way/Wait", {}),
        event(3.0, "succeeded", "give_way/Wait"),
        event(3.0, "succeeded", "give_way"),
        *ran(3.0, 10.0, "Refill/Drive", {"Target": RAMP}),
        event(10.0, "succeeded", "Refill"),
    ]
    found = learnt(tmp_path, (trace, [header(0.0, 10.0), verdict(2.0), cleared(3.0)]))
    (trip,) = found.trips
    assert (trip.skill, dict(trip.within)) == ("Drive", {"Refill": 1})
    costs = {each.skill: each.lost_s for each in found.costs}
    assert costs == {"Drive": 1.0, "Refill": 1.0, "give_way": 0.0, "Wait": 0.0}


def test_what_succeeds_at_the_instant_has_not_run_any_more(tmp_path: Path) -> None:
    verdicts = [header(0.0, 10.0), verdict(9.0), cleared(9.5)]
    found = learnt(tmp_path, (refill(0.0, RAMP), verdicts))
    assert [each.skill for each in found.trips] == ["Charge"]


def test_a_rule_while_no_skill_runs_blames_none(tmp_path: Path) -> None:
    trace = [*ran(0, 2, "Drive"), *ran(4, 6, "Drive")]
    (trip,) = learnt(tmp_path, (trace, [header(-1, 10), *active(3, 3.5)])).trips
    assert (trip.skill, trip.share, trip.lost_s) == (None, Share(1, 1), 0.5)


def failing(at: float, *events: tuple[str, str, str]) -> list[dict[str, object]]:
    """A task of which something fails: what happens, to which path, and the text."""
    return [
        event(at, "started", "Refill", {}),
        event(at, "started", "Refill/Drive", {}),
        *(event(at + 1, happened, path, text=text) for happened, path, text in events),
    ]


def test_the_skill_that_failed_first_is_reported_and_no_skill_above_it(tmp_path: Path) -> None:
    blocked = failing(0, ("failed", "Refill/Drive", "blocked"), ("failed", "Refill", "blocked"))
    lessons = learnt(tmp_path, (blocked, [header(-1, 5)]), (refill(20, RAMP), [header(19, 31)]))
    assert lessons.failures == [SkillFailure("Drive", Share(1, 2), "blocked")]


def test_what_could_not_start_has_failed(tmp_path: Path) -> None:
    trace = failing(
        0,
        ("succeeded", "Refill/Drive", ""),
        ("failed", "Refill/Charge", "no plug"),
        ("failed", "Refill", "no plug"),
    )
    lessons = learnt(tmp_path, (trace, [header(-1, 5)]))
    assert lessons.failures == [SkillFailure("Charge", Share(1, 1), "no plug")]


def test_a_skill_that_fails_after_its_children_recovered_is_reported(tmp_path: Path) -> None:
    trace = [
        *failing(0, ("failed", "Refill/Drive", "blocked")),
        *ran(2, 3, "Refill/Drive"),
        event(4, "failed", "Refill", text="it is not charged"),
    ]
    lessons = learnt(tmp_path, (trace, [header(-1, 5)]))
    assert {each.skill: each.reason for each in lessons.failures} == {
        "Drive": "blocked",
        "Refill": "it is not charged",
    }


def test_a_child_that_is_preempted_does_not_put_the_blame_above(tmp_path: Path) -> None:
    trace = failing(
        0,
        ("started", "Refill/Look", ""),
        ("failed", "Refill/Drive", "blocked"),
        ("preempted", "Refill/Look", ""),
        ("failed", "Refill", "blocked"),
    )
    for each in trace:
        each.setdefault("parameters", {})
    assert [each.skill for each in learnt(tmp_path, (trace, [header(-1, 5)])).failures] == ["Drive"]


def test_texts_that_are_no_locations_are_no_places(tmp_path: Path) -> None:
    values = {"Target": RAMP, "Mode": "FAST", "Object": "http://example.org/depot#Box-9", "N": 3}
    lessons = learnt(tmp_path, (ran(0, 5, "Drive", values), [header(-1, 6)]))
    assert [each.places for each in lessons.costs] == [(("Target", RAMP),)]
