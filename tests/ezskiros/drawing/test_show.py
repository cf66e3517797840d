"""`ezskiros show`, as users call it."""

from __future__ import annotations

import shutil
import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from support import command_line
from support.ontologies import HALL
from support.tree_files import TREES


@pytest.fixture
def lab(tmp_path: Path) -> Path:
    shutil.copy(TREES / "gripping.py", tmp_path)
    return tmp_path


def show(*arguments: str, folder: Path) -> subprocess.CompletedProcess[str]:
    return command_line.run("ezskiros", "show", *arguments, "--ontology", HALL, folder=folder)


def test_the_skills_of_the_folder_are_shown(lab: Path) -> None:
    done = show("Pause", folder=lab)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("if params.Careful\n└── Pause.pause\n")
    assert done.stdout.endswith("        └── Wait\n")


@pytest.mark.parametrize(
    ("form", "root"), [("svg", "{http://www.w3.org/2000/svg}svg"), ("btcpp", "root")]
)
def test_a_picture_and_xml_are_printed_or_written(form: str, root: str, lab: Path) -> None:
    done = show("fetch", "gripping.py", "--format", form, folder=lab)
    assert (done.returncode, done.stderr) == (0, "")
    assert ET.fromstring(done.stdout).tag == root
    done = show("fetch", "gripping.py", "--format", form, "--out", "a.xml", folder=lab)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert ET.parse(lab / "a.xml").getroot().tag == root


def test_nothing_is_exported_that_means_something_else(lab: Path) -> None:
    done = show("pause", "--format", "btcpp", "--out", "a.xml", folder=lab)
    assert done.returncode == 1
    assert "error[EZS830]" in done.stdout
    assert not (lab / "a.xml").exists()


def test_skills_with_errors_are_drawn_and_not_exported(lab: Path) -> None:
    path = lab / "gripping.py"
    path.write_text(path.read_text().replace("Target=params.Place", "Target=params.Plaze"))
    done = show("fetch", folder=lab)
    assert done.returncode == 1
    assert "Approach.go_to_linear  Target = ?" in done.stdout
    assert "these files have errors" in done.stderr
    done = show("fetch", "--format", "btcpp", "--out", "a.xml", folder=lab)
    assert done.returncode == 1
    assert not (lab / "a.xml").exists()


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("wait",), "`wait` is primitive: it has no behavior tree"),
        (("fetsh",), "there is no skill `fetsh` in these files; did you mean `fetch`?"),
        (("fetch", "--format", "svg", "--out", "no/where.svg"), "cannot write no/where.svg"),
        (("fetch", "nowhere"), "there is no file nowhere"),
    ],
)
def test_wrong_calls(lab: Path, arguments: tuple[str, ...], said: str) -> None:
    done = show(*arguments, folder=lab)
    assert done.returncode == 2
    assert said in done.stdout + done.stderr
