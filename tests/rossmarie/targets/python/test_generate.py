"""The output of the Python target: its form, its requirements, and unsupported rules."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import pytest

from dslkit.source import SourceFile, Span
from rossmarie import ir
from rossmarie.driver import RulesError, compile_file
from rossmarie.engines.python_monitor import PythonMonitor
from rossmarie.interpreter import Interpreter
from rossmarie.ir import Change, ChannelValues, Comparison
from rossmarie.targets.python import generate, source
from support.c99_cases import CASES
from support.compiled import machine_of_rules
from support.drafts import SECOND, Draft
from support.golden import assert_golden
from support.machines import Update, observe
from support.runs import FastCalls

ROOT = Path(__file__).parents[4]
GOLDEN = ROOT / "tests" / "golden" / "python"
RULES = sorted((*ROOT.glob("examples/*/*.ross"), *ROOT.glob("tests/fixtures/*/*.ross")))


@pytest.mark.parametrize("case", ["thresholds", "memories"])
def test_looks_as_when_somebody_last_looked(case: str, bless: bool) -> None:
    for name, text in generate(CASES[case]()).items():
        assert_golden(GOLDEN / f"{name}.txt", text, bless=bless)  # not to be linted


def test_is_the_same_every_time() -> None:
    assert all(source(make()) == source(make()) for make in CASES.values())


def machines_of_files() -> Iterator[ir.Machine]:
    for rules in RULES:
        messages = sorted({path.parent for path in rules.parent.rglob("*.msg")})
        with suppress(RulesError):  # many fixtures are about errors
            yield compile_file(rules, message_folders=messages).machine


def test_whatever_is_compiled_is_python() -> None:
    monitors = [PythonMonitor(machine, source(machine)) for machine in machines_of_files()]
    assert len(monitors) > 10


ALONE = """
import sys
sys.path = [folder for folder in sys.path if "site-packages" not in folder]
namespace = {"__name__": "monitor"}
exec(open(sys.argv[1]).read(), namespace)
monitor = namespace["start"]()
assert monitor.update_topic_0(0, 0.7, 0) == 0
assert monitor.next_wake() == 2_000_000_000
assert monitor.advance(2_000_000_000) == 1
(verdict,) = monitor.take_events()
print(namespace["RULES"][verdict.rule].name, verdict.change, verdict.values, monitor.active())
print(sorted({name.partition(".")[0] for name in sys.modules} & {"rossmarie", "numpy", "cffi"}))
"""


def test_runs_alone(tmp_path: Path) -> None:
    (path,) = (tmp_path / name for name in generate(CASES["thresholds"]()))
    path.write_text(source(CASES["thresholds"]()), encoding="utf-8")
    command = [sys.executable, "-I", "-S", "-c", ALONE, str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout == "rule_1 1 (0.7, 0.0) (True, False)\n[]\n"


@pytest.mark.parametrize("case", sorted(CASES))
def test_imports_only_the_standard_library(case: str) -> None:
    imports = [
        node.module if isinstance(node, ast.ImportFrom) else node.names[0].name
        for node in ast.walk(ast.parse(source(CASES[case]())))
        if isinstance(node, (ast.Import, ast.ImportFrom))
    ]
    assert {str(name).partition(".")[0] for name in imports} <= sys.stdlib_module_names


NASTY = 'now = 5\n"""\'\\ # π\u2028\u202e\x00; import os'


@pytest.mark.parametrize("case", sorted(CASES))
def test_names_of_users_cannot_break_the_code(case: str) -> None:
    machine = CASES[case]()
    span = Span(SourceFile(f"{NASTY}.ross", "x\n"), 0, 1)
    nasty = replace(
        machine,
        name=NASTY,
        texts=(NASTY,) * len(machine.texts),
        propositions=tuple(
            replace(t, text=NASTY, name=NASTY, span=span) for t in machine.propositions
        ),
        rules=tuple(replace(r, name=NASTY, contract=NASTY, span=span) for r in machine.rules),
        inputs=tuple(replace(used, name=NASTY, span=span) for used in machine.inputs),
        signals=tuple(replace(s, text=NASTY, span=span) for s in machine.signals),
        channels=tuple(replace(channel, topic=NASTY) for channel in machine.channels),
        slots=tuple(replace(slot, path=(NASTY,)) for slot in machine.slots),
        arrays=tuple(replace(array, path=(NASTY,)) for array in machine.arrays),
    )
    plain, other = ast.parse(source(machine)), ast.parse(source(nasty))
    (start,), (nasty_start,) = (_functions(tree, "start") for tree in (plain, other))
    assert ast.dump(nasty_start) == ast.dump(start)
    PythonMonitor(nasty, source(nasty))
    (name,) = generate(nasty)
    assert name.removesuffix(".py").isidentifier()


def _functions(tree: ast.Module, name: str) -> list[ast.FunctionDef]:
    return [n for n in tree.body if isinstance(n, ast.FunctionDef) and n.name == name]


