"""The engine is tried out: bytes become calls, and each answer is compared with what it has to be.

The first byte says which part is called: a monitor (also one with more nodes than fit one word), a
reactor, or the functions without memory.
"""

from __future__ import annotations

import math
import random
import struct
from collections.abc import Callable, Iterator
from functools import cache, partial
from pathlib import Path
from typing import Protocol

from fuzz.engine import model, plans, rules
from fuzz.engine.decoding import Bytes
from fuzz.engine.program import MOST_CALLS, Call, DefectError, Program

_Read = Callable[[int], bytes]
_NEVER = 2**63 - 1
_PADDING = 60


class Case(Protocol):
    """Calls of one part, and what has to come of them."""

    def decode(self, data: Bytes, now_ns: int) -> Call:
        """The next call."""

    def check(self, call: Call, read: _Read) -> None:
        """Read the answer to a call. Raises AssertionError if it is wrong."""


def seeds() -> list[bytes]:
    """Random calls of each part."""
    chance = random.Random(6)
    return [bytes([part]) + chance.randbytes(600) for part in range(len(PARTS)) for _ in range(3)]


def read(content: bytes, folder: Path) -> None:
    """Try the calls that a content stands for. Raises `DefectError` if the engine errs."""
    data = Bytes(content)
    number = data.byte() % len(PARTS)
    case = PARTS[number]()
    calls = list(_calls(data, case))
    program, done = _program(number), 0
    try:
        program.send(calls)
        for call in calls:
            done += 1
            case.check(call, program.read)
    except BaseException as error:
        program.stop()  # what it would have answered belongs to this case
        reported = "\n".join(f"    {call}" for call in calls[:done][-12:])
        raise DefectError(
            f"{error}\nafter {done} calls, the last of which are\n{reported}"
        ) from error


def _calls(data: Bytes, case: Case) -> Iterator[Call]:
    now_ns = 0
    for _ in range(MOST_CALLS):
        if data.is_over:
            return
        call = case.decode(data, now_ns)
        if rules.EARLIEST < call.t_ns < rules.LATEST:
            now_ns = call.t_ns
        yield call


@cache
def _program(part: int) -> Program:
    source, *options = _SOURCES[part]
    return Program(source, *options)


# --- monitors --------------------------------------------------------------------------------

_ADVANCE, _MESSAGE_X, _MESSAGE_Y, _MESSAGES, _RESET, _LATCH = range(6)
_MONITOR_KINDS = [
    _MESSAGE_X, _MESSAGE_Y, _MESSAGES, _MESSAGE_X, _MESSAGE_Y, _ADVANCE, _RESET, _LATCH,
]  # fmt: skip
_ARRIVED = {_MESSAGE_X: (0,), _MESSAGE_Y: (1,), _MESSAGES: (0, 1)}
_EVENT = struct.Struct("@iqq2q2dii2BB0q")


class _OfMonitor:
    """A monitor beside that of model.py."""

    def __init__(self, padding: int) -> None:
        self._monitor = model.Monitor(rules.FALSE if padding else rules.TRUE)
        propositions, values = len(rules.PROPOSITIONS) + padding, len(rules.VALUES)
        self._stand = struct.Struct(f"@iiqq{propositions}q{values}d{propositions}B3B10B2BB0q")
        self._places = [
            i + (padding if i >= _LEAVES else 0) for i in range(len(rules.PROPOSITIONS))
        ]

    def decode(self, data: Bytes, now_ns: int) -> Call:
        kind = _MONITOR_KINDS[data.byte() % len(_MONITOR_KINDS)]
        t_ns = now_ns if kind == _LATCH else data.instant(now_ns)
        if kind in (_RESET, _LATCH):
            return Call(kind, t_ns, data.byte() % 14 - 2)
        return Call(
            kind, t_ns, 0, tuple(data.number() for _ in range(4 if kind in _ARRIVED else 0))
        )

    def check(self, call: Call, read: _Read) -> None:
        result, events = self._called(call)
        found_events = []
        while (head := read(4)) == struct.pack("@i", 1):
            found_events.append(_event(_EVENT.unpack(head + read(_EVENT.size - 4))))
        found = self._stand.unpack(head + read(self._stand.size - 4))
        _compare("events", found_events, events)
        _compare("result", found[1], result)
        self._compare_stand(found[2:])

    def _called(self, call: Call) -> tuple[int, list[rules.Event]]:
        monitor = self._monitor
        monitor.events.clear()
        if call.kind in _ARRIVED:
            result = monitor.take(call.t_ns, _ARRIVED[call.kind], call.numbers)
        elif call.kind == _ADVANCE:
            result = monitor.advance(call.t_ns)
        elif call.kind == _RESET:
            result = monitor.reset(call.t_ns, call.about)
        else:
            result = monitor.latch(call.about)
        return result, monitor.events

    def _compare_stand(self, found: tuple[float, ...]) -> None:
        monitor, count = self._monitor, (len(found) - len(rules.VALUES) - 18) // 2
        next_wake_ns, wake_ns, *rest = found
        since_ns, value = rest[:count], rest[count : count + len(rules.VALUES)]
        proposition, others = rest[-count - 16 : -16], rest[-16:]
        wanted_ns = monitor.next_wake()
        _compare("next wake", next_wake_ns, _NEVER if wanted_ns is None else wanted_ns)
        _compare("active rules", others[3:13], [int(each) for each in monitor.active])
        _compare("states", others[:3], list(monitor.state.values()))
        if not monitor.started:
            return
        assert wake_ns <= next_wake_ns, (
            f"calm until {wake_ns}, and a timer is due at {next_wake_ns}"
        )
        for name, place in zip(rules.PROPOSITIONS, self._places, strict=True):
            _compare(name, proposition[place], monitor.truth[name])
            _compare(f"since of {name}", since_ns[place], monitor.since_ns[name])
        for name, x in zip(rules.VALUES, value, strict=True):
            _compare(name, x, monitor.value[name])
        _compare("watched", others[13:15], [monitor.truth[each] for each in rules.WATCHED])
        _compare("all inputs", others[15], int(monitor.has_all_inputs()))


