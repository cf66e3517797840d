"""`ezskiros run` without `--simulate`: what is only stood in for is never a success."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from support import command_line

SKILL = """
from ezskiros import SkillDescription

{top}

class Grip(SkillDescription):
    def description(self): pass

class grip(Grip.SkillBase):
    def execute(self):
        {body}
        return self.success("held")
"""
REFUSED = (
    "ezskiros: nothing was run: modules above were missing or not fully executed, so primitives "
    "would have no effect; install them, import them in the methods that use them, or add "
    "`--simulate`"
)


def run(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    return command_line.run("ezskiros", "run", *words, folder=folder)


def is_refused(done: subprocess.CompletedProcess[str], code: str = "EZS004") -> bool:
    """Say whether nothing was run and the reason was printed."""
    is_reported = f"warning[{code}]" in done.stdout and done.stderr.splitlines()[-1] == REFUSED
    return done.returncode == 2 and is_reported and "held" not in done.stdout


@pytest.mark.parametrize(
    ("top", "body"),
    [
        ("import no_arm", "no_arm.close()"),
        ("import no_arm.fingers.left", "no_arm.fingers.left.close()"),
        ("import no_arm as arm", "arm.close()"),
        ("from no_arm import close", "close()"),
        ("from no_arm.fingers import close", "close()"),
        ("import no_arm\nCLOSE = no_arm.close", "CLOSE()"),
        ("import no_arm\ndef close(): no_arm.close()", "close()"),
        ("try:\n    import no_arm\nexcept ImportError:\n    no_arm = None", "no_arm.close()"),
        ("no_arm = __import__('no_arm')", "no_arm.close()"),
        ("import no_arm", "pass"),
    ],
)
@pytest.mark.parametrize("is_helper", [False, True], ids=["in the file", "in another"])
def test_a_module_that_is_not_installed_refuses_the_run(
    tmp_path: Path, top: str, body: str, is_helper: bool
) -> None:
    if is_helper:
        (tmp_path / "helper.py").write_text(top)
        top = "import helper\nfrom helper import *"
    (tmp_path / "grip.py").write_text(SKILL.format(top=top, body=body))
    assert is_refused(run(tmp_path, "Grip", "grip.py"))


@pytest.mark.parametrize(
    ("top", "body"),
    [
        ("", "import no_arm; no_arm.close()"),
        ("", "from no_arm.fingers import close; close()"),
        ("import importlib", "importlib.import_module('no_arm').close()"),
        ("def close():\n    import no_arm\n    no_arm.close()", "close()"),
    ],
)
def test_what_is_imported_when_it_is_used_fails(tmp_path: Path, top: str, body: str) -> None:
    (tmp_path / "grip.py").write_text(SKILL.format(top=top, body=body))
    done = run(tmp_path, "Grip", "grip.py")
    assert done.returncode == 1
    assert "`execute` raised ModuleNotFoundError: No module named 'no_arm'" in done.stderr


CALLING = """
from ezskiros import SkillDescription
from grip import Grip

class Task(SkillDescription):
    def description(self): pass

class task(Task.SkillBase):
    def expandBT(self, params):
        self.serialstar(Grip())
"""


def test_the_description_of_a_skill_in_another_file_counts(tmp_path: Path) -> None:
    lines = ("def description(self):", "import no_arm", "Grip.SkillBase.close = no_arm.close")
    remembering = SKILL.format(top="", body="self.close()").replace(
        "def description(self): pass", "\n        ".join(lines)
    )
    (tmp_path / "grip.py").write_text(remembering)
    (tmp_path / "task.py").write_text(CALLING)
    assert is_refused(run(tmp_path, "Task", "task.py"))


def test_the_tree_of_a_skill_in_another_file_counts(tmp_path: Path) -> None:
    held = SKILL.format(top="", body="pass").replace("Grip", "Hold").replace("grip", "hold")
    tree = "def expandBT(self, params):\n        import no_arm\n        no_arm.close()\n"
    tree = SKILL.format(top="from hold import Hold", body="").partition("def execute")[0] + tree
    (tmp_path / "hold.py").write_text(held)
    (tmp_path / "grip.py").write_text(f"{tree}        self.serialstar(Hold())\n")
    (tmp_path / "task.py").write_text(CALLING)
    done = run(tmp_path, "Task", "task.py")
    assert done.returncode == 1
    assert "`expandBT` raised ModuleNotFoundError: No module named 'no_arm'" in done.stderr
    assert run(tmp_path, "Task", "task.py", "--simulate").returncode == 0
