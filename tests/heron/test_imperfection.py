"""Imperfections of sensors."""

from __future__ import annotations

import numpy as np
import pytest

from support.parts import MUJOCO, require

require(MUJOCO)

from heron.messages import Message
from heron.robot.imperfection import Drift, Late, LowPass

STEP_NS = 2_000_000


@pytest.mark.parametrize(("frequency", "least", "most"), [(2.0, 0.95, 1.0), (200.0, 0.0, 0.05)])
def test_a_low_pass_lets_slow_things_pass(frequency: float, least: float, most: float) -> None:
    low_pass = LowPass(20.0, STEP_NS)
    instants = np.arange(1000) * STEP_NS * 1e-9
    wave = np.sin(2 * np.pi * frequency * instants)
    left = [float(low_pass.feed(np.array([value]))[0]) for value in wave]
    assert least <= max(left[500:]) <= most


def test_a_drift_keeps_its_size_and_stays_alike_for_a_while() -> None:
    drift = Drift(np.random.default_rng(1), 0.5, 2.0, 1)
    errors = np.array([drift.after(0.1)[0] for _ in range(20_000)])
    assert np.std(errors) == pytest.approx(0.5, rel=0.1)
    assert np.std(np.diff(errors)) < 0.2


def test_messages_come_late_and_in_order() -> None:
    heard: list[Message] = []
    late = Late(heard.append, 30)
    late.send(0, "a")
    late.send(10, "b")
    late.deliver(29)
    assert heard == []
    late.deliver(40)
    assert heard == ["a", "b"]
