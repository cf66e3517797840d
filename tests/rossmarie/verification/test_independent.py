"""The proofs share nothing with the generator that decides a meaning.

A fault is put into a source file that the generator reads; then rules are compiled, the C and the
queries are written, all by the damaged copy. The C is wrong, so at least one query about it is
refuted.
"""

from __future__ import annotations

import os
import pickle
import shutil
import subprocess
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import pytest

import rossmarie
from dslkit.writing import write_texts
from rossmarie.verification.harness import Harness
from rossmarie.verification.prover import ProofVerdict, Prover
from support.depth import deep
from support.provers import real_prover

SECONDS = 120

TWO_TOPICS = """\
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec;
input belt = topic /belt : std_msgs/Float64 .data in km/h timeout 0.5 sec;
action stop;
rule slips: if speed > belt then { stop; };
"""
ONE_TOPIC = """\
input belt = topic /belt : std_msgs/Float64 .data in km/h timeout 0.5 sec;
action stop;
rule fast: if belt > 3 km/h then { stop; };
"""
MORE_RULES = f"""\
{TWO_TOPICS}
rule fast: if speed + belt > 3 km/h then {{ stop; }};
rule both: if speed > 2 m/s and belt > 2 m/s then {{ stop; }};
"""

WRITE = """\
import pickle, sys
from pathlib import Path
from rossmarie.driver.verifying import queries_of
queries = queries_of(Path(sys.argv[1]))
sys.stdout.buffer.write(pickle.dumps((queries.files, queries.programs)))
"""


@dataclass(frozen=True)
class Fault:
    """A change of a source file, and the query that refutes what comes of it."""

    file: str
    old: str
    new: str
    refuted_by: str
    rules: str = MORE_RULES


@dataclass(frozen=True)
class Asked:
    """The input of a prover: the generated files, and the programs with the queries."""

    files: Mapping[str, str]
    programs: tuple[Harness, ...]


def damaged(fault: Fault, folder: Path) -> Path:
    """A copy of the sources with the fault in it."""
    copy = folder / "rossmarie"
    shutil.copytree(
        Path(rossmarie.__file__).parent, copy, ignore=shutil.ignore_patterns("__pycache__")
    )
    source = copy / fault.file
    text = source.read_text()
    assert text.count(fault.old) == 1, f"{fault.file} has this once: {fault.old}"
    source.write_text(text.replace(fault.old, fault.new))
    return folder


def written(sources: Path, folder: Path, text: str) -> Asked:
    """The files and queries that these sources make of rules."""
    rules = folder / "small.ross"
    rules.write_text(text)
    search = os.pathsep.join([str(sources), os.environ.get("PYTHONPATH", "")])
    done = subprocess.run(
        [sys.executable, "-c", WRITE, str(rules)],
        env={**os.environ, "PYTHONPATH": search},
        stdout=subprocess.PIPE,
        check=True,
    )
    return Asked(*pickle.loads(done.stdout))


def verdicts(prover: Prover, asked: Asked, check: str) -> Iterator[ProofVerdict]:
    """The outcomes of the queries whose names begin so."""
    with prover.workshop() as folder:
        write_texts(folder, asked.files)
        for program in asked.programs:
            prover.compile(folder, program)
            for each in program.checks:
                if each.name.startswith(check):
                    yield prover.run(program, each, folder, SECONDS).verdict


SUPPORT = "ir/support.py"
_COMPARED = "            return (left, right)"
QUICK = (
    Fault(
        "targets/c99/types.py",
        "text = repr(value)",
        'text = f"{value:.6g}"',
        "numbers_belt",
        ONE_TOPIC,
    ),
)
_OPERANDS = "case ir.Apply(operands=operands):\n            return operands"
_OF_PROPOSITIONS = (
    "case ir.And(operands=operands) | ir.Or(operands=operands):\n            return operands"
)
_TERMS = "return tuple(_terms(machine, condition))"
_OF_SLOT = "inputs=frozenset({slot.input}),"
_OF_READ = "slots=frozenset({slot}),\n                inputs=frozenset({used}),"
FAULTS = (
    Fault(SUPPORT, _COMPARED, f"{_COMPARED}[:1]", "numbers_belt", TWO_TOPICS),
    Fault(SUPPORT, _OPERANDS, f"{_OPERANDS}[:1]", "numbers_belt"),
    Fault(SUPPORT, _OF_PROPOSITIONS, f"{_OF_PROPOSITIONS}[:1]", "visit"),
    Fault("ir/terms.py", _TERMS, f"{_TERMS}[:1]", "visit"),
    Fault(SUPPORT, _OF_READ, _OF_READ.replace("{used}", "{0}"), "tick"),
    Fault("targets/c99/layout.py", _OF_SLOT, "inputs=frozenset({0}),", "tick"),
)


@pytest.fixture(scope="module")
def prover() -> Prover:
    return real_prover()


@pytest.mark.parametrize("fault", FAULTS, ids=lambda each: each.new.strip())
def test_the_sources_have_what_a_fault_changes(fault: Fault, tmp_path: Path) -> None:
    assert fault.new in (damaged(fault, tmp_path) / "rossmarie" / fault.file).read_text()


@pytest.mark.parametrize("fault", [*QUICK, *deep(FAULTS)], ids=lambda each: each.new.strip())
def test_a_fault_in_what_the_generator_reads_is_refuted(
    prover: Prover, fault: Fault, tmp_path: Path
) -> None:
    asked = written(damaged(fault, tmp_path / "sources"), tmp_path, fault.rules)
    assert ProofVerdict.REFUTED in set(verdicts(prover, asked, fault.refuted_by))


@pytest.mark.deep
def test_undamaged_sources_are_proved(prover: Prover, tmp_path: Path) -> None:
    asked = written(Path(rossmarie.__file__).parents[1], tmp_path, MORE_RULES)
    assert set(verdicts(prover, asked, "numbers_belt")) == {ProofVerdict.PROVED}
