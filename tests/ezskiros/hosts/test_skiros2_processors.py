"""Processors and decorators for SkiROS2 against those of our engine: the same children give the
same results, tick by tick, and are started, ticked and stopped alike.
"""
# ruff: noqa: N802

from __future__ import annotations

import enum
from collections.abc import Sequence
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from py_trees import decorators
from py_trees.behaviour import Behaviour
from py_trees.common import Status

from ezskiros.engine.processors import processor as engine_processor
from ezskiros.hosts import skiros2_processors
from ezskiros.hosts.skiros2_processors import Inverter, ParallelFf, Retry, Timeout
from ezskiros.skills.nodes import Flow

State = enum.Enum("State", "Success Failure Running Idle Uninitialized")  # as in SkiROS2
TICKS = 8
scripts = st.text(alphabet="RSF", min_size=1, max_size=5)
_ENDS = {"R": State.Running, "S": State.Success, "F": State.Failure}


@pytest.fixture(autouse=True)
def states(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing of SkiROS2 is needed but the names of its states."""
    monkeypatch.setattr(skiros2_processors, "api", lambda: SimpleNamespace(State=State))


class Script:
    """A child that does what a text says: a letter for each tick, the last one again and again."""

    def __init__(self, name: str, text: str, log: list[str]) -> None:
        self.name, self._text, self._log = name, text, log
        self._at = 0

    def tick(self, *, is_running: bool) -> str:
        if not is_running:
            self._log.append(f"{self.name}^")
        letter = self._text[min(self._at, len(self._text) - 1)]
        self._at += 1
        self._log.append(self.name + letter)
        return letter

    def stop(self) -> None:
        self._log.append(f"{self.name}!")


class Node:
    """A child as SkiROS2 has it."""

    def __init__(self, script: Script) -> None:
        self._script, self.state = script, State.Idle

    def visit(self, _visitor: object) -> State:
        letter = self._script.tick(is_running=self.state is State.Running)
        self.state = _ENDS[letter]
        return self.state

    def visitPreempt(self, _visitor: object) -> None:
        self._script.stop()
        self.state = State.Failure


class Leaf(Behaviour):
    """A child as the engine has it."""

    def __init__(self, script: Script) -> None:
        super().__init__(script.name)
        self._script = script

    def update(self) -> Status:
        letter = self._script.tick(is_running=self.status is Status.RUNNING)
        return {"R": Status.RUNNING, "S": Status.SUCCESS, "F": Status.FAILURE}[letter]

    def terminate(self, new_status: Status) -> None:
        if new_status is Status.INVALID and self.status is Status.RUNNING:
            self._script.stop()


def hosted(processor: Any, texts: Sequence[str]) -> list[str]:
    log: list[str] = []
    nodes = [Node(Script(name, text, log)) for name, text in zip("abc", texts, strict=False)]
    processor.reset()
    found = None
    for _ in range(TICKS):
        found = processor.processChildren(nodes, None)
        log.append(f"={found.name[0]}")
        if found is not State.Running:
            processor.reset()
    return log


def in_engine(root: Behaviour, log: list[str]) -> list[str]:
    for _ in range(TICKS):
        for _ in root.tick():
            pass
        log.append(f"={root.status.name[0]}")
    return log


def leaves(texts: Sequence[str], log: list[str]) -> list[Behaviour]:
    return [Leaf(Script(name, text, log)) for name, text in zip("abc", texts, strict=False)]


fixed = settings(suppress_health_check=[HealthCheck.function_scoped_fixture])


@fixed
@given(texts=st.lists(scripts, min_size=1, max_size=3))
def test_a_parallel(texts: list[str]) -> None:
    log: list[str] = []
    expected = in_engine(engine_processor(Flow.PARALLEL_FF, leaves(texts, log)), log)
    assert hosted(ParallelFf(), texts) == expected


@fixed
@given(text=scripts)
def test_an_inverter(text: str) -> None:
    log: list[str] = []
    (leaf,) = leaves([text], log)
    assert hosted(Inverter(), [text]) == in_engine(decorators.Inverter("", leaf), log)


@fixed
@given(text=scripts, tries=st.integers(1, 4))
def test_a_retry(text: str, tries: int) -> None:
    log: list[str] = []
    (leaf,) = leaves([text], log)
    assert hosted(Retry(tries), [text]) == in_engine(decorators.Retry("", leaf, tries), log)


def test_a_timeout_stops_its_child_when_time_is_over() -> None:
    now = [0.0]
    timeout = Timeout(2.0, lambda: now[0])
    log: list[str] = []
    node = Node(Script("a", "R", log))
    timeout.reset()
    for at in (0.0, 1.0, 2.5):
        now[0] = at
        log.append(timeout.processChildren([node], None).name)
    assert log == ["a^", "aR", "Running", "aR", "Running", "aR", "a!", "Failure"]


def test_a_timeout_starts_again_with_its_child() -> None:
    now = [0.0]
    timeout = Timeout(2.0, lambda: now[0])
    node = Node(Script("a", "SR", []))
    assert timeout.processChildren([node], None) is State.Success
    now[0] = 10.0
    assert timeout.processChildren([node], None) is State.Running
