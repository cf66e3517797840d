"""The tasks of the robot: skills of EzSkiROS that are checked, and what they ask of servers."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from ezskiros.driver import check_paths
from ezskiros.runner import FaultyError
from heron.goals import ARM, NAVIGATE, Goal
from heron.skills import FOLDER
from heron.tasks import SkillTask, Status, TaskStatus, skill_task
from heron.topics import InProcess

PERIOD = SkillTask.period_ns


@dataclass
class Server:
    """Reaches goals after a while, but for those with a value that it does not like."""

    disliked: str = ""
    goals: list[Goal] = field(default_factory=list)
    done: Callable[[bool], None] | None = None

    def send(self, goal: Goal, done: Callable[[bool], None]) -> None:
        self.goals.append(goal)
        self.done = done

    def cancel(self) -> None:
        self.done = None

    def finish(self) -> None:
        done, self.done = self.done, None
        if done is not None:
            done(self.disliked not in self.goals[-1].values())


def played(
    skill: str, scene: str, arguments: Iterable[str], disliked: str = ""
) -> tuple[SkillTask, Server, Server]:
    """A task, until it is over, and the servers of base and arm."""
    carrier, base, arm = InProcess(), Server(disliked), Server(disliked)
    carrier.serve(NAVIGATE, base)
    carrier.serve(ARM, arm)
    task = SkillTask(carrier, skill, scene, arguments)
    for index in range(300):
        task.tick(index * PERIOD)
        base.finish()
        arm.finish()
    return task, base, arm


def test_the_skills_have_no_findings() -> None:
    assert not check_paths([FOLDER]).diagnostics


def test_a_block_is_fetched() -> None:
    task, base, arm = played("Fetch", "navigation.turtle", ["Target=room"])
    assert task.outcome is TaskStatus.COMPLETED
    assert base.goals == [{"place": "heron:Table-3"}]
    assert [goal["pose"] for goal in arm.goals] == ["above", "down", "grasp", "above"]
    labels = ["Drive(Target)", "Reach(above)", "Reach(down)", "Grasp(Target)", "Reach(above)"]
    assert [skill.label for skill in task.tree] == ["fetch", *labels]
    assert [skill.depth for skill in task.tree] == [0, 1, 1, 1, 1, 1]
    instants = [skill.spans[0].start for skill in task.tree]
    assert instants[0] == pytest.approx(1.0, abs=0.05)
    assert instants == sorted(instants)
    assert {span.status for skill in task.tree for span in skill.spans} == {Status.SUCCEEDED}


def test_the_tree_knows_what_failed_and_what_never_started() -> None:
    task, _, _ = played("Fetch", "navigation.turtle", ["Target=room"], "down")
    states = [[span.status for span in skill.spans] for skill in task.tree]
    done, failed = [Status.SUCCEEDED], [Status.FAILED]
    assert states == [failed, done, done, failed, [], []]


def test_the_tree_knows_what_still_runs() -> None:
    task = SkillTask(InProcess(), "Fetch", "navigation.turtle", ["Target=room"])
    assert [skill.spans for skill in task.tree] == [()], "only the root is known before it starts"
    carrier = InProcess()
    carrier.serve(NAVIGATE, Server())
    task = SkillTask(carrier, "Fetch", "navigation.turtle", ["Target=room"])
    task.tick(1_000_000_000)
    root, drive, *later = task.tree
    assert drive.spans == root.spans
    assert [(span.end, span.status) for span in drive.spans] == [(None, Status.RUNNING)]
    assert not any(skill.spans for skill in later)


@pytest.mark.parametrize("disliked", ["heron:Table-3", "down", "grasp"])
def test_what_cannot_be_reached_ends_the_task(disliked: str) -> None:
    task, base, arm = played("Fetch", "navigation.turtle", ["Target=room"], disliked)
    assert task.outcome is TaskStatus.GIVEN_UP
    assert disliked in (*base.goals, *arm.goals)[-1].values()


def test_a_hurried_planner_wants_it_back_too_soon_three_times() -> None:
    task, _, arm = played("PlaceInHaste", "arm.turtle", ["Seconds=0.4"])
    assert task.outcome is TaskStatus.COMPLETED
    assert [goal["seconds"] for goal in arm.goals[:-1]] == [2.0, 0.4] * 3
    assert arm.goals[-1] == {"pose": "place"}


def test_skills_with_a_fault_are_not_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "skills_with_a_fault"
    shutil.copytree(FOLDER, folder)
    tasks = folder / "tasks.py"
    written = tasks.read_text(encoding="utf-8").replace('Reach(Pose="down")', 'Reach(Poes="down")')
    tasks.write_text(written, encoding="utf-8")
    monkeypatch.setattr(skill_task, "FOLDER", folder)
    with pytest.raises(FaultyError) as found:
        SkillTask(InProcess(), "Fetch", "navigation.turtle", ["Target=room"])
    assert any("Poes" in each.title for each in found.value.diagnostics)
