"""`ezskiros owl`: what it writes, and what it leaves as it is."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from support import command_line
from support.ontologies import HALL
from support.parts import PERMISSIONS, require

COMMAND = (sys.executable, "-m", "ezskiros", "owl")
NAMES = ["cora", "rparts", "scalable", "skiros", "sumo"]


def owl(folder: Path, *words: str, ontology: str | Path = HALL) -> subprocess.CompletedProcess[str]:
    words = ("--ontology", str(ontology), *words)
    return command_line.run("ezskiros", "owl", *words, folder=folder)


def content(folder: Path) -> dict[str, str]:
    return {each.name: each.read_text(encoding="utf-8") for each in folder.iterdir()}


def test_each_file_of_the_ontology_becomes_one(tmp_path: Path) -> None:
    done = owl(tmp_path, "--out", "new/folder")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == "".join(f"wrote new/folder/ezskiros-{name}.owl\n" for name in NAMES)
    before = content(tmp_path / "new" / "folder")
    assert owl(tmp_path, "--out", "new/folder").returncode == 0
    assert content(tmp_path / "new" / "folder") == before


def test_what_others_have_written_is_not_overwritten(tmp_path: Path) -> None:
    (tmp_path / "ezskiros-sumo.owl").write_text("mine")
    done = owl(tmp_path, "--out", ".")
    assert done.returncode == 2
    assert "ezskiros-sumo.owl is there, and ezskiros did not write it" in done.stderr
    assert content(tmp_path) == {"ezskiros-sumo.owl": "mine"}


def test_a_folder_in_the_way_is_reported(tmp_path: Path) -> None:
    (tmp_path / "ezskiros-sumo.owl").mkdir()
    done = owl(tmp_path, "--out", ".")
    assert (done.returncode, done.stdout) == (2, "")
    assert "cannot write ezskiros-sumo.owl: is a directory" in done.stderr
    assert [each.name for each in tmp_path.iterdir()] == ["ezskiros-sumo.owl"]


def test_a_file_in_place_of_the_folder_is_reported(tmp_path: Path) -> None:
    (tmp_path / "out").write_text("mine")
    (tmp_path / "hall.ttl").write_text("no Turtle")  # reported later: outputs are tried first
    done = owl(tmp_path, "--out", "out", ontology="hall.ttl")
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 1)
    assert done.stderr.startswith("ezskiros: cannot write to out: ")
    assert (tmp_path / "out").read_text() == "mine"


def test_files_of_an_earlier_ontology_are_reported(tmp_path: Path) -> None:
    assert owl(tmp_path, "--out", ".").returncode == 0
    (tmp_path / "ezskiros-mine.owl").write_text("of somebody else")
    done = owl(tmp_path, "--out", ".", ontology=HALL / "sumo.ttl")
    left = [f"ezskiros: ezskiros-{name}.owl is left from an earlier ontology" for name in NAMES[:4]]
    assert done.returncode == 0
    assert done.stderr.splitlines() == [f"{each}: delete it" for each in left]


def test_errors_are_shown_and_nothing_is_written(tmp_path: Path) -> None:
    (tmp_path / "hall.ttl").write_text("<a> <b> .")
    done = owl(tmp_path, "--out", "out", ontology="hall.ttl")
    assert done.returncode == 1
    assert "error[EZS102]" in done.stdout
    assert not (tmp_path / "out").exists()


def test_without_an_ontology_it_says_so(tmp_path: Path) -> None:
    done = command_line.run("ezskiros", "owl", "--out", "out", folder=tmp_path)
    assert done.returncode == 2
    assert "error[EZS106]: no ontology is loaded: no path is given" in done.stdout


def test_a_file_that_may_not_be_written_is_reported_before_any_is_written(tmp_path: Path) -> None:
    assert owl(tmp_path, "--out", ".").returncode == 0
    cora, sumo = tmp_path / "ezskiros-cora.owl", tmp_path / "ezskiros-sumo.owl"
    cora.write_text(cora.read_text() + "<!-- older -->")
    sumo.chmod(0o444)
    before = content(tmp_path)
    words = [*_as_user(), *COMMAND, "--ontology", str(HALL), "--out", "."]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=False)
    reported = "ezskiros: cannot write ezskiros-sumo.owl: permission denied\n"
    assert (done.returncode, done.stderr) == (2, reported)
    assert content(tmp_path) == before


def _as_user() -> list[str]:
    """The start of a command with which permissions hold for the superuser as well."""
    if os.geteuid() != 0:
        return []
    require(PERMISSIONS)
    powers = "-dac_override,-dac_read_search"
    return ["setpriv", f"--bounding-set={powers}", f"--inh-caps={powers}"]


@pytest.mark.parametrize("words", [("owl", "--out", "new"), ("stubs", "--out", "world.pyi")])
def test_without_an_ontology_no_code_is_blamed(tmp_path: Path, words: tuple[str, ...]) -> None:
    done = command_line.run("ezskiros", *words, folder=tmp_path)
    assert done.returncode == 2
    assert "error[EZS106]: no ontology is loaded: no path is given\n --> <command line>\n" in (
        done.stdout + done.stderr
    )
    assert [*tmp_path.iterdir()] == []
