"""A task runs the behavior trees of rules: its action server `/recovery`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import pytest

from heron.goals import LOOK_OUT, NAVIGATE, RECOVERY, Goal
from heron.messages import Message
from heron.skills.exported import digest
from heron.tasks import SkillContextPublisher, SkillTask, Status, TaskStatus
from heron.topics import SKILL_CONTEXT, InProcess

JUNCTION, HALL, YARD = "heron:Place-3", "heron:Place-4", "heron:Place-5"
FIRST_PATH = (
    "Robot=@Drive.Robot",
    "Start=@Drive.Start",
    "Target=@Drive.Target",
    "Seconds=8.0",
)


@dataclass
class Server:
    """Ends its goals when it is told to."""

    goals: list[Goal] = field(default_factory=list)
    done: Callable[[bool], None] | None = None
    cancelled: int = 0

    def send(self, goal: Goal, done: Callable[[bool], None]) -> None:
        self.goals.append(goal)
        self.done = done

    def cancel(self) -> None:
        self.cancelled += 1
        self.done = None

    def end(self, *, is_reached: bool = True) -> None:
        done, self.done = self.done, None
        assert done is not None, "there is a goal"
        done(is_reached)


class Delivery:
    """The task `Deliver`, which is on the first way, and the servers of the base."""

    def __init__(self) -> None:
        self.carrier = InProcess()
        self.base, self.look_out = Server(), Server()
        self.carrier.serve(NAVIGATE, self.base)
        self.carrier.serve(LOOK_OUT, self.look_out)
        self.contexts: list[set[str]] = []
        self.carrier.subscribe(SKILL_CONTEXT, self.hear)
        self.task = SkillTask(self.carrier, "Deliver", "blocked.turtle", ["Place=hall"])
        SkillContextPublisher(self.carrier, self.task)
        self.now_ns = 1_000_000_000
        self.ended: list[bool] = []
        self.tick()
        self.base.end()
        self.tick(2)

    def hear(self, message: Message) -> None:
        self.contexts.append({each.skill for each in message.running})

    def tick(self, count: int = 1) -> None:
        for _ in range(count):
            self.task.tick(self.now_ns)
            self.now_ns += SkillTask.period_ns

    def ask(self, afterwards: str = "replan", of: str | None = None) -> None:
        """A rule asks for the tree `GiveWay`."""
        goal: Goal = {
            "digest": digest() if of is None else of,
            "skill": "GiveWay",
            "arguments": FIRST_PATH,
            "afterwards": afterwards,
        }
        self.carrier.server(RECOVERY).send(goal, self.ended.append)
        self.tick(2)

    def turn_back(self) -> None:
        """Nobody cleared the way; the base drives to its begin."""
        self.look_out.end(is_reached=False)
        self.tick(2)
        self.base.end()
        self.tick(4)

    @property
    def places(self) -> list[object]:
        return [goal["place"] for goal in self.base.goals]

    @property
    def roots(self) -> list[tuple[str, list[Status]]]:
        return [
            (each.label, [span.status for span in each.spans])
            for each in self.task.tree
            if each.depth == 0
        ]


@pytest.fixture
def delivery() -> Delivery:
    found = Delivery()
    assert found.places == [JUNCTION, HALL]
    return found


def test_a_tree_runs_in_the_place_of_the_task(delivery: Delivery) -> None:
    delivery.ask()
    assert delivery.base.cancelled == 1, "the base stands"
    assert delivery.look_out.goals == [{"seconds": 8.0}]
    assert delivery.contexts[-1] == {"Deliver", "GiveWay", "WaitUntilFree"}
    assert delivery.ended == []


def test_after_a_tree_the_planner_finds_the_other_way(delivery: Delivery) -> None:
    delivery.ask()
    delivery.turn_back()
    assert delivery.places == [JUNCTION, HALL, JUNCTION, YARD]
    assert delivery.ended == [True]
    delivery.base.end()
    delivery.tick(3)
    delivery.base.end()
    delivery.tick(3)
    assert delivery.places[-1] == HALL
    assert delivery.task.outcome is TaskStatus.COMPLETED
    assert delivery.task.replanned == 1


def test_a_way_that_is_free_in_time_is_taken_again(delivery: Delivery) -> None:
    delivery.ask()
    delivery.look_out.end()
    delivery.tick(4)
    assert delivery.ended == [True]
    assert delivery.places == [JUNCTION, HALL, HALL]


def test_all_trees_are_known_afterwards(delivery: Delivery) -> None:
    """Each in the order in which it began; the events of a tree are not those of its namesake."""
    delivery.ask()
    delivery.turn_back()
    delivery.ask()
    delivery.look_out.end()
    delivery.tick(4)
    assert delivery.roots == [
        ("deliver", [Status.PREEMPTED]),
        ("give_way", [Status.SUCCEEDED]),
        ("deliver", [Status.PREEMPTED]),
        ("give_way", [Status.SUCCEEDED]),
        ("deliver", [Status.RUNNING]),
    ]
    waits = [each.spans for each in delivery.task.tree if each.label == "WaitUntilFree(Seconds)"]
    assert [[span.status for span in each] for each in waits] == [
        [Status.FAILED],
        [Status.SUCCEEDED],
    ]


def test_a_task_that_resumes_is_the_same_tree(delivery: Delivery) -> None:
    delivery.ask("resume")
    delivery.look_out.end()
    delivery.tick(3)
    assert delivery.roots == [
        ("deliver", [Status.RUNNING]),
        ("give_way", [Status.SUCCEEDED]),
    ]
    assert delivery.task.replanned == 0
    *_, drive = (each for each in delivery.task.tree if each.label == "Drive(Junction, Place)")
    assert [span.status for span in drive.spans] == [Status.PREEMPTED, Status.RUNNING]


def test_a_tree_ends_with_its_rule(delivery: Delivery) -> None:
    delivery.ask()
    delivery.carrier.server(RECOVERY).cancel()
    delivery.tick(2)
    assert delivery.ended == [False]
    assert delivery.look_out.cancelled == 1
    assert delivery.places == [JUNCTION, HALL, HALL]


def test_rules_of_another_export_are_refused(delivery: Delivery) -> None:
    delivery.ask(of="another")
    assert delivery.ended == [False]
    assert delivery.base.cancelled == 0
    assert delivery.roots == [("deliver", [Status.RUNNING])]


def test_without_a_way_the_task_is_given_up(delivery: Delivery) -> None:
    delivery.ask()
    delivery.turn_back()
    delivery.base.end()
    delivery.tick(3)
    assert delivery.places[-1] == HALL
    delivery.ask()
    delivery.turn_back()
    assert delivery.ended == [True, False]
    assert delivery.task.outcome is TaskStatus.GIVEN_UP
    assert delivery.task.replanned == 1
