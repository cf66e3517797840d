"""Each language works where the other one is not installed, nor who looks at both (thesis, 5.1)."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
WHITEBOARD = ROOT / "examples" / "whiteboard"


def installed(folder: Path, *packages: str) -> dict[str, str]:
    """An environment in which only these packages of the project can be imported."""
    for package in packages:
        shutil.copytree(ROOT / "src" / package, folder / package)
    hidden = [
        "import pathlib, sys",
        "known = [(each, pathlib.Path(each) / 'dslkit') for each in sys.path]",
        f"own = {str(folder)!r}",
        "sys.path[:] = [each for each, ours in known if each == own or not ours.is_dir()]",
        "sys.meta_path[:] = [each for each in sys.meta_path if 'editable' not in repr(each)]",
    ]
    (folder / "sitecustomize.py").write_text("\n".join(hidden))
    return {**os.environ, "PYTHONPATH": str(folder)}


def run(environment: dict[str, str], *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", *arguments],
        cwd=ROOT,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.parametrize("missing", ["ezskiros", "crosscheck"])
def test_rules_that_know_skills_need_no_skills(missing: str, tmp_path: Path) -> None:
    alone = installed(tmp_path, "rossmarie", "dslkit")
    assert run(alone, missing).returncode != 0, "it is not there"
    done = run(alone, "rossmarie", "check", str(WHITEBOARD / "whiteboard.ross"))
    assert (done.returncode, done.stdout) == (0, "no errors in 1 file\n"), done.stderr


def test_skills_need_no_rules(tmp_path: Path) -> None:
    alone = installed(tmp_path, "ezskiros", "dslkit")
    assert run(alone, "rossmarie").returncode != 0, "it is not there"
    done = run(alone, "ezskiros", "check", str(WHITEBOARD / "skills"))
    assert done.returncode == 0, done.stdout + done.stderr


def test_what_asks_for_both_says_that_one_is_missing(tmp_path: Path) -> None:
    alone = installed(tmp_path, "rossmarie", "dslkit")
    done = run(alone, "rossmarie", "check", "--skills", str(WHITEBOARD / "whiteboard.ross"))
    assert done.returncode == 2, done.stdout + done.stderr
    assert "needs the package crosscheck" in done.stderr
