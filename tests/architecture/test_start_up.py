"""A check of a small file does not load modules that take as long as the check itself."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[2] / "examples"
RUN = """
import sys
from {program}.__main__ import main
try:
    main()
finally:
    print(*sys.modules, file=sys.stderr)
"""
FOR_OTHER_COMMANDS = {
    *("apsw", "cffi", "jinja2", "libcst", "lz4", "matplotlib", "mujoco", "numpy", "py_trees"),
    *("pydantic", "rich", "rosbags", "ruamel", "shapely"),
}
CHECKS = {
    "rossmarie": (
        EXAMPLES / "demo" / "demo.ross",
        FOR_OTHER_COMMANDS | {"lark", "pyoxigraph", "rossmarie.syntax.habits", "rossmarie.report"},
    ),
    "ezskiros": (
        EXAMPLES / "pick_place" / "skills" / "motions.py",
        FOR_OTHER_COMMANDS | {"lark", "z3", "ezskiros.migrate", "ezskiros.engine.task"},
    ),
}


@pytest.mark.parametrize("program", CHECKS)
def test_a_check_loads_nothing_that_is_for_others(program: str) -> None:
    path, unwanted = CHECKS[program]
    words = [sys.executable, "-c", RUN.format(program=program), "check", str(path)]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (0, "no errors in 1 file\n"), done.stderr
    assert not unwanted & set(done.stderr.split())
