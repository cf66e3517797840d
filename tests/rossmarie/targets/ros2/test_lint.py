"""The linters that a generated package runs on itself find nothing in it."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

from rossmarie.driver.build import generate
from support.c_compiler import write
from support.live_cases import acting, vehicle
from support.parts import AMENT_LINT, needs

EXCLUDED = "ament_cmake_copyright ament_cmake_cpplint ament_cmake_uncrustify"


def test_a_package_names_the_linters_that_it_does_without() -> None:
    files = generate(vehicle("ros2"), "ros2")
    assert f"set(AMENT_LINT_AUTO_EXCLUDE {EXCLUDED})" in files["CMakeLists.txt"]
    for package in ("ament_lint_auto", "ament_lint_common"):
        assert f"<test_depend>{package}</test_depend>" in files["package.xml"]


@needs(AMENT_LINT)
@pytest.mark.parametrize(
    "linter",
    [
        "ament_cppcheck --language c++",
        "ament_flake8",
        "ament_lint_cmake",
        "ament_pep257",
        "ament_xmllint",
    ],
)
def test_a_linter_finds_nothing(linter: str, tmp_path: Path) -> None:
    for name, machine in {"much": vehicle("ros2"), "little": acting('log info "x"')}.items():
        write(generate(machine, "ros2"), tmp_path / name)
    # Without this variable, ament_cppcheck does nothing with some versions of cppcheck.
    variables = {**os.environ, "AMENT_CPPCHECK_ALLOW_SLOW_VERSIONS": "1"}
    done = subprocess.run(
        [*linter.split(), str(tmp_path)], env=variables, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