_LEAVES = rules.PROPOSITIONS.index("swing_y")


def _event(found: tuple[float, ...]) -> rules.Event:
    """An event as rules.py has it; there, no more than the rule shows."""
    _, at_ns, from_ns, *rest = found
    since_ns, values, (rule, change), propositions = (
        rest[:2],
        rest[2:4],
        map(int, rest[4:6]),
        rest[6:8],
    )
    if change == rules.TIME_JUMP:
        return rules.Event(change, int(at_ns), int(from_ns))
    shown = values[: len(rules.RULES[rule].values)]
    return rules.Event(
        change, int(at_ns), int(from_ns), rule, tuple(map(int, propositions)), tuple(map(int,
        since_ns)), tuple(shown), int(rest[8]), )  # fmt: skip


def _compare(what: str, found: object, wanted: object) -> None:
    """Equal to the last bit, but for the bits of what is not a number."""
    assert repr(found) == repr(wanted), f"{what}: {found}, and not {wanted}"


# --- reactors --------------------------------------------------------------------------------

_REACT, _REPORT, _OPEN, _BOUND = range(4)
_TASK_COMMAND = struct.Struct("@4i")
_STAND = struct.Struct("@qqq9q9d3d9B4B4B0q")


class _OfReactor:
    """A reactor, and what plans.py says of it."""

    def __init__(self) -> None:
        self._reactor = plans.Reactor()

    def decode(self, data: Bytes, now_ns: int) -> Call:
        kind = (_REACT, _REACT, _REPORT, _REPORT, _BOUND, _OPEN)[data.byte() % 6]
        about = data.byte() | data.byte() << 8
        return Call(kind, data.instant(now_ns), about, tuple(data.number() for _ in range(3)))

    def check(self, call: Call, read: _Read) -> None:
        task_commands = []
        while (head := read(4)) == struct.pack("@i", 1):
            task_commands.append(_TASK_COMMAND.unpack(head + read(_TASK_COMMAND.size - 4))[1:])
        found = _STAND.unpack(head + read(_STAND.size - 4))
        triples = [(found[i], found[i + 1], found[i + 2]) for i in (12, 15, 18)]
        stand = plans.Stand(
            found[1], found[2], found[3:12], triples, found[21:24], found[24:33], found[33:37],
            found[37:41],
        )  # fmt: skip
        if call.kind == _REACT and rules.EARLIEST < call.t_ns < rules.LATEST:
            self._reactor.react(call.about & 15, call.about >> 4 & 15)
        self._reactor.is_open |= call.kind == _OPEN
        self._reactor.take(task_commands)
        self._reactor.check(stand, call.t_ns, call.numbers)


# --- functions -------------------------------------------------------------------------------

_LOGIC, _BITS, _NUMBERS, _QUANTIFIERS, _ANGLES = range(5)
_FOUND = struct.Struct("@6d")


