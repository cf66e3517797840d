"""Bitwuzla's answer about any arithmetic: a proof, or no answer."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from rossmarie.verification import any_arithmetic
from rossmarie.verification.any_arithmetic import is_unsatisfiable, with_any_arithmetic

BITS = "(_ BitVec 64)"


def formula(operation: str, denied: str) -> str:
    """A formula of CBMC: a result of an operation whose bits are a sum, and a denied sentence."""
    name = f"float_bv.floatbv_{operation}_f64_52->f64_52"
    return "\n".join(
        [
            "(set-logic QF_AUFBV)",
            f"(declare-fun x () {BITS})",
            f"(declare-fun y () {BITS})",
            f"(define-fun {name} ((op0 {BITS}) (op1 {BITS}) (op2 (_ BitVec 32))) {BITS} "
            "(bvadd op0 op1))",
            f"(define-fun result () {BITS} ({name} x y (_ bv0 32)))",
            f"(define-fun again () {BITS} ({name} x y (_ bv0 32)))",
            f"(assert (not {denied}))",
            "(check-sat)",
            "(get-value (x))",
            "(exit)",
            "; end of SMT2 file",
            "",
        ]
    )


OPERATIONS = pytest.mark.parametrize("operation", ["plus", "minus", "mult", "div"])


@OPERATIONS
def test_a_result_is_a_function_of_its_operands(operation: str) -> None:
    assert is_unsatisfiable(formula(operation, "(= result again)"))
    assert is_unsatisfiable(formula(operation, "(=> (= x y) (= result again))"))


@OPERATIONS
def test_the_bits_of_a_result_prove_nothing(operation: str) -> None:
    text = formula(operation, "(= result (bvadd x y))")
    assert not is_unsatisfiable(text)
    assert "(bvadd op0 op1)" not in with_any_arithmetic(text)


def test_an_unknown_operand_gives_an_unknown_difference() -> None:
    def is_nan(word: str) -> str:
        return (
            f"(and (= ((_ extract 62 52) {word}) (_ bv2047 11)) "
            f"(not (= ((_ extract 51 0) {word}) (_ bv0 52))))"
        )

    denied = f"(=> {is_nan('y')} {is_nan('result')})"
    assert is_unsatisfiable(formula("minus", denied))
    assert not is_unsatisfiable(formula("plus", denied))


@pytest.mark.parametrize(
    ("denied", "answer"), [("(= result again)", "unsat\n"), ("(= x y)", "unknown\n")]
)
def test_the_program_prints_its_answer(tmp_path: Path, denied: str, answer: str) -> None:
    file = tmp_path / "problem"
    file.write_text(formula("plus", denied))
    command = [sys.executable, any_arithmetic.__file__, "--smt2", str(file), "-m"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout == answer


def test_a_broken_formula_has_no_answer(tmp_path: Path) -> None:
    file = tmp_path / "problem"
    file.write_text(formula("plus", "(= x nobody)"))
    command = [sys.executable, any_arithmetic.__file__, str(file)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode != 0
    assert "sat" not in done.stdout
