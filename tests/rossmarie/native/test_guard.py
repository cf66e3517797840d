"""The C of a guard compiles with all warnings, whatever its rules have and lack."""

from __future__ import annotations

from pathlib import Path

import pytest

from rossmarie.native.monitor import with_own
from rossmarie.targets.c99 import generate_guard
from support.c99_cases import CASES
from support.c_compiler import STRICT, needs_c, run, write

pytestmark = needs_c


@pytest.mark.parametrize("case", CASES)
def test_the_c_of_a_guard_has_no_warnings(case: str, tmp_path: Path) -> None:
    write(with_own(generate_guard(CASES[case]())), tmp_path)
    run(["cc", "-std=c99", *STRICT, "-fsyntax-only", str(tmp_path / "guarding.c")])
