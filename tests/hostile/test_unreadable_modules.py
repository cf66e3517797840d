"""A check passes no module that Python refuses to read, and refuses none that Python reads."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from support import command_line
from support.ontologies import HALL
from support.skill_files import skill

GOOD = skill("self.post_conditions += Place.contain(Object)").encode()
MARK = b"\xef\xbb\xbf"


def place(folder: Path, content: bytes) -> Path:
    path = folder / "skill.py"
    path.write_bytes(content)
    return path


def python_refuses(path: Path) -> bool:
    """Say whether Python refuses to run a file before its first line."""
    done = subprocess.run([sys.executable, path], capture_output=True, text=True, check=False)
    return "SyntaxError" in done.stderr or "TabError" in done.stderr


REFUSED = {
    "a comment in Latin-1": (b"# caf\xe9\n" + GOOD, "1:6", "0xe9 is not valid in utf-8"),
    "a comment in Latin-1 later": (
        GOOD + b"\n# \xc3\xa9 caf\xe9\n",
        "13:8",
        "0xe9 is not valid in utf-8",
    ),
    "a text in Latin-1": (GOOD + b"x = 'caf\xe9'\n", "12:9", "0xe9 is not valid in utf-8"),
    "declared as ASCII": (
        b"# coding: ascii\n# caf\xc3\xa9\n" + GOOD,
        "2:6",
        "is not valid in ascii",
    ),
    "of no encoding": (b"# coding: klingon\n" + GOOD, "1:1", "klingon"),
    "a mark and another encoding": (MARK + b"# coding: latin-1\n" + GOOD, "1:1", "utf-8"),
    "a null byte": (GOOD + b"# \0\n", "12:3", "null byte"),
    "UTF-16": (GOOD.decode().encode("utf-16"), "1:", "null byte"),
    "mixed indentation": (GOOD + b"if x:\n        y\n\tz\n", "14:", "inconsistent"),
    "a late future": (GOOD + b"from __future__ import annotations\n", "12:1", "__future__"),
}


@pytest.mark.parametrize(("content", "where", "said"), REFUSED.values(), ids=REFUSED)
@pytest.mark.parametrize("is_imported", [False, True], ids=["itself", "what it imports"])
def test_what_python_refuses_is_an_error_with_its_place(
    tmp_path: Path, content: bytes, where: str, said: str, is_imported: bool
) -> None:
    path = place(tmp_path, content)
    assert python_refuses(path)
    checked = path
    if is_imported:
        checked = tmp_path / "other.py"
        checked.write_bytes(b"import skill\n" + GOOD)
    done = command_line.run("ezskiros", "check", "--ontology", HALL, checked.name, folder=tmp_path)
    assert done.returncode == 1
    assert "error[EZS002]" in done.stdout
    assert f" skill.py:{where}" in done.stdout
    assert said in done.stdout


@pytest.mark.parametrize("first", [b"# coding: utf-8\n", b"# coding=utf8\n", b"\n"])
def test_what_some_versions_of_python_refuse_is_an_error(tmp_path: Path, first: bytes) -> None:
    place(tmp_path, first + b"# caf\xe9\n" + GOOD)
    for _ in range(2):  # what has been compiled in between changes nothing
        done = command_line.run("ezskiros", "check", "--ontology", HALL, ".", folder=tmp_path)
        assert done.returncode == 1
        assert " skill.py:2:6" in done.stdout
        command = [sys.executable, "-c", "import skill"]
        subprocess.run(command, cwd=tmp_path, capture_output=True, check=False)


READ = {
    "as it is": GOOD,
    "a mark": MARK + GOOD,
    "a mark and UTF-8": MARK + b"# coding: utf-8\n" + GOOD,
    "Latin-1, declared": b"# coding: latin-1\n# caf\xe9\n" + GOOD,
    "declared in the second line": b"#!/usr/bin/python\n# vim: set fileencoding=cp1252 :\n# \x80\n"
    + GOOD,
    "form feeds": GOOD.replace(b"\nclass", b"\n\x0cclass"),
    "line ends of Windows": GOOD.replace(b"\n", b"\r\n"),
    "line ends of old Macs": GOOD.replace(b"\n", b"\r"),
    "no end of the last line": GOOD.rstrip(),
    "separators of lines": "# \u2028 \u0085 \x0b\n".encode() + GOOD,
}


@pytest.mark.parametrize("content", READ.values(), ids=READ)
def test_what_python_reads_is_checked(tmp_path: Path, content: bytes) -> None:
    path = place(tmp_path, content)
    assert not python_refuses(path)
    done = command_line.run("ezskiros", "check", "--ontology", HALL, "skill.py", folder=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    wrong = path.write_bytes(content.replace(b"contain", b"contian"))
    assert wrong
    done = command_line.run("ezskiros", "check", "--ontology", HALL, "skill.py", folder=tmp_path)
    assert done.returncode == 1
    assert "^^^^^^^^^^^^^" in done.stdout
    assert "Place.contian" in done.stdout
