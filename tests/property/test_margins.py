"""The margins of random conditions: distances as an independent definition has them, whose sign is
that of the condition; the same in C, in Python and in the interpreter.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.driver import compile_file
from rossmarie.engines import NamedValues
from rossmarie.guard import Declared, Guard
from rossmarie.interpreter import Interpreter
from support.c_compiler import needs_c
from support.depth import examples, phases_of_compiled

pytestmark = needs_c
NUMBERS = (-3.0, -1.0, -0.0, 0.0, 0.1, 0.5, 1.0, 2.0, 3.0, 1e300, math.nan)
HEAD = """
input x = topic /x : std_msgs/Float64 .data in m;
input y = topic /y : std_msgs/Float64 .data in m;
input scan = topic /scan : sensor_msgs/LaserScan .ranges;
"""
OBSERVE: dict[str, Any] = {"x": 0, "y": 1, "scan": slice(2, 5)}


@pytest.fixture(scope="module", autouse=True)
def _own_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        yield


@dataclass(frozen=True)
class Condition:
    """A condition as text, and as Python that gives its robustness: positive where it holds."""

    text: str
    robustness: str


def _limit(draw: st.DrawFn) -> str:
    return draw(st.sampled_from(("-1", "0", "0.1", "0.5", "2")))


@st.composite
def _comparisons(draw: st.DrawFn, name: str) -> Condition:
    sign = draw(st.sampled_from(("<", "<=", ">", ">=")))
    limit = _limit(draw)
    left, right = (name, limit) if draw(st.booleans()) else (limit, name)
    texts = [each if each == name else f"{each} m" for each in (left, right)]
    robust = f"sub({right}, {left})" if sign[0] == "<" else f"sub({left}, {right})"
    return Condition(f"{texts[0]} {sign} {texts[1]}", robust)


@st.composite
def _beside(draw: st.DrawFn) -> Condition:
    """The elements compared with a number of another message."""
    sign = draw(st.sampled_from(("<", "<=", ">", ">=")))
    left, right = draw(st.permutations(("scan", draw(st.sampled_from(("x", "y"))))))
    robust = f"sub({right}, {left})" if sign[0] == "<" else f"sub({left}, {right})"
    return Condition(f"{left} {sign} {right}", robust)


@st.composite
def _ranges(draw: st.DrawFn, name: str) -> Condition:
    inside = f"least(sub({name}, -1.0), sub(0.5, {name}))"
    if draw(st.booleans()):
        return Condition(f"{name} in [-1, 0.5] m", inside)
    outside = f"greatest(sub(-1.0, {name}), sub({name}, 0.5))"
    return Condition(f"{name} not in [-1, 0.5] m", outside)


@st.composite
def _folded(draw: st.DrawFn) -> Condition:
    element = draw(_joined(st.one_of(_comparisons("scan"), _beside(), _ranges("scan")), 1))
    function, fold = draw(st.sampled_from((("any", "greatest"), ("all", "least"))))
    robust = element.robustness.replace("scan", "e")
    return Condition(f"{function}({element.text})", f"{fold}(*[{robust} for e in scan])")


@st.composite
def _joined(draw: st.DrawFn, leaves: st.SearchStrategy[Condition], depth: int) -> Condition:
    if depth == 0 or draw(st.booleans()):
        return draw(leaves)
    one = draw(_joined(leaves, depth - 1))
    if draw(st.integers(0, 2)) == 0:
        return Condition(f"not ({one.text})", f"neg({one.robustness})")
    other = draw(_joined(leaves, depth - 1))
    word, join = draw(st.sampled_from((("and", "least"), ("or", "greatest"))))
    text = f"(({one.text}) {word} ({other.text}))"
    return Condition(text, f"{join}({one.robustness}, {other.robustness})")


def conditions() -> st.SearchStrategy[Condition]:
    leaves = st.one_of(
        *(kind(name) for kind in (_comparisons, _ranges) for name in ("x", "y")),
        _folded(),
        _comparisons("x - y"),
    )
    return _joined(leaves, 3)


def robustness(condition: Condition, seen: list[float]) -> float:
    """The robustness by its definition: differences, minimum and maximum; NaN if a number is
    NaN.
    """

    def extreme(choose: object, numbers: tuple[float, ...]) -> float:
        assert callable(choose)
        return math.nan if any(map(math.isnan, numbers)) else float(choose(numbers))

    def sub(a: float, b: float) -> float:
        return a - b if math.isfinite(a - b) else math.nan

    known = {
        "x": seen[0],
        "y": seen[1],
        "scan": seen[2:],
        "sub": sub,
        "neg": lambda a: -a,
        "least": lambda *numbers: extreme(min, numbers),
        "greatest": lambda *numbers: extreme(max, numbers),
    }
    found = eval(condition.robustness, known)
    assert isinstance(found, float)
    return found


def compiled(conditions: list[Condition], folder: Path) -> ir.Machine:
    path = folder / "rules.ross"
    rules = (f"if {each.text} then {{ }} feedback margin in mm;" for each in conditions)
    path.write_text("\n".join([HEAD, *rules]), encoding="utf-8")
    return compile_file(path).with_margins


def in_python(machine: ir.Machine, observe: Declared) -> Guard:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("CC", "no-such-compiler")
        return Guard(machine, observe, {})


def interpreted(
    machine: ir.Machine, observe: Declared, course: list[list[float]]
) -> Iterator[list[float]]:
    """The margins as the interpreter has them."""
    interpreter, values = Interpreter(machine), NamedValues(machine)
    for at_ns, seen in enumerate(course):
        message: dict[str, Any] = {name: seen[OBSERVE[name]] for name in observe}
        interpreter.update(at_ns, values.messages(message))
        yield [interpreter.signals[each.signal] * each.scale for each in ir.margins_of(machine)]


@settings(phases=phases_of_compiled(), max_examples=examples(0.1))
@given(
    st.lists(conditions(), min_size=1, max_size=12),
    st.lists(st.lists(st.sampled_from(NUMBERS), min_size=5, max_size=5), min_size=1, max_size=12),
)
def test_margins_are_the_robustness_of_what_rules_require(
    tmp_path_factory: pytest.TempPathFactory, made: list[Condition], course: list[list[float]]
) -> None:
    machine = compiled(made, tmp_path_factory.mktemp("rules"))
    used = re.findall(r"\b(?:x|y|scan)\b", " ".join(each.text for each in made))
    observe: Declared = {name: OBSERVE[name] for name in used}
    reported = list(interpreted(machine, observe, course))
    for guard in (Guard(machine, observe, {}), in_python(machine, observe)):
        batch = guard.batch(1)
        for at_ns, seen in enumerate(course):
            wanted = [-1000.0 * robustness(each, seen) for each in made]
            active = guard.observe(at_ns, np.array(seen))
            batch.observe(at_ns, np.array([seen]))
            margin = guard.margin
            np.testing.assert_array_equal(margin, wanted)
            np.testing.assert_array_equal(margin, reported[at_ns])
            assert batch.margin.tobytes() == margin.tobytes()
            assert not active[margin > 0.0].any()
            assert active[margin < 0.0].all()
