"""CBMC with its solvers: the facts about arbitrary differences are true, and a model of another
arithmetic does not count as an answer.
"""

from __future__ import annotations

import pytest

from rossmarie.verification.check import Check
from rossmarie.verification.harness import Harness
from rossmarie.verification.program import PRELUDE
from rossmarie.verification.prover import ProofVerdict, Prover
from support.depth import deep
from support.provers import real_prover


@pytest.fixture(scope="module")
def prover() -> Prover:
    return real_prover()


def verdict(prover: Prover, obligation: str, *, is_arithmetic: bool) -> ProofVerdict:
    check = Check("it", "something about numbers", is_arithmetic=is_arithmetic)
    text = (
        f"{PRELUDE}\nstatic int a[2];\n\nvoid check_it(double x, double y, unsigned n)\n{{\n"
        "    a[n % 2] = 1;\n"  # something that C forbids elsewhere
        f'    __CPROVER_assert({obligation}, "it holds");\n}}\n'
    )
    with prover.workshop() as folder:
        harness = Harness(text, (check,), passes=1)
        prover.compile(folder, harness)
        return prover.run(harness, check, folder, 60).verdict


@pytest.mark.parametrize(
    "fact",
    [
        "isnan(x) || (x - 0.0 == x && signbit(x - 0.0) == signbit(x))",
        "!isfinite(x) || (x - x == 0.0 && !signbit(x - x))",
        "isfinite(x) || isnan(x - x)",
        "!isnan(x) || (isnan(x - y) && isnan(y - x))",
    ],
)
def test_what_is_reported_of_differences_is_so(prover: Prover, fact: str) -> None:
    """A SAT solver looks at every bit."""
    assert verdict(prover, fact, is_arithmetic=False) is ProofVerdict.PROVED


@pytest.mark.parametrize(
    ("obligation", "expected"),
    [
        ("isnan(x * y / (x + y)) || x * y / (x + y) == x * y / (x + y)", ProofVerdict.PROVED),
        *deep(
            [
                ("isnan(x) || x * 1.0 == x", ProofVerdict.PROVED),
                ("x + 1.0 > x", ProofVerdict.REFUTED),
            ]
        ),
        ("!isfinite(x) || !isfinite(y) || x - y == x", ProofVerdict.REFUTED),
    ],
)
def test_what_holds_of_some_arithmetic_only_is_decided_by_its_bits(
    prover: Prover, obligation: str, expected: ProofVerdict
) -> None:
    assert verdict(prover, obligation, is_arithmetic=True) is expected
