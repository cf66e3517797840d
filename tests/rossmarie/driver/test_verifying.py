"""Proofs by CBMC itself, from a rules file to the verdict."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from dslkit.source import Span
from rossmarie.driver.build import generate
from rossmarie.driver.verifying import VerificationQueries, prove, queries_of
from rossmarie.report.proofs import Proofs, parts_without_queries, refutations
from rossmarie.verification.prover import Prover
from support.damage import damaged
from support.provers import real_prover

SECONDS = 120
RULES = """\
action stop;
input speed = topic /speed : std_msgs/Float64 .data;
rule fast: if speed > 3 then { stop; } latched until reset;
"""

BESIDE = """\
action stop;
input gap = topic /gap : std_msgs/Float64 .data in m timeout 0.2 sec;
input ranges = topic /scan : sensor_msgs/LaserScan .ranges timeout 0.2 sec;
rule near: if any(ranges < gap) then { stop; };
"""


@pytest.fixture(scope="module")
def prover() -> Prover:
    return real_prover()


@pytest.fixture(scope="module")
def judged(tmp_path_factory: pytest.TempPathFactory) -> VerificationQueries:
    """The query of how a rule is evaluated."""
    path = tmp_path_factory.mktemp("rules") / "fast.ross"
    path.write_text(RULES)
    found = queries_of(path)
    program = found.programs[0]
    checks = [check for check in program.checks if check.about == "rule fast is evaluated"]
    return replace(found, programs=(replace(program, checks=tuple(checks)),))


def changed(queries: VerificationQueries, old: str, new: str) -> VerificationQueries:
    """As if the generator had written something else."""
    return replace(queries, files=damaged(queries.files, "monitor", old, new))


def shown(proofs: Proofs, queries: VerificationQueries) -> list[tuple[str, str]]:
    """The findings: the sentence, and where it is pointed at."""
    nowhere = Span(queries.compiled.sources[-1], 0, 0)
    found = refutations(proofs, nowhere)
    return [(each.primary.text, each.primary.span.text) for each in found]


def test_a_number_beside_elements_has_a_part_without_queries(tmp_path: Path) -> None:
    path = tmp_path / "near.ross"
    path.write_text(BESIDE)
    found = queries_of(path)
    assert "define BESIDE 1" in "".join(generate(found.compiled.machine, "c99").values())
    assert "define BESIDE 1" not in "".join(found.files.values())
    (part,) = parts_without_queries(found.compiled.machine)
    assert part == "messages at the instant at which a number beside elements expires"


def test_what_is_right_is_proved(prover: Prover, judged: VerificationQueries) -> None:
    reported: list[float] = []
    proofs = prove(judged, prover, seconds=SECONDS, on_progress=reported.append)
    assert proofs.is_complete
    assert proofs.tools["cbmc"].startswith("6.")
    assert reported == [1.0]


def test_a_fault_in_the_generated_c_is_refuted_where_the_rule_is(
    prover: Prover, judged: VerificationQueries
) -> None:
    wrong = changed(judged, "condition == STALE", "condition == UNKNOWN")
    proofs = prove(wrong, prover, seconds=SECONDS)
    assert not proofs.is_inductive
    sentences = (
        "rule fast is active according to S35 to S37",
        "the report of rule fast is right (S41)",
    )
    possible = {(f"does not hold: {sentence}", "fast") for sentence in sentences}
    assert possible.intersection(shown(proofs, wrong))
