"""Every line of the generated C is reached by a check, because unreached code is not proved."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

from dslkit.writing import write_texts
from rossmarie.driver.verifying import queries_of
from rossmarie.verification.prover import Prover, _unwound
from support.provers import real_prover
from support.small_rules import BOUNDED, LATE, OVERRULED, TILTED

pytestmark = pytest.mark.deep

SHARED = """\
input speed = topic /speed : std_msgs/Float64 .data;
action beep { publish /horn : std_msgs/Bool { data = true; } at 5 Hz; }
action mute { publish /horn : std_msgs/Bool { data = false; } at 5 Hz; }
action forward { send actionlib/Test { goal = 1; } to /arm within 1 sec then resend; }
action home { send actionlib/Test { goal = 2; } to /arm within 1 sec; }
rule loud: if speed > 4 then { beep; forward; };
rule quiet: if speed > 6 then { mute; home; };
priority quiet over loud;
"""

NEVER = {("derive", "default: return UNKNOWN;")}
"""Lines that no state of a monitor reaches."""

NEVER_IN_REACTORS = {("is_answered", "return false;")}
"""Lines that no state of a reactor reaches: a waiting task with a time limit has a command, and
another rule holds its resource.
"""


_FUNCTION = re.compile(r"^\w[^;{}=#]*?\b(\w+)\([^;{}]*\)\s*\{", re.MULTILINE)


class Line(NamedTuple):
    """A line of the generated C. Without a text it stands for the whole function."""

    function: str
    text: str


@pytest.fixture(scope="module")
def prover() -> Prover:
    return real_prover()


def goals(prover: Prover, folder: Path, command: list[str]) -> Iterator[tuple[str, Line, str]]:
    """Name, place and status of what can be reached, in files that were generated."""
    for message in json.loads(prover._must(command, folder)):
        for goal in (*message.get("goals", ()), *message.get("properties", ())):
            at = goal["sourceLocation"]
            if at["file"].startswith(("small_", "engine/")):
                lines = (folder / at["file"]).read_text().splitlines()
                line = Line(at["function"], lines[int(at["line"]) - 1].strip())
                yield goal.get("goal") or goal["name"], line, goal.get("status", "")


def looked_at(prover: Prover, folder: Path, rules: str, part: str) -> tuple[set[Line], set[Line]]:
    """The lines of one generated file and of the engine at which something begins, and those that a
    check reaches.
    """
    path = folder / "small.ross"
    path.write_text(rules)
    queries = queries_of(path)
    name = f"small_{part}.c"
    (program,) = (each for each in queries.programs if f'#include "{name}"' in each.text)
    found = {Line(function, "") for function in _FUNCTION.findall(queries.files[name])}
    reached: set[Line] = set()
    with prover.workshop() as workshop:
        write_texts(workshop, queries.texts())
        prover.compile(workshop, program)
        for check in program.checks:
            command = ["cbmc", prover._compile(program, check, workshop), "--json-ui"]
            command += ["--unwind", str(program.passes), *_unwound(check)]
            command += ["--cover", "location", "--no-standard-checks", "--slice-formula"]
            listed = list(goals(prover, workshop, [*command, "--show-properties"]))
            found |= {line for _, line, _ in listed}
            new = [
                word
                for goal, line, _ in listed
                if line not in reached
                for word in ("--property", goal)
            ]
            for _, line, status in goals(prover, workshop, [*command, *new]) if new else ():
                reached |= {line, Line(line.function, "")} if status == "satisfied" else set()
    return found, reached


def overlooked(found: set[Line], reached: set[Line]) -> set[Line]:
    """Generated functions that no check enters, and lines that none reaches, of functions that one
    enters: the engine has more functions than each monitor uses.
    """
    entered = {line.function for line in reached}
    return {line for line in found - reached if not line.text or line.function in entered}


def test_every_line_of_a_monitor_is_looked_at(prover: Prover, tmp_path: Path) -> None:
    found, reached = looked_at(prover, tmp_path, TILTED, "monitor")
    assert len(reached) > 150
    assert overlooked(found, reached) == NEVER


def test_every_line_of_a_reactor_is_looked_at(prover: Prover, tmp_path: Path) -> None:
    """Each line that one machine does not use is used by another."""
    found: set[Line] = set()
    reached: set[Line] = set()
    for rules in (BOUNDED, SHARED, OVERRULED, LATE):
        there, seen = looked_at(prover, tmp_path, rules, "reactor")
        found, reached = found | there, reached | seen
    assert len(reached) > 100
    assert overlooked(found, reached) == NEVER_IN_REACTORS