def test_long_evaluations_are_cut_into_functions() -> None:
    rules = "".join(f"rule r{i}: if battery > {i / 100} V then {{ stop; }};" for i in range(300))
    machine = machine_of_rules(rules)
    text = source(machine)
    assert "def evaluate_1(" in text
    trace = [
        Update(i * SECOND, {machine.inputs[0].channel: ChannelValues({0: x})})
        for i, x in enumerate((0.0, 3.0, 1.5, float("nan"), -1.0))
    ]
    assert observe(PythonMonitor(machine, text), trace) == observe(Interpreter(machine), trace)


# --- numbers at the ends of their range ------------------------------------------------------

LARGEST = sys.float_info.max
ENDS = (-LARGEST, -(2.0**53), -5e-324, -0.0, 0.0, 5e-324, 2.0**53, LARGEST, float("inf"))


@pytest.mark.parametrize("comparison", Comparison)
@pytest.mark.parametrize("limit", ENDS[:-1])
def test_limits_at_the_ends_of_the_numbers(comparison: Comparison, limit: float) -> None:
    draft = Draft()
    draft.rule(draft.proposition(ir.Compare(comparison, draft.read(), draft.constant(limit))))
    machine = draft.machine()
    numbers = [*ENDS, *reversed(ENDS), 2.0**53 + 2, 1.0, -1.0]
    trace = [Update(i, {0: ChannelValues({0: x})}) for i, x in enumerate(numbers)]
    fast = FastCalls(machine, PythonMonitor(machine, source(machine)))
    assert observe(fast, trace) == observe(Interpreter(machine), trace)


def test_integers_beyond_the_exact_ones_are_rounded_before_they_are_compared() -> None:
    draft = Draft()
    draft.rule(draft.above(draft.read(), 2.0**53))
    monitor = PythonMonitor(draft.machine(), source(draft.machine()))
    step = monitor.update_call(0)
    assert [step(0, 2**53), step(1, 2**53 + 1), step(2, 2**53 + 3)] == [0, 0, 1]


def test_integers_that_are_remembered_are_computed_with_as_floats() -> None:
    draft = Draft()
    before = draft.signal(ir.Sampled(ir.Sampling.PREVIOUS, draft.read()))
    draft.rule(draft.above(draft.apply(ir.Function.MULTIPLY, before, before), 1.0))
    step = PythonMonitor(draft.machine(), source(draft.machine())).update_call(0)
    assert [step(at_ns, 10**200) for at_ns in range(3)] == [0, 0, 0]


# --- fast calls ------------------------------------------------------------------------------


def fast() -> PythonMonitor:
    machine = CASES["thresholds"]()
    return PythonMonitor(machine, source(machine))


def test_fast_calls_refuse_nonsense_and_change_nothing() -> None:
    monitor = fast()
    step = monitor.update_call(0)
    for at_ns in (ir.LATEST_NS, ir.EARLIEST_NS, 2**70):
        assert step(at_ns, 1.0, 1.0) == -1
    with pytest.raises(TypeError):
        step(0, 1.0)
    with pytest.raises(TypeError):
        step(0, "fast", True)
    with pytest.raises(TypeError):
        step(0.5, 1.0, True)
    assert monitor.next_wake() is None
    assert step(0, 0.15, False) == 1
    with pytest.raises(TypeError):
        step(5, "fast", True)
    assert step(SECOND, 0.15, False) == 0
    assert step(ir.LATEST_NS, 0.15, False) == -1
    assert [event.at_ns for event in monitor.take_events() if isinstance(event, ir.Verdict)] == [0]


def test_events_of_fast_calls_and_of_updates_are_kept_apart() -> None:
    monitor = fast()
    assert monitor.update_call(0)(0, 0.15, False) == 1
    assert monitor.update(SECOND, {0: ChannelValues({0: 0.7, 1: 0.0})}) == []
    (verdict,) = monitor.reset(2 * SECOND)
    assert isinstance(verdict, ir.Verdict)
    assert verdict.change is Change.CLEARED
    assert len(monitor.take_events()) == 1
    assert monitor.take_events() == []


def test_a_reset_tells_the_numbers_of_a_message_that_changed_nothing() -> None:
    draft = Draft()
    speed = draft.read()
    faster = draft.apply(ir.Function.ADD, speed, draft.constant(1.0))
    draft.rule(draft.above(faster, 2.0), latched=True)
    machine = draft.machine()
    monitor = PythonMonitor(machine, source(machine))
    step = monitor.update_call(0)
    assert [step(0, 5.0), step(1, 0.25), step(2, 0.5)] == [1, 0, 0]
    monitor.take_events()
    (verdict,) = monitor.reset(3)
    assert isinstance(verdict, ir.Verdict)
    assert verdict.values == (1.5,)


def test_a_channel_with_arrays_has_no_fast_call() -> None:
    machine = CASES["arrays"]()
    with pytest.raises(ValueError, match="arrays"):
        PythonMonitor(machine, source(machine)).update_call(0)


def test_instants_out_of_range_are_refused() -> None:
    monitor = fast()
    for at_ns in (ir.LATEST_NS, ir.EARLIEST_NS, 2**80):
        with pytest.raises(ValueError, match="out of range"):
            monitor.update(at_ns, {0: ChannelValues({0: 1.0})})
        with pytest.raises(ValueError, match="out of range"):
            monitor.advance(at_ns)
    assert monitor.next_wake() is None