class _OfFunctions:
    """Functions without memory, and what they are."""

    def decode(self, data: Bytes, now_ns: int) -> Call:  # noqa: ARG002 - they know no time
        kind = data.byte() % 5
        if kind == _QUANTIFIERS:
            count = data.byte() % 6
            propositions = data.byte() % (count + 1)
            unknowns = data.byte() % (count - propositions + 1)
            return Call(kind, 0, 0, (propositions, unknowns, count, data.byte() % 2))
        bits = int.from_bytes(data.several(8), "little", signed=True) if kind == _BITS else 0
        return Call(kind, bits or 1, data.byte(), tuple(data.number() for _ in range(4)))

    def check(self, call: Call, read: _Read) -> None:
        found = list(_FOUND.unpack(read(_FOUND.size)))
        if call.kind == _ANGLES:
            _check_angles(call.numbers, found)
            return
        wanted = {_LOGIC: _logic, _BITS: _bits, _NUMBERS: _numbers, _QUANTIFIERS: _quantifiers}
        expected = wanted[call.kind](call)
        _compare(f"function {call.kind}", found, [*map(float, expected), *[0.0] * 6][:6])


def _logic(call: Call) -> list[float]:
    a, b = call.about & 3, call.about >> 2 & 3
    return [rules.both(a, b), rules.either(a, b), rules.opposite(a)]


def _bits(call: Call) -> list[float]:
    return [(call.t_ns & -call.t_ns).bit_length() - 1]


def _numbers(call: Call) -> list[float]:
    is_unknown, value = call.about & 1, call.about >> 1 & 1
    x = rules.known(call.numbers[0])
    a, b, _, _ = call.numbers
    is_open = math.isnan(a) or math.isnan(b)
    least, greatest = min(b, a), max(b, a)
    return [
        x, math.nan if is_unknown else value, rules.UNKNOWN if is_unknown else value,
        math.nan if is_open else least, math.nan if is_open else greatest,
    ]  # fmt: skip


def _quantifiers(call: Call) -> list[float]:
    """S24, S25, S51, S53: from a list of elements."""
    propositions, unknowns, count = map(int, call.numbers[:3])
    elements = [rules.TRUE] * propositions + [rules.UNKNOWN] * unknowns
    elements += [rules.FALSE] * (count - len(elements))
    of_array = _folded(elements) if elements else [math.nan] * 3
    return of_array + (_folded(elements) if call.numbers[3] else [math.nan] * 3)


def _folded(elements: list[int]) -> list[float]:
    some, every = rules.FALSE, rules.TRUE
    for each in elements:
        some, every = rules.either(some, each), rules.both(every, each)
    known = rules.UNKNOWN not in elements
    found = [
        math.nan if proposition == rules.UNKNOWN else float(proposition)
        for proposition in (some, every)
    ]
    return [*found, float(elements.count(rules.TRUE)) if known else math.nan]


def _check_angles(numbers: tuple[float, ...], found: list[float]) -> None:
    """S5: within a unit in the last place of what a library finds, which is nearly as near."""
    y, x, z, w = numbers
    is_open = math.isnan(y) or math.isnan(x) or (math.isinf(y) and math.isinf(x))
    _check_angle("asin", math.asin(y) if abs(y) <= 1.0 else math.nan, found[0], [y])
    _check_angle("atan2", math.nan if is_open else math.atan2(y, x + 0.0), found[1], [y, x])
    n = ((y * y + x * x) + z * z) + w * w
    sine = rules.divided(2.0 * (w * x - z * y), n)
    pitch = math.nan if n == 0.0 or math.isnan(sine) else math.asin(max(-1.0, min(sine, 1.0)))
    _check_angle("pitch", pitch, found[2], [y, x, z, w])


def _check_angle(name: str, wanted: float, found: float, operands: list[float]) -> None:
    is_extreme = any(x != 0.0 and not 2.0**-500 < abs(x) < 2.0**500 for x in operands)
    most = math.pi if is_extreme else 2 * math.ulp(wanted)  # so far, only the range is promised
    if is_extreme and math.isnan(found):
        return  # their digits cannot be parted
    is_near = abs(found) <= math.pi and abs(found - wanted) <= most
    assert is_near or (math.isnan(wanted) and math.isnan(found)), f"{name} of {operands}: {found}"


_SOURCES = (
    ("monitor.c",),
    ("monitor.c", f"-DPADDING={_PADDING}"),
    ("reactor.c",),
    ("functions.c",),
)
PARTS: tuple[Callable[[], Case], ...] = (
    partial(_OfMonitor, 0),
    partial(_OfMonitor, _PADDING),
    _OfReactor,
    _OfFunctions,
)
