"""Runs the generated C of `rules.ross`, as it is or damaged, and says who notices the damage.

Each run is a process of its own, so that a fault may crash or never end.
"""

from __future__ import annotations

import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import islice
from pathlib import Path

from dslkit.source import SourceFile
from mutation.faults import Fault
from mutation.traces import chosen_traces, random_events, random_trace, scripted
from rossmarie.driver import compile_file
from rossmarie.driver.generating import generate_tests
from rossmarie.interpreter import Interpreter
from rossmarie.targets import c99
from support import c_reacting, c_replay
from support.c_compiler import write
from support.damage import damaged, sources
from support.machines import Observation, observe

RULES = Path(__file__).with_name("rules.ross")
GENERATED_TESTS = "tests generated from the rules"
TRACES = "traces, random and chosen"

_STEPS = 4000
_EVENTS = 1500
_ENOUGH = "ulimit -t 2; exec $0"
"""The maximum processor time of a run (s). Without a mutation, a run needs a tenth of it."""


@dataclass(frozen=True)
class Seen:
    """The observations of a build, by the programs that are run on it."""

    by: Mapping[str, Sequence[str]]


class Bench:
    """The rules, what is run on them, and what it shows where nothing is damaged."""

    def __init__(self) -> None:
        written = generate_tests(RULES)
        tested = compile_file(RULES, tests=SourceFile(str(written.path), written.text))
        self.machine = compile_file(RULES).machine
        self._scripts = [scripted(tested.machine, script) for script in tested.tests]
        self._trace = random_trace(self.machine, _STEPS)
        self._case = random_events(self.machine, _EVENTS)
        self.sources = {**c99.generate(self.machine), **c99.generate_loadable(self.machine)}

    def noticed(self, fault: Fault) -> frozenset[str]:
        """The checks that detect a mutant."""
        undamaged = self._monitor if fault.part == "monitor" else self._reactor
        look = self._see_monitor if fault.part == "monitor" else self._see_reactor
        seen = look(self.damaged(fault))
        return frozenset(who for who, lines in undamaged.by.items() if seen.by[who] != lines)

    def damaged(self, fault: Fault) -> dict[str, str]:
        """The generated files with a fault, which is made at one place."""
        texts = sources(self.sources, fault.part).values()
        assert sum(text.count(fault.old) for text in texts) == 1, (fault.name, fault.old)
        return damaged(self.sources, fault.part, fault.old, fault.new)

    @cached_property
    def _monitor(self) -> Seen:
        return self._see_monitor(self.sources)

    @cached_property
    def _reactor(self) -> Seen:
        return self._see_reactor(self.sources)

    @cached_property
    def _given(self) -> Sequence[bytes]:
        """The input of the two runs of the monitor: generated tests, and traces."""
        machine = self.machine
        no_table = bytes(8 * (1 + len(machine.slots) + 2 * len(machine.arrays)))
        no_table += bytes(len(machine.channels))
        runs = (self._scripts, [self._trace, *chosen_traces(machine)])
        return [
            b"".join(c_replay.trace_bytes(machine, trace) + no_table for trace in traces)
            for traces in runs
        ]

    def _see_monitor(self, files: Mapping[str, str]) -> Seen:
        tests, traces = outputs(files, c_replay.program(self.machine), self._given)
        verdicts = [line for line in tests if not line.startswith(_BESIDE)]
        return Seen({GENERATED_TESTS: verdicts, TRACES: traces})

    def _see_reactor(self, files: Mapping[str, str]) -> Seen:
        given = [c_reacting.event_bytes(self._case)]
        (lines,) = outputs(files, c_reacting.program(self.machine), given)
        return Seen({TRACES: lines})

    # --- without damage ----------------------------------------------------------------------

    def expected_of_monitor(self) -> tuple[object, object]:
        """The output of the interpreter and of the generated C for the long trace."""
        traces = [self._trace, *chosen_traces(self.machine)]
        lines = "\n".join(self._monitor.by[TRACES]).encode()
        found = c_replay.observations(self.machine, lines, sum(map(len, traces)) + 2 * len(traces))
        left = iter(found)
        wanted: list[Observation] = []
        reported: list[Observation] = []
        for trace in traces:
            wanted += observe(Interpreter(self.machine), trace)
            next(left)  # the state before it
            reported += islice(left, len(trace))
            next(left)  # the state after no columns at all
        return wanted, reported

    def expected_of_reactor(self) -> tuple[object, object]:
        """The same for the reactor."""
        return c_reacting.wanted(self._case), self._reactor.by[TRACES]


_BROKEN = "crashed, or did not end"
_BESIDE = ("step ", "known ", "jump ")


def outputs(files: Mapping[str, str], main: str, given: Sequence[bytes]) -> list[list[str]]:
    """The output of a program for each of its inputs."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write({**files, "main.c": main}, folder)
        command = [
            "cc",
            "-std=c99",
            "-O0",
            "-w",
            "-ffp-contract=off",
            "-o",
            "main",
            "main.c",
            "-lm",
        ]
        subprocess.run(command, cwd=folder, check=True, capture_output=True)
        found: list[list[str]] = []
        for each in given:
            found.append(_output(folder / "main", each))
            if found[-1][-1:] == [_BROKEN]:
                break  # it would take its time on the others as well
        return [*found, *([_BROKEN] for _ in given[len(found) :])]


def _output(program: Path, given: bytes) -> list[str]:
    call = ["sh", "-c", _ENOUGH, str(program)]
    done = subprocess.run(call, input=given, capture_output=True, check=False)
    lines = done.stdout.decode("ascii").splitlines()
    return [*lines, *([_BROKEN] if done.returncode else [])]
