"""The thread that publishes: it speaks as long as the thread that ticks is alive, and no longer."""

from __future__ import annotations

import math
import threading
import time

import pytest

from ezskiros.context.snapshot import RunningSkill, Snapshot
from ezskiros.context.voice import PATIENCE, Voice
from support.engine import Clock

IDLE = Snapshot("digest", ())
BUSY = Snapshot("digest", (RunningSkill("Push", "1", 0.0, (), ()),))
PERIOD = 0.1


def voice_of() -> tuple[Voice, list[Snapshot], Clock]:
    clock, heard = Clock(), list[Snapshot]()
    return Voice(heard.append, period=PERIOD, clock=clock), heard, clock


def test_it_says_nothing_before_it_knows_anything() -> None:
    voice, heard, _ = voice_of()
    assert not voice.speak()
    voice.live()
    assert not voice.speak()
    assert heard == []


def test_it_falls_silent_without_a_sign_of_life_and_speaks_again_after_one() -> None:
    voice, heard, clock = voice_of()
    voice.tell(BUSY)
    for _ in range(PATIENCE):
        clock.wait(PERIOD * 0.999)
        assert voice.speak()
    clock.wait(PERIOD)
    assert not voice.speak()
    clock.wait(1e9)
    assert not voice.speak()
    voice.live()
    assert voice.speak()
    assert heard == [BUSY] * (PATIENCE + 1)


def test_an_old_sign_of_life_is_old() -> None:
    voice, _, clock = voice_of()
    clock.wait(10.0)
    voice.tell(BUSY, alive=0.0)
    assert not voice.speak()
    voice.live(math.inf)
    clock.wait(1e9)
    assert voice.speak(), "where nothing runs nothing has to live"


def test_to_wait_is_to_live() -> None:
    voice, _, clock = voice_of()
    voice.tell(IDLE)
    silent = list[bool]()

    def sleep(seconds: float) -> None:
        assert seconds <= PERIOD
        clock.wait(seconds)
        silent.append(not voice.speak())

    voice.wait(30.0, sleep)
    assert clock.seconds == pytest.approx(30.0)
    assert not any(silent)


def test_what_is_new_is_reported_at_once_and_all_once_a_period() -> None:
    heard = list[Snapshot]()
    changed = threading.Condition()

    def publish(snapshot: Snapshot) -> None:
        with changed:
            heard.append(snapshot)
            changed.notify()

    def wait_for(count: int) -> None:
        with changed:
            assert changed.wait_for(lambda: len(heard) >= count, timeout=60)

    with Voice(publish, period=3600.0) as voice:
        voice.tell(IDLE)
        wait_for(1)
        voice.tell(IDLE)
        voice.tell(BUSY)
        wait_for(2)
    assert heard == [IDLE, BUSY]
    with Voice(publish, period=0.001) as voice:
        voice.tell(IDLE, alive=math.inf)
        wait_for(6)
    count = len(heard)
    time.sleep(0.05)
    assert len(heard) == count, "after its end it says nothing"


def test_a_fault_silences_it_for_good_and_is_known() -> None:
    def publish(_snapshot: Snapshot) -> None:
        raise OSError("no route")

    with Voice(publish, period=0.001) as voice:
        voice.tell(BUSY)
        voice._thread.join(60)
    assert repr(voice.problem) == "OSError('no route')"
