"""Programs that CBMC calls as solvers. The programs of a workshop take precedence over the
system's.
"""

import shlex
import sys
from pathlib import Path

_ANY_ARITHMETIC = Path(__file__).with_name("any_arithmetic.py").absolute()
"""A path, because the solver runs in another folder than ROSSMARie, which may have been imported
from a relative path.
"""

_CADICAL = """\
#!/bin/sh
# Most obligations hold, so their formulas are unsatisfiable. The option `--unsat` makes such
# proofs several times as fast.
PATH=${PATH#*:}
exec cadical --unsat "$@"
"""

_Z3 = """\
#!/bin/sh
# By default, z3 first substitutes equations into each other. For many obligations this never ends.
PATH=${PATH#*:}
exec z3 tactic.default_tactic=smt "$@"
"""

_BOOLECTOR = f"""\
#!/bin/sh
# CBMC writes numbers and structures as bits for this solver. Bitwuzla is its successor.
exec {shlex.quote(sys.executable)} {shlex.quote(str(_ANY_ARITHMETIC))} "$@"
"""

SCRIPTS = {"cadical": _CADICAL, "z3": _Z3, "boolector": _BOOLECTOR}
"""Scripts for `sh`, by the names under which CBMC calls them."""
