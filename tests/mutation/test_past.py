"""Every fault of lists and of the past is noticed, whoever has it: in C, in Python, and in the
interpreter that the others are compared with.
"""

from __future__ import annotations

import math
import signal
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from importlib import import_module
from pathlib import Path
from random import Random
from types import ModuleType

import pytest

import rossmarie.interpreter
from mutation.bench import outputs
from mutation.past_faults import INTERPRETER, PYTHON, C, Damage
from mutation.traces import random_trace
from rossmarie import ir
from rossmarie.driver import compile_file
from rossmarie.engines.python_monitor import PythonMonitor
from rossmarie.interpreter import Interpreter
from rossmarie.targets import c99, python
from support import c_replay
from support.c_compiler import needs_c
from support.machines import Observation, Step, Update, observe

STEPS = 1200
FLAGS = (0.0, 0.0, 1.0, 1.0, math.nan)
MOST_SECONDS = 5.0
"""Seconds of a processor for a trace that takes a tenth of one: a fault may never end."""
PACKAGE = "rossmarie.interpreter"
SOURCES = Path(rossmarie.interpreter.__file__).parent


@cache
def machine() -> ir.Machine:
    return compile_file(Path(__file__).with_name("past.ross")).machine


@cache
def trace() -> Sequence[Step]:
    return [*chosen(), *random_trace(machine(), STEPS, message)]


def chosen() -> Iterator[Step]:
    """Traces for cases that chance meets too seldom."""
    yield sent(0, docked=0.0)
    for at_ms, speed in enumerate((0.0, 3.0, 0.0, 3.0)):  # two edges, and a jump back
        yield sent(at_ms * 10, speed=speed)
    yield sent(25, speed=3.0)
    for at_ms, speed in (
        (450, 0.0),
        (900, 0.0),
        (1000, 3.0),
        (950, 3.0),
        (960, 0.0),
        (970, 3.0),
    ):  # one before it
        yield sent(at_ms, speed=speed)
    for at_ms, speed in enumerate((0.0, math.nan, 3.0, math.nan, 3.0)):  # none that is known
        yield sent(4000 + at_ms * 10, speed=speed)
    yield sent(6000, speed=0.0, docked=0.0)
    yield sent(6010, speed=math.nan, docked=math.nan)


def sent(at_ms: int, **numbers: float) -> Update:
    """Messages of single numbers, by the names of inputs."""
    found = {}
    for index, slot in enumerate(machine().slots):
        used = machine().inputs[slot.input]
        if used.name in numbers:
            found[used.channel] = ir.ChannelValues({index: numbers[used.name]})
    return Update(at_ms * 10**6, found)


def message(machine: ir.Machine, random: Random, channel: int) -> ir.ChannelValues:
    """Numbers at the limit of all rules, beside it, and none; lists of none to too many."""
    slots = {
        index: random.choice(FLAGS) if slot.kind is ir.FieldKind.FLAG else number(random)
        for index, slot in enumerate(machine.slots)
        if machine.inputs[slot.input].channel == channel
    }
    count = random.randrange(5)
    arrays = {
        index: [number(random) for _ in range(count)]
        for index, array in enumerate(machine.arrays)
        if machine.inputs[array.input].channel == channel
    }
    for index in arrays:
        if machine.arrays[index].kind is ir.FieldKind.TEXT:
            arrays[index] = [random.choice((0.0, -1.0)) for _ in range(count)]
    return ir.ChannelValues(slots, arrays)


def number(random: Random) -> float:
    odd = random.random() < 0.04
    return random.choice((math.nan, math.inf, -math.inf) if odd else (0.0, 0.9, 1.0, 1.1, 3.0))


@cache
def wanted() -> list[Observation]:
    return observe(Interpreter(machine()), trace())


def damaged(text: str, damage: Damage) -> str:
    """A text with a fault at one place."""
    assert text.count(damage.old) == 1, (text.count(damage.old), damage)
    return text.replace(damage.old, damage.new)


# --- C ---------------------------------------------------------------------------------------


def of_c(files: Mapping[str, str]) -> list[Observation]:
    no_table = bytes(8 * (1 + len(machine().slots) + 2 * len(machine().arrays)))
    no_table += bytes(len(machine().channels))
    given = c_replay.trace_bytes(machine(), trace()) + no_table
    (lines,) = outputs(files, c_replay.program(machine()), [given])
    found = c_replay.observations(machine(), "\n".join(lines).encode(), len(trace()) + 2)
    return list(found)[1:-1]


@cache
def generated_c() -> dict[str, str]:
    return {**c99.generate(machine()), **c99.generate_loadable(machine())}


@needs_c
def test_undamaged_c_is_the_interpreter() -> None:
    assert of_c(generated_c()) == wanted()


@needs_c
@pytest.mark.parametrize("damage", C, ids=lambda each: each.name)
def test_a_fault_of_c_is_noticed(damage: Damage) -> None:
    files = generated_c()
    (name,) = (name for name, text in files.items() if damage.old in text)
    files = {**files, name: damaged(files[name], damage)}
    assert is_noticed(lambda: of_c(files), wanted())


# --- Python ----------------------------------------------------------------------------------


def of_python(text: str) -> list[Observation]:
    return observe(PythonMonitor(machine(), text), trace())


@cache
def generated_python() -> str:
    return python.source(machine())


def test_undamaged_python_is_the_interpreter() -> None:
    assert of_python(generated_python()) == wanted()


@pytest.mark.parametrize("damage", PYTHON, ids=lambda each: each.name)
def test_a_fault_of_python_is_noticed(damage: Damage) -> None:
    text = damaged(generated_python(), damage)
    assert is_noticed(lambda: of_python(text), wanted())


# --- the interpreter -------------------------------------------------------------------------


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A copy of the interpreter under another name."""
    folder = tmp_path / "damaged_interpreter"
    folder.mkdir()
    for module in SOURCES.glob("*.py"):
        text = module.read_text("utf-8").replace(PACKAGE, folder.name)
        (folder / module.name).write_text(text, "utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    yield folder
    for name in [name for name in sys.modules if name.split(".")[0] == folder.name]:
        del sys.modules[name]


@pytest.mark.parametrize(
    ("module", "damage"),
    [(module, damage) for module, found in INTERPRETER.items() for damage in found],
    ids=lambda each: each.name if isinstance(each, Damage) else str(each),
)
def test_a_fault_of_the_interpreter_is_noticed(package: Path, module: str, damage: Damage) -> None:
    path = package / module
    path.write_text(damaged(path.read_text("utf-8"), damage), "utf-8")
    found: ModuleType = import_module(package.name)
    assert is_noticed(lambda: of_package(found), of_python(generated_python()))


def of_package(found: ModuleType) -> list[Observation]:
    return observe(found.Interpreter(machine()), trace())


def test_an_undamaged_copy_is_the_interpreter(package: Path) -> None:
    assert of_package(import_module(package.name)) == wanted()


# --- what does not end -----------------------------------------------------------------------


def is_noticed(look: Callable[[], list[Observation]], expected: list[Observation]) -> bool:
    """Say whether a run fails, does not end, or has other observations."""
    signal.signal(signal.SIGVTALRM, _too_long)
    signal.setitimer(signal.ITIMER_VIRTUAL, MOST_SECONDS)
    try:
        return look() != expected
    except (ArithmeticError, AssertionError, LookupError, TypeError, ValueError, TimeoutError):
        return True
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)


def _too_long(_number: int, _frame: object) -> None:
    raise TimeoutError
