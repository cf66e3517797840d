"""A check that is repeated when a file changes."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

from support.command_line import TIME_LIMIT_S
from support.ontologies import HALL
from support.skill_files import HEADER

SKILL = """
class Skill(SkillDescription):
    def description(self, P: skiros.Product):
        self.pre_conditions += P.{relation}(P)
"""


def test_it_is_checked_again_when_it_has_changed(tmp_path: Path) -> None:
    skills, out = tmp_path / "skills.py", tmp_path / "out"
    skills.write_text(HEADER + SKILL.format(relation="hasAA"))
    command = [sys.executable, "-m", "ezskiros", "check", "--watch", str(skills)]
    with out.open("w") as written:
        running = subprocess.Popen([*command, "--ontology", str(HALL)], stdout=written)
    try:
        until_said(out, "1 error in 1 file")
        skills.write_text(HEADER + SKILL.format(relation="at"))
        until_said(out, "no errors in 1 file")
    finally:
        running.send_signal(signal.SIGINT)
    assert running.wait(TIME_LIMIT_S) == 130


def until_said(out: Path, text: str) -> None:
    end = time.monotonic() + TIME_LIMIT_S
    while text not in out.read_text():
        assert time.monotonic() < end, out.read_text()
        time.sleep(0.1)
