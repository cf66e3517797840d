"""Experiment IV: contact that is meant, and contact that is not."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

from support.parts import MUJOCO, require

require(MUJOCO)

from heron import messages
from heron.experiments import ContactEpisode, run_contact
from heron.experiments.arms import CONTACT_RULES, machine_of
from heron.experiments.contact import varied_cell
from heron.goals import ARM, Goal
from heron.guard import InProcessGuard
from heron.messages import Message
from heron.tasks import SkillContextPublisher, SkillTask, Status
from heron.topics import SKILL_CONTEXT, WRENCH, InProcess
from heron.variants import Encounter, ExperimentArm

SEED = 3
SECOND = 1_000_000_000
TIMEOUT = 0.5  # s, five periods of the context


@cache
def episode(arm: ExperimentArm, encounter: Encounter) -> ContactEpisode:
    """Each is run once for all tests."""
    return run_contact(arm, encounter, SEED)


# --- episodes --------------------------------------------------------------------------------


def test_contact_that_is_meant_stops_nothing_where_rules_know_of_it() -> None:
    found = episode(ExperimentArm.SKILL_AWARE, Encounter.MEANT).measures
    assert found.is_completed
    assert found.time_restricted == 0.0
    assert found.peak_force > 15.0, "harder than elsewhere"
    assert found.exemptions >= 2, "of both skills, and the log says so"


def test_where_rules_know_sensors_only_it_is_never_done() -> None:
    found = episode(ExperimentArm.ROSSMARIE, Encounter.MEANT)
    assert not found.measures.is_completed
    assert found.measures.pushed < 0.01
    assert found.measures.wiped < 0.5
    ends = {one.label: one.spans[-1].status for one in found.tree}
    assert ends["Push(Box, Mark)"] is Status.PREEMPTED, "out of time"
    assert ends["Reach(home)"] is Status.SUCCEEDED


@pytest.mark.deep
def test_without_a_monitor_it_is_done() -> None:
    assert episode(ExperimentArm.NONE, Encounter.MEANT).measures.is_completed


def test_contact_outside_of_a_skill_is_stopped_as_soon_whoever_knows_what() -> None:
    aware, unaware = (
        episode(arm, Encounter.COLLISION).measures
        for arm in (ExperimentArm.SKILL_AWARE, ExperimentArm.ROSSMARIE)
    )
    for found in (aware, unaware):
        assert found.reactions["collision"] < 0.1
    assert aware.peak_on_person is not None
    assert unaware.peak_on_person is not None
    assert aware.peak_on_person < 1.1 * unaware.peak_on_person
    assert aware.is_completed
    assert aware.time_restricted_without_need == 0.0


@pytest.mark.deep
def test_without_a_monitor_a_forearm_is_pressed_until_it_is_drawn_back() -> None:
    found, guarded = (
        episode(arm, Encounter.COLLISION).measures
        for arm in (ExperimentArm.NONE, ExperimentArm.SKILL_AWARE)
    )
    assert found.time_on_person is not None
    assert guarded.time_on_person is not None
    assert found.time_on_person > 0.4 > 2 * guarded.time_on_person


def test_a_skill_may_not_press_harder_than_it_permits() -> None:
    found = episode(ExperimentArm.SKILL_AWARE, Encounter.JAMMED)
    assert found.measures.reactions["jam"] < 0.3
    assert found.measures.peak_in_jam is not None
    assert 30.0 < found.measures.peak_in_jam < 60.0
    assert any("while_Push activated" in words for _, words in found.reported)
    assert not found.measures.is_completed
    assert found.measures.wiped == 1.0, "what can be done is done"


@pytest.mark.deep
def test_without_a_monitor_it_presses_as_hard_as_its_motion_is_made_to() -> None:
    found = episode(ExperimentArm.NONE, Encounter.JAMMED).measures
    assert found.peak_in_jam == pytest.approx(120.0, abs=5.0)


@pytest.mark.deep
def test_the_same_seed_is_the_same_episode() -> None:
    first = episode(ExperimentArm.SKILL_AWARE, Encounter.COLLISION)
    again = run_contact(ExperimentArm.SKILL_AWARE, Encounter.COLLISION, SEED)
    assert (first.measures, first.reported, first.cell) == (
        again.measures,
        again.reported,
        again.cell,
    )
    assert np.array_equal(first.trace.columns["force"], again.trace.columns["force"])


def test_another_seed_is_another_cell_and_only_one_that_is_jammed_has_an_obstacle() -> None:
    one, other = (varied_cell(Encounter.JAMMED, np.random.default_rng(seed)) for seed in (1, 2))
    assert one != other
    assert one.jam is not None
    assert one.jam < one.push_distance
    assert varied_cell(Encounter.MEANT, np.random.default_rng(1)).jam is None


# --- who tells which skills run --------------------------------------------------------------


class Server:
    """Reaches a goal when it is told to."""

    def __init__(self) -> None:
        self.done: Callable[[bool], None] = print

    def send(self, goal: Goal, done: Callable[[bool], None]) -> None:  # noqa: ARG002
        self.done = done

    def cancel(self) -> None:
        pass


def contexts(goals: int) -> list[Message]:
    """All that is reported in four seconds, in which the arm reaches so many goals."""
    carrier, server = InProcess(), Server()
    carrier.serve(ARM, server)
    heard: list[Message] = []
    carrier.subscribe(SKILL_CONTEXT, heard.append)
    arguments = ["Box=box", "Mark=mark", "Board=board"]
    task = SkillTask(carrier, "TidyUp", "contact.turtle", arguments)
    context = SkillContextPublisher(carrier, task)
    for now_ns in range(0, 4 * SECOND + 1, 20_000_000):
        if now_ns % SkillTask.period_ns == 0:
            task.tick(now_ns)
            if goals and now_ns > SECOND:
                goals -= 1
                server.done(True)
        if now_ns % SkillContextPublisher.period_ns == 0:
            context.tick(now_ns)
    return heard


def names(message: Message) -> list[str]:
    return [one.skill for one in message.running]


def seconds(stamp: Message) -> float:
    return float(stamp.sec) + 1e-9 * float(stamp.nanosec)


def test_the_context_tells_of_a_compound_and_of_its_child_with_individuals_and_permissions() -> (
    None
):
    message = contexts(2)[-1]
    assert names(message) == ["TidyUp", "Push"]
    assert seconds(message.header.stamp) == pytest.approx(4.0)
    push = message.running[1]
    assert push.goal != message.running[0].goal
    assert seconds(push.since) == pytest.approx(1.12, abs=0.05)
    assert {one.parameter: one.type for one in push.arguments}["Object"] == "heron.Box"
    reported = {(one.kind, one.type, one.limit) for one in push.permits if one.kind == "force"}
    assert reported == {("force", "heron.Box", 30.0)}


def test_it_is_reported_ten_times_a_second_and_at_once_when_a_skill_starts_or_ends() -> None:
    heard = contexts(3)
    stamps = [seconds(message.header.stamp) for message in heard]
    assert max(np.diff(stamps)) < 0.11
    started = next(message for message in heard if "Push" in names(message))
    assert seconds(started.header.stamp) == pytest.approx(seconds(started.running[-1].since))
    ended = next(message for message in heard[heard.index(started) :]
                 if "Push" not in names(message))  # fmt: skip
    assert names(ended) == ["TidyUp"], "before the next one starts"


def test_before_and_after_a_task_no_skill_runs_and_that_is_reported() -> None:
    heard = contexts(7)
    assert names(heard[0]) == names(heard[-1]) == []
    assert names(contexts(0)[-1]) == ["TidyUp", "Reach"]


# --- what is not known is not exempted -------------------------------------------------------


def context(digest: str, *skills: str) -> Message:
    message = messages.new_message(SKILL_CONTEXT.type)
    message.digest = digest
    for name in skills:
        running = messages.new_message("skill_context_msgs/RunningSkill")
        running.skill = name
        message.running.append(running)
    return message


class Watch:
    """Rules that know skills on guard, over time."""

    def __init__(self) -> None:
        self.now_ns = 0
        self.carrier = InProcess()
        self.carrier.serve(ARM, Server())
        machine = machine_of(CONTACT_RULES[ExperimentArm.SKILL_AWARE])
        self.guard = InProcessGuard(machine, self.carrier, lambda: self.now_ns)
        self.digest = contexts(0)[0].digest

    def pass_time(self, seconds: float, force: float, reported: Message | None) -> None:
        """A force on the hand, and a context, if somebody tells one."""
        say, press = (self.carrier.publisher(topic) for topic in (SKILL_CONTEXT, WRENCH))
        until_ns = self.now_ns + round(seconds * SECOND)
        while self.now_ns < until_ns:
            if reported is not None and self.now_ns % 100_000_000 == 0:
                say(reported)
            if self.now_ns % 8_000_000 == 0:
                press(messages.wrench(self.now_ns, (0.0, 0.0, force)))
            self.guard.tick(self.now_ns)
            self.now_ns += 2_000_000

    def is_stopped(self) -> bool:
        return "back_off_on_contact" in self.guard.active


@pytest.mark.parametrize("skill", ["Push", "Wipe"])
def test_the_contact_of_a_skill_is_let_be_while_it_runs(skill: str) -> None:
    watch = Watch()
    watch.pass_time(1.0, 20.0, context(watch.digest, "TidyUp", skill))
    assert not watch.is_stopped()
    assert watch.guard.active == (f"back_off_on_contact_doing_{skill}",)
    watch.pass_time(0.2, 20.0, context(watch.digest, "TidyUp", "Reach"))
    assert watch.is_stopped(), "the skill is over, and the contact is not"


def test_beyond_what_a_skill_permits_its_contact_is_stopped() -> None:
    watch = Watch()
    watch.pass_time(1.0, 31.0, context(watch.digest, "TidyUp", "Push"))
    assert "back_off_on_contact_while_Push" in watch.guard.active
    assert watch.guard.is_acting


def test_when_the_context_falls_silent_the_exemption_is_over_in_time() -> None:
    """As when whoever runs the skills is killed while one pushes."""
    watch = Watch()
    watch.pass_time(1.0, 20.0, context(watch.digest, "Push"))
    last_s = 0.9
    assert not watch.is_stopped()
    watch.pass_time(last_s + TIMEOUT - 1.0 - 0.02, 20.0, None)
    assert not watch.is_stopped()
    watch.pass_time(0.04, 20.0, None)
    assert watch.is_stopped()
    watch.pass_time(0.2, 20.0, context(watch.digest, "Push"))
    watch.pass_time(1.5, 5.0, context(watch.digest, "Push"))
    assert not watch.is_stopped(), "and it is used again when there is a context again"


def test_a_context_of_another_export_exempts_from_nothing() -> None:
    watch = Watch()
    watch.pass_time(1.0, 20.0, context("0" * 64, "Push"))
    assert watch.is_stopped()


def test_a_light_touch_is_no_contact_whatever_runs() -> None:
    watch = Watch()
    watch.pass_time(1.0, 10.0, context(watch.digest))
    assert watch.guard.active == ()
