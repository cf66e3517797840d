"""A solver for CBMC: Bitwuzla, about any arithmetic.

A proof that two sums of the same operands are equal does not need the bits of the sums. Therefore
this program replaces sums, products and quotients by arbitrary functions. An obligation that holds
for arbitrary functions holds for the operations. An obligation that fails for them may still hold,
so the answer is "unsat" or "unknown", never "sat".

`python any_arithmetic.py FILE` prints the answer about an SMT-LIB 2 file of CBMC. Its caller limits
the CPU time of the program.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

import bitwuzla

_NUMBER = r"\(_ BitVec \d+\)"
_OPERATION = re.compile(
    rf"^\(define-fun (float_bv\.floatbv_\S+) "
    rf"\(\(op0 ({_NUMBER})\) \(op1 ({_NUMBER})\) \(op2 ({_NUMBER})\)\) ({_NUMBER}) .*",
    re.MULTILINE,
)
"""CBMC's definition of the bits of a result. The operands are two numbers and a rounding mode."""

_NAN = "(_ bv9218868437227405313 64)"


def _is_large(operand: str) -> str:
    """State that a number is infinite or unknown."""
    return f"(= ((_ extract 62 52) {operand}) (_ bv2047 11))"


def _is_nan(operand: str) -> str:
    return f"(and {_is_large(operand)} (not (= ((_ extract 51 0) {operand}) (_ bv0 52))))"


_DIFFERENCE = (
    f"(ite (or {_is_nan('op0')} {_is_nan('op1')}) {_NAN} (ite (= op1 (_ bv0 64)) op0 "
    f"(ite (and (= op0 op1) (= op2 (_ bv0 32))) (ite {_is_large('op0')} {_NAN} (_ bv0 64)) {{}})))"
)
"""The generated C uses differences to test whether a number is finite. Arbitrary differences
therefore keep three facts: an unknown operand gives an unknown result, x - 0 is x, and x - x is 0
for a finite x.
"""


def with_any_arithmetic(formula: str) -> str:
    """The formula with an arbitrary function in place of each operation."""
    return _OPERATION.sub(_any_operation, formula)


def _any_operation(found: re.Match[str]) -> str:
    name, first, second, rounding, result = found.groups()
    value = f"(any_{name} op0 op1 op2)"
    if name.startswith("float_bv.floatbv_minus_f64"):
        value = _DIFFERENCE.format(value)
    return (
        f"(declare-fun any_{name} ({first} {second} {rounding}) {result})\n"
        f"(define-fun {name} ((op0 {first}) (op1 {second}) (op2 {rounding})) {result} {value})"
    )


def is_unsatisfiable(formula: str) -> bool:
    """Say whether Bitwuzla proves a formula of CBMC unsatisfiable for any arithmetic.

    Raises `bitwuzla.BitwuzlaException` if the formula is not SMT-LIB 2.
    """
    asserted = with_any_arithmetic(formula).partition("(check-sat)")[0]
    parser = bitwuzla.Parser(bitwuzla.TermManager(), bitwuzla.Options())
    parser.parse(asserted, parse_only=True, parse_file=False)
    return bool(parser.bitwuzla().check_sat() == bitwuzla.Result.UNSAT)


def main(arguments: list[str]) -> None:
    """Print the answer about the file in these arguments of a solver."""
    file = next(word for word in arguments if not word.startswith("-"))
    proved = is_unsatisfiable(Path(file).read_text(encoding="utf-8"))
    sys.stdout.write("unsat\n" if proved else "unknown\n")


if __name__ == "__main__":
    main(sys.argv[1:])
