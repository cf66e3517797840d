"""Programs that CBMC calls as solvers. The programs of a workshop take precedence over the
system's.
"""

_CADICAL = """\
#!/bin/sh
# Most obligations hold, so their formulas are unsatisfiable. The option `--unsat` makes such
# proofs several times as fast.
PATH=${PATH#*:}
exec cadical --unsat "$@"
"""

_Z3 = r"""#!/bin/sh
# By default, z3 first substitutes equations into each other. For many obligations this never ends.
PATH=${PATH#*:}
for file; do :; done # the last argument
name='float_bv[.]floatbv_[^ ]+'
number='[(]_ BitVec [0-9]+[)]'
operand="[(]op[0-9]+ ($number)[)]"
if ! grep -Eq "^[(]define-fun $name" "$file"; then
    exec z3 tactic.default_tactic=smt "$@"
fi

# If numbers are bits, CBMC defines the bits of each result. A proof that two sums of the same
# operands are equal does not need these definitions, so each operation becomes an arbitrary
# function. An obligation that holds for arbitrary functions holds for the operations. An obligation
# that fails for arbitrary functions may still hold for the operations.
sed -E -i "s/^([(]define-fun ($name) [(]($operand $operand $operand)[)] ($number)) .*/"\
"(declare-fun any_\2 (\3) \7)\n\1 (any_\2 op0 op1 op2))/" "$file"

# The generated C uses differences to test whether a number is finite. Differences therefore keep
# three facts: an unknown operand gives an unknown result, x - 0 is x, x - x is 0 for a finite x.
NAN='(_ bv9218868437227405313 64)'
is_large() { echo "(= ((_ extract 62 52) $1) (_ bv2047 11))"; }
is_nan() { echo "(and $(is_large "$1") (not (= ((_ extract 51 0) $1) (_ bv0 52))))"; }
itself="(ite $(is_large op0) $NAN (_ bv0 64))"
difference="(ite (or $(is_nan op0) $(is_nan op1)) $NAN (ite (= op1 (_ bv0 64)) op0 "\
"(ite (and (= op0 op1) (= op2 (_ bv0 32))) $itself &)))"
sed -E -i \
    -e "/^[(]declare-fun any_/s/$operand/\1/g" \
    -e "/^[(]define-fun float_bv[.]floatbv_minus_f64/s/[(]any_[^)]*[)]/$difference/" "$file"
z3 tactic.default_tactic=smt "$@" | sed 's/^sat$/unknown/'
"""

SCRIPTS = {"cadical": _CADICAL, "z3": _Z3}
"""Scripts for `sh`, by the names under which they are called."""
