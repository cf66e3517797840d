"""A drive of 80 s, replayed: 6 rules, 5 signals, a stale sensor, and a rule that stays active."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import pytest

from rossmarie import ir
from rossmarie.interpreter import Interpreter
from rossmarie.ir import ChannelValues, Comparison, Event
from rossmarie.report.axis import Axis
from rossmarie.report.model import Replay
from rossmarie.report.plots import plan_plots
from support.drafts import SECOND, Draft

START_NS = 1_700_000_000 * SECOND
LENGTH_S = 80
DEGREES = 180 / math.pi

IMU, ODOMETRY, SCAN, FIX = range(4)


@pytest.fixture(scope="session")
def drive() -> Replay:
    """The drive, over recorded time without jumps."""
    machine = drive_machine()
    return replay_of(machine, list(drive_messages()))


def replay_of(machine: ir.Machine, messages: list[tuple[int, int, ChannelValues]]) -> Replay:
    """Messages (stamp, channel, values) through the interpreter, sampled after each."""
    monitor = Interpreter(machine)
    events: list[Event] = []
    latest: dict[int, tuple[int, ChannelValues]] = {}
    stamps, samples = [], []
    for stamp, channel, values in messages:
        events += monitor.update(stamp, {channel: values})
        latest[channel] = (stamp, values)
        stamps.append(stamp)
        samples.append(_sampled(machine, latest, stamp))
    stamps_ns = np.array(stamps, dtype=np.int64)
    times = Axis().place(stamps_ns) / 1e9
    columns = np.array(samples)
    return Replay(
        machine=machine,
        rules_file="rules/yard.ross",
        recording="recordings/yard_drive.mcap",
        monitor="python",
        start_ns=stamps[0],
        end_ns=stamps[-1],
        events=tuple(events),
        plots=tuple(plan.plot(times, columns[:, plan.signal]) for plan in plan_plots(machine)),
        notes=("Topic /battery is not in the recording; its rules cannot become active.",),
    )


def _sampled(
    machine: ir.Machine, latest: dict[int, tuple[int, ChannelValues]], stamp: int
) -> list[float]:
    """The signals that read a slot, NaN where none came or the input has expired."""
    row = []
    for signal in machine.signals:
        value = math.nan
        if isinstance(signal.node, ir.Read):
            slot = machine.slots[signal.node.slot]
            used = machine.inputs[slot.input]
            at, values = latest.get(used.channel, (stamp, ChannelValues()))
            if used.timeout_ns is None or stamp - at < used.timeout_ns:
                value = values.slots.get(signal.node.slot, math.nan) * slot.scale + slot.offset
        row.append(value)
    return row


def drive_machine() -> ir.Machine:
    """Tilt, jolts, speed while tilted, turning, distance, and a sensor that must not be stale."""
    draft = _Drive()
    topics = ("/imu/data", "/odom", "/scan", "/fix")
    types = (
        "sensor_msgs/Imu",
        "nav_msgs/Odometry",
        "sensor_msgs/LaserScan",
        "sensor_msgs/NavSatFix",
    )
    draft.channels = [ir.Channel(*pair) for pair in zip(topics, types, strict=True)]
    _add_rules(draft, _add_signals(draft))
    return draft.machine("yard")


class _Drive(Draft):
    """A draft with names and words as users write them."""

    def named_read(
        self, channel: int, name: str, text: str, unit: str, timeout: float, scale: float = 1
    ) -> int:
        used = self.input(channel, int(timeout * SECOND))
        self.inputs[used] = replace(self.inputs[used], name=name)
        return self.signal(ir.Read(self.slot(used)), text, unit, scale)

    def compare(
        self, signal: int, how: Comparison, limit: float, name: str | None, text: str
    ) -> int:
        return self.proposition(ir.Compare(how, signal, self.constant(limit)), name, text)

    def named_rule(
        self,
        name: str,
        condition: int,
        actions: str,
        contract: str = "clears as soon as its condition is false",
        documentation: str | None = None,
        *,
        release: int | None = None,
        latched: bool = False,
    ) -> None:
        index = self.rule(condition, release, latched=latched)
        self.rules[index] = replace(
            self.rules[index],
            name=name,
            actions=tuple(actions.split()),
            contract=contract,
            documentation=documentation,
        )


@dataclass(frozen=True)
class _Signals:
    """The signals of the rules in the drive, by index."""

    pitch: int
    jolt: int
    turn: int
    speed: int
    nearest: int


def _add_signals(draft: _Drive) -> _Signals:
    return _Signals(
        pitch=draft.named_read(IMU, "orientation", "orientation.pitch()", "deg", 0.5, DEGREES),
        jolt=draft.named_read(IMU, "acceleration", "acceleration.z", "m/s^2", 0.5),
        turn=draft.named_read(IMU, "turning", "turning.z", "rad/s", 0.5),
        speed=draft.named_read(ODOMETRY, "speed", "speed", "m/s", 0.5),
        nearest=draft.named_read(SCAN, "ranges", "min(ranges)", "m", 1.0),
    )


def _add_steep(draft: _Drive, pitch: int) -> int:
    low, high = draft.constant(-10 / DEGREES), draft.constant(10 / DEGREES)
    level = draft.proposition(ir.Between(pitch, low, high), None, "orientation.pitch() in tilt")
    tilted = draft.proposition(ir.Not(level), None, "orientation.pitch() not in tilt")
    return draft.proposition(
        ir.Held(tilted, 2 * SECOND), "imu.steep", "orientation.pitch() not in tilt for 2 s"
    )


def _add_rules(draft: _Drive, of: _Signals) -> None:
    above, below = Comparison.GREATER, Comparison.LESS
    steep = _add_steep(draft, of.pitch)
    moving = draft.compare(of.speed, above, 0.1, "drive.moving", "speed > 0.1 m/s")
    fast = draft.compare(of.speed, above, 1.2, "drive.fast", "speed > maxSpeed")
    bump = draft.compare(of.jolt, above, 13.0, "imu.bump", "acceleration.z > 13 m/s^2")
    spin = draft.compare(of.turn, above, 0.8, "imu.spinning", "turning.z > 0.8 rad/s")
    near = draft.compare(of.nearest, below, 0.6, "scan.near", "min(ranges) < 0.6 m")
    far = draft.compare(of.nearest, above, 1.5, "scan.clear", "min(ranges) > 1.5 m")
    calm = draft.proposition(ir.Held(draft.proposition(ir.Not(bump)), SECOND))
    both = draft.proposition(ir.And((steep, moving)), None, "imu.steep and drive.moving")
    wild = draft.proposition(ir.And((bump, fast)), None, "imu.bump and drive.fast")
    draft.named_rule(
        "slow_on_slope",
        both,
        "lowSpeed",
        documentation="Uphill or downhill for longer than a bump.",
    )
    draft.named_rule("slow_on_bump", bump, "lowSpeed", "clears for 1 s without", release=calm)
    draft.named_rule("keep_distance", near, "stop", "clears when scan.clear", release=far)
    draft.named_rule("no_spinning", spin, "stopTurning lowSpeed")
    draft.named_rule(
        "stop_on_crash", wild, "stop", "latched until reset", "Somebody has to look.", latched=True
    )
    speeding = draft.compare(of.speed, above, 3, None, "speed > 3 m/s")
    draft.named_rule("too_fast_in_yard", speeding, "lowSpeed")


def drive_messages() -> Iterator[tuple[int, int, ChannelValues]]:
    """Imu at 30 Hz with a gap, odometry at 10 Hz, a scan at 5 Hz; the same on every call."""
    noise = random.Random(4)
    for tick in range(LENGTH_S * 30 + 1):
        t = tick / 30
        stamp = START_NS + tick * SECOND // 30
        if not 57.0 < t < 60.5:
            yield stamp, IMU, _imu(t, noise)
        if tick % 3 == 0:
            speed = 0.9 + 0.5 * math.sin(t / 9) - 1.3 * math.exp(-(((t - 44) / 3.5) ** 2))
            yield stamp, ODOMETRY, ChannelValues({3: max(0.0, speed) + noise.gauss(0, 0.012)})
        if tick % 6 == 0:
            nearest = 2.6 + 0.7 * math.sin(t / 5) - 2.6 * math.exp(-(((t - 44) / 3) ** 2))
            yield stamp, SCAN, ChannelValues({4: max(0.2, nearest + noise.gauss(0, 0.03))})


def _imu(t: float, noise: random.Random) -> ChannelValues:
    slope = 14 * (math.tanh((t - 22) / 1.2) - math.tanh((t - 31) / 1.2)) / 2
    slope -= 13 * (math.tanh((t - 64) / 1.0) - math.tanh((t - 70) / 1.0)) / 2
    bumps = sum(
        9 * math.exp(-abs(t - at) * 5) * math.cos((t - at) * 25) for at in (9, 15.5, 16.2, 38, 74)
    )
    turning = 0.25 * math.sin(t / 4) + 0.95 * math.exp(-(((t - 50) / 1.1) ** 2))
    return ChannelValues(
        {
            0: (slope + noise.gauss(0, 0.5)) / DEGREES,
            1: 9.81 + bumps + noise.gauss(0, 0.35),
            2: turning + noise.gauss(0, 0.03),
        }
    )
