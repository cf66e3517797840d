"""`since`, `once` and `after` in C and in Python against the interpreter, over long traces of few
values: inputs that are stale beside inputs that are just unknown, jumps, and many messages at once.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator

import pytest

from rossmarie import ir
from rossmarie.engines.python_monitor import PythonMonitor
from rossmarie.interpreter import Interpreter
from rossmarie.ir import And, ChannelValues, Held, Not, Or, Since
from rossmarie.native import load_native
from rossmarie.targets.c99 import generate_loadable
from rossmarie.targets.python import source
from support.c_compiler import needs_c
from support.drafts import SECOND, Draft
from support.machines import Advance, Step, Update, observe

TICK = SECOND // 10
STEPS = 600


def machine() -> ir.Machine:
    """A rule is active with the last number; its verdicts tell of all that looks back in time."""
    draft = Draft()
    a, b = (draft.above(draft.read(timeout_ns=4 * TICK), 0.0) for _ in "ab")
    c, d = (draft.above(draft.read(), 0.0) for _ in "cd")
    shown = draft.above(draft.read(), 0.0)
    plain = [draft.proposition(Since(*pair)) for pair in ((a, b), (a, c), (c, a), (c, d), (d, d))]
    missing = draft.proposition(Not(d))
    pending = draft.proposition(Since(missing, draft.proposition(And((a, missing)))))
    kept = draft.proposition(Not(draft.proposition(Held(pending, 3 * TICK))))
    seen = [
        draft.proposition(
            Not(draft.proposition(Held(draft.proposition(Not(each)), 3 * TICK, initially=True)))
        )
        for each in (a, c, plain[3])
    ]
    lasting = draft.proposition(Held(plain[3], 2 * TICK))
    nested = draft.proposition(Since(seen[1], lasting))
    reported = [*plain, kept, *seen, lasting, nested]
    sides = draft.proposition(Or((*reported, *(draft.proposition(Not(each)) for each in reported))))
    draft.rule(draft.proposition(And((shown, sides))))
    for each in reported:
        draft.rule(each)
    return draft.machine()


def trace(seed: int) -> list[Step]:
    chance = random.Random(seed)
    at_ns = 0
    steps: list[Step] = []
    for _ in range(STEPS):
        at_ns += chance.choice((0, TICK, TICK, TICK, 2 * TICK, 5 * TICK))
        if chance.random() < 0.02:
            at_ns -= 20 * TICK
        if chance.random() < 0.15:
            steps.append(Advance(at_ns))
            continue
        channels = chance.sample(range(5), chance.randint(1, 3))
        messages = {
            channel: ChannelValues({channel: chance.choice((1.0, 1.0, -1.0, -1.0, math.nan))})
            for channel in channels
        }
        steps.append(Update(at_ns, messages))
    return steps


@pytest.fixture(autouse=True, scope="module")
def _own_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        yield


@needs_c
@pytest.mark.parametrize("seed", range(6))
def test_c_is_what_the_interpreter_is(seed: int) -> None:
    found = machine()
    ir.verify(found)
    steps = trace(seed)
    monitor = load_native(found, generate_loadable(found))
    assert observe(monitor, steps) == observe(Interpreter(found), steps)


@pytest.mark.parametrize("seed", range(6))
def test_python_is_what_the_interpreter_is(seed: int) -> None:
    found = machine()
    steps = trace(seed)
    monitor = PythonMonitor(found, source(found))
    assert observe(monitor, steps) == observe(Interpreter(found), steps)
