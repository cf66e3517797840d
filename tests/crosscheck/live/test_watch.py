"""A robot that runs, without ROS: what is told of it, and once."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from crosscheck.live.facts import Facts, facts_of
from crosscheck.live.model import (
    Alive,
    ChangeKind,
    LiveChange,
    Message,
    NodeState,
    RunningCall,
    RunningContext,
)
from crosscheck.live.sources import FIRST_PATIENCE
from crosscheck.live.watch import NODE_PATIENCE, Reported, Watch
from crosscheck.robot import load
from dslkit.diagnostics import Diagnostic
from support.depth import examples
from support.robots import EXAMPLE

ROBOT = load(EXAMPLE / "whiteboard.ross").robot
assert ROBOT is not None
FACTS: Facts = facts_of(ROBOT, "/robot1")
DIGEST = FACTS.robot.skills.digest
TIMEOUT = FACTS.timeout
ARM = "/arm_controller/follow_joint_trajectory"
WIPE, DRIVE = (
    RunningCall("Wipe", "Wipe 1", (("Board", "office:Whiteboard-5"),)),
    RunningCall("Drive", "1"),
)


def context(*running: RunningCall, digest: str = DIGEST) -> RunningContext:
    return RunningContext(digest, running)


def said(reported: Iterable[Reported]) -> list[str]:
    """The texts of changes, and the codes of findings."""
    return [each.text if isinstance(each, LiveChange) else each.code for each in reported]


@pytest.fixture
def watch() -> Watch:
    """A robot that is watched since the second 100, and of which all speak."""
    found = Watch(FACTS, 100.0)
    assert said(found.take(100.0, NodeState())) == []
    assert said(found.take(100.0, context())) == []
    return found


def test_a_skill_is_reported_with_its_individuals_and_how_long_it_ran(watch: Watch) -> None:
    reported = watch.take(100.1, context(WIPE, DRIVE))
    assert said(reported) == ["Wipe starts: Board = office:Whiteboard-5", "Drive starts"]
    assert said(watch.take(100.3, context(WIPE, DRIVE))) == []
    assert said(watch.take(100.5, context(WIPE))) == ["Drive ends after 0.4 s"]
    again = RunningCall("Wipe", "Wipe 2")
    assert said(watch.take(100.6, context(again))) == ["Wipe ends after 0.5 s", "Wipe starts"]
    watch.end(100.85)
    assert watch.skills.counts["Wipe"].times == 2
    assert watch.skills.counts["Wipe"].seconds == pytest.approx(0.75)


def test_an_exemption_is_reported_with_the_permission_that_it_rests_on(watch: Watch) -> None:
    watch.take(100.1, context(WIPE))
    (reported,) = said(watch.take(100.2, NodeState(("contact_doing_Wipe",))))
    assert reported.startswith(
        "contact_doing_Wipe is used: contact is not applied, as `Wipe` permits"
    )
    assert "contact with office.Whiteboard (" in reported
    assert "motions.py:68:25)" in reported
    assert "force with office.Whiteboard up to 20 N (" in reported
    assert "speed" not in reported
    (over,) = watch.take(100.5, NodeState())
    assert isinstance(over, LiveChange)
    assert over.kind is ChangeKind.EXEMPTION_ENDS
    assert over.names == {"rule": "contact_doing_Wipe", "exempted": "contact"}


@pytest.mark.parametrize("is_skill_first", [True, False])
def test_what_a_rule_takes_from_a_skill_is_reported_whichever_comes_first(
    watch: Watch, is_skill_first: bool
) -> None:
    messages: list[Message] = [context(WIPE), NodeState(("too_hard",))]
    reported = [
        line
        for message in (messages if is_skill_first else reversed(messages))
        for line in said(watch.take(100.1, message))
    ]
    (taken,) = [line for line in reported if "takes" in line]
    assert taken.startswith(f"too_hard takes {ARM} from Wipe (")
    assert "whiteboard.ross:" in taken
    for message in messages:
        assert said(watch.take(100.2, message)) == []
    watch.take(100.3, NodeState())
    watch.take(100.4, NodeState(("too_hard", "calm")))
    assert watch.takings == {("too_hard", ARM, "Wipe"): 2}
    assert watch.count("too_hard").times == 2


@pytest.mark.parametrize(
    "silent", [context(WIPE), NodeState(("too_hard",))], ids=["context", "node"]
)
def test_what_is_taken_is_reported_anew_after_a_silence(watch: Watch, silent: Message) -> None:
    both: list[Message] = [context(WIPE), NodeState(("too_hard",))]
    for message in both:
        watch.take(100.1, message)
    others: list[Message] = [Alive()] if silent == both[0] else [both[0]]
    for tenth in range(40):
        for message in others:
            watch.take(100.2 + tenth / 10, message)
    assert any("takes" in line for line in said(watch.take(104.3, silent)))
    assert watch.takings == {("too_hard", ARM, "Wipe"): 2}


def test_operators_are_reported(watch: Watch) -> None:
    exempted = NodeState((), ("contact",))
    assert said(watch.take(100.1, exempted)) == ["the operator exempts contact"]
    assert said(watch.take(100.2, exempted)) == []
    assert said(watch.take(100.3, NodeState())) == ["the operator no longer exempts contact"]


def test_silence_of_the_context_is_reported_once_and_when_it_is_over(watch: Watch) -> None:
    watch.take(100.1, context(WIPE))
    watch.take(100.2, NodeState())
    assert said(watch.pass_time(100.1 + TIMEOUT)) == []
    silent = watch.pass_time(100.2 + TIMEOUT)
    assert said(silent) == ["CHK403", "it is unknown whether Wipe still runs"]
    assert isinstance(silent[0], Diagnostic)
    assert "on /robot1/skill_context" in silent[0].title
    assert silent[0].primary.span.text.startswith('skills "skills.json"')
    assert said(watch.pass_time(101.0)) == []
    over = watch.take(101.1, context(WIPE))
    assert said(over)[0] == "/robot1/skill_context is reported again"
    watch.end(101.1)
    assert watch.skills.counts["Wipe"].times == 2
    assert watch.skills.counts["Wipe"].seconds == pytest.approx(0.0)
    assert watch.findings == 1
    assert watch.has_errors


def test_a_message_after_a_silence_does_not_hide_it(watch: Watch) -> None:
    reported = said(watch.take(100.1 + TIMEOUT, context()))
    assert reported == ["CHK403", "/robot1/skill_context is reported again"]


def test_a_node_lives_by_its_diagnostics_and_is_silent_without(watch: Watch) -> None:
    def tick(at: float) -> list[str]:
        return said(watch.take(at, context()))

    for second in range(10):
        watch.take(100.0 + second, Alive())
        watch.take(100.0 + second, NodeState(("contact",)))
        for tenth in range(10):
            assert "CHK404" not in tick(100.0 + second + tenth / 10)
    reported = [line for tenth in range(40) for line in tick(110.0 + tenth / 10)]
    assert reported == ["CHK404", "it is unknown whether contact is still active"]
    assert watch.count("contact").seconds == pytest.approx(9.0)
    assert said(watch.take(115.0, Alive()))[:1] == ["CHK403"]
    (again, *_) = said(watch.take(115.0, NodeState(("contact",))))
    assert again == "/robot1/whiteboard_safety reports again"


def test_a_node_of_which_no_state_comes_is_silent_though_it_lives() -> None:
    watch = Watch(FACTS, 0.0)
    reported = [
        line
        for tenth in range(100)
        for message in (context(), Alive())
        for line in said(watch.take(tenth / 10, message))
    ]
    assert reported == ["CHK404"]


def test_who_has_never_spoken_has_time_to_connect_and_is_reported_at_the_end() -> None:
    watch = Watch(FACTS, 0.0)
    assert said(watch.pass_time(FIRST_PATIENCE)) == []
    assert said(watch.end(FIRST_PATIENCE)) == ["CHK403", "CHK404"]
    assert said(Watch(FACTS, 0.0).pass_time(FIRST_PATIENCE + 0.1)) == ["CHK403", "CHK404"]


def test_another_export_is_reported_once_until_it_is_over(watch: Watch) -> None:
    foreign = context(digest="5b" * 32)
    (reported,) = watch.take(100.1, foreign)
    assert isinstance(reported, Diagnostic)
    assert reported.code == "CHK401"
    assert "5b5b5b5b5b5b..." in reported.title
    assert DIGEST[:12] in reported.primary.text
    assert said(watch.take(100.2, foreign)) == []
    assert said(watch.take(100.3, context())) == ["/robot1/skill_context is of this export"]
    assert said(watch.take(100.4, foreign)) == ["CHK401"]
    assert watch.findings == 2


def test_a_message_that_the_rules_do_not_read_says_nothing_of_what_runs(watch: Watch) -> None:
    watch.take(100.1, context(WIPE))
    reported = said(watch.take(100.2, RunningContext(DIGEST, problem="more than 64 skills run")))
    assert reported == ["CHK401", "it is unknown whether Wipe still runs"]


def test_what_is_not_known_is_reported(watch: Watch) -> None:
    other = RunningCall("Dance", "1")
    assert said(watch.take(100.1, context(other))) == ["Dance starts", "CHK402"]
    assert said(watch.take(100.2, context(other, WIPE)))[1:] == []
    assert said(watch.take(100.3, context()))[-1] == "the rules know all running skills"
    assert said(watch.take(100.4, NodeState(("old", "contact")))) == ["CHK405", "contact is active"]
    assert (
        said(watch.take(100.5, NodeState()))[0] == "/robot1/whiteboard_safety reports these rules"
    )


def test_time_in_which_nobody_listened_is_no_silence(watch: Watch) -> None:
    watch.pause(60.0)
    assert said(watch.pass_time(160.1)) == []
    assert said(watch.pass_time(160.1 + NODE_PATIENCE)) == ["CHK403", "CHK404"]


# --- anything ------------------------------------------------------------------------------------

NAMES = st.sampled_from(["Wipe", "Drive", "Reach", "Dance", "", "\x1b[2J"])
RULES = st.sampled_from([*FACTS.rules, "other"])
RUNNING = st.builds(RunningCall, NAMES, st.sampled_from("12"))
CONTEXTS = st.builds(
    RunningContext,
    st.sampled_from([DIGEST, "", "5b" * 32]),
    st.lists(RUNNING, max_size=3).map(tuple),
    st.sampled_from([None, None, "too large"]),
)
STATES = st.builds(
    NodeState,
    st.lists(RULES, max_size=3).map(tuple),
    st.lists(RULES, max_size=2).map(tuple),
)
STEPS = st.lists(
    st.tuples(
        st.sampled_from([0.0, 0.1, 0.4, 1.0, 4.0]), st.none() | CONTEXTS | STATES | st.just(Alive())
    ),
    max_size=30,
)

BEGINS = {
    ChangeKind.SKILL_STARTS: ("skill", "goal"),
    ChangeKind.RULE_ACTIVATES: ("rule",),
    ChangeKind.EXEMPTION_BEGINS: ("rule",),
}
ENDS = {
    ChangeKind.SKILL_ENDS: ("skill", "goal"),
    ChangeKind.RULE_CLEARS: ("rule",),
    ChangeKind.EXEMPTION_ENDS: ("rule",),
}


@settings(max_examples=examples(4))
@given(STEPS)
def test_whatever_is_reported_begins_before_it_ends_and_findings_come_once(
    steps: list[tuple[float, Message | None]],
) -> None:
    watch, at, reported = Watch(FACTS, 0.0), 0.0, list[Reported]()
    for wait, message in steps:
        at += wait
        reported += watch.pass_time(at) if message is None else watch.take(at, message)
    reported += watch.end(at)
    open_findings: set[str] = set()
    lasting: set[tuple[str, ...]] = set()
    begun: Counter[str] = Counter()
    for each in reported:
        if isinstance(each, Diagnostic):
            assert each.code not in open_findings
            open_findings.add(each.code)
        elif each.kind is ChangeKind.OVER:
            open_findings.remove(each.names["code"])
        elif each.kind in BEGINS:
            key = tuple(each.names[name] for name in BEGINS[each.kind])
            assert key not in lasting
            lasting.add(key)
            begun[key[0]] += 1
        elif each.kind in ENDS:
            lasting.remove(tuple(each.names[name] for name in ENDS[each.kind]))
        elif each.kind is ChangeKind.UNKNOWN:
            lasting.remove(tuple(each.names.values()))
    counts = {**watch.skills.counts, **watch.rules.counts}
    assert {name: count.times for name, count in counts.items()} == dict(begun)
    assert all(0.0 <= count.seconds <= count.times * at + 1e-9 for count in counts.values())
    assert watch.findings == sum(isinstance(each, Diagnostic) for each in reported)
    assert watch.has_errors is bool(watch.findings)


@settings(max_examples=examples(2))
@given(STEPS, st.floats(0.0, 1e6))
def test_only_differences_of_times_count(
    steps: list[tuple[float, Message | None]], start: float
) -> None:
    def texts(start: float) -> list[str]:
        watch, at, found = Watch(FACTS, start), start, list[str]()
        for wait, message in steps:
            at += wait
            found += said(watch.pass_time(at) if message is None else watch.take(at, message))
        return found

    assert texts(0.0) == texts(round(start))
