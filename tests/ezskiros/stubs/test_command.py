"""`ezskiros stubs` as a user meets it."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from ezskiros.ontology import load
from ezskiros.stubs import write_stub
from support import command_line

ONTOLOGY = Path(__file__).parents[3] / "examples" / "pick_place" / "ontology"


def stubs(*arguments: str | Path, **variables: str) -> subprocess.CompletedProcess[str]:
    defaults = {"COLUMNS": "100", "EZSKIROS_ONTOLOGY": ""}
    return command_line.run("ezskiros", "stubs", *arguments, variables={**defaults, **variables})


@pytest.fixture
def out(tmp_path: Path) -> Path:
    return tmp_path / "world.pyi"


def test_it_writes_the_stub_and_says_nothing(out: Path) -> None:
    done = stubs("--ontology", ONTOLOGY, "--out", out)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert out.read_text(encoding="utf-8") == write_stub(load(ONTOLOGY))


def test_the_ontology_can_be_named_by_the_variable(out: Path) -> None:
    assert stubs("--out", out, EZSKIROS_ONTOLOGY=str(ONTOLOGY)).returncode == 0
    assert out.read_text(encoding="utf-8") == write_stub(load(ONTOLOGY))


def test_a_stub_that_is_up_to_date_passes_the_check(out: Path) -> None:
    stubs("--ontology", ONTOLOGY, "--out", out)
    done = stubs("--ontology", ONTOLOGY, "--out", out, "--check")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_lines_that_end_as_on_windows_are_up_to_date(out: Path) -> None:
    out.write_text(write_stub(load(ONTOLOGY)), encoding="utf-8", newline="\r\n")
    assert stubs("--ontology", ONTOLOGY, "--out", out, "--check").returncode == 0


@pytest.mark.parametrize("before", [None, b"", b"class skiros: ...\n", b"\xff\x00"])
def test_a_stale_stub_is_reported_of_and_left(out: Path, before: bytes | None) -> None:
    if before is not None:
        out.write_bytes(before)
    done = stubs("--ontology", ONTOLOGY, "--out", out, "--check")
    said = f"ezskiros: {out} is stale: run this command again, without --check\n"
    assert (done.returncode, done.stdout, done.stderr) == (1, "", said)
    assert (out.read_bytes() if out.exists() else None) == before


def test_it_counts_whether_relations_are_known(out: Path) -> None:
    stubs("--ontology", ONTOLOGY, "--out", out, "--no-relations")
    assert out.read_text(encoding="utf-8") == write_stub(load(ONTOLOGY, relations=False))
    assert stubs("--ontology", ONTOLOGY, "--out", out, "--check").returncode == 1
    assert stubs("--ontology", ONTOLOGY, "--out", out, "--check", "--no-relations").returncode == 0


def test_an_empty_folder_gives_no_stub(out: Path, tmp_path: Path) -> None:
    done = stubs("--out", out, "--ontology", tmp_path)
    assert (done.returncode, out.exists()) == (2, False)
    assert "no ontology file in" in done.stdout


def test_without_an_ontology_there_is_no_stub(out: Path) -> None:
    done = stubs("--out", out)
    assert (done.returncode, out.exists()) == (2, False)
    assert "error[EZS106]" in done.stdout


def test_a_broken_ontology_is_reported_of_and_gives_no_stub(out: Path, tmp_path: Path) -> None:
    (tmp_path / "broken.ttl").write_text("@prefix : <a> .\n:A :B\n")
    done = stubs("--ontology", tmp_path, "--out", out)
    assert (done.returncode, out.exists()) == (1, False)
    assert "error[EZS102]" in done.stdout


def test_a_path_that_leads_nowhere_is_a_wrong_call(out: Path) -> None:
    done = stubs("--ontology", "nowhere", "--out", out)
    assert (done.returncode, out.exists()) == (2, False)
    assert "'nowhere' does not exist" in done.stderr


def test_a_warning_is_reported_of_and_the_stub_is_written(out: Path, tmp_path: Path) -> None:
    text = (ONTOLOGY / "cora.ttl").read_text(encoding="utf-8")
    (tmp_path / "cora.ttl").write_text(text, encoding="utf-8")
    done = stubs("--ontology", tmp_path / "cora.ttl", "--out", out)
    assert (done.returncode, out.exists()) == (0, True)
    assert "warning[EZS104]" in done.stdout


@pytest.mark.parametrize("is_check", [True, False])
def test_a_stub_that_cannot_be_written_or_read_is_reported_of(
    tmp_path: Path, is_check: bool
) -> None:
    done = stubs("--ontology", ONTOLOGY, "--out", tmp_path, *(["--check"] if is_check else []))
    assert done.returncode == 2
    deed = "read" if is_check else "write"
    assert done.stderr == f"ezskiros: cannot {deed} {tmp_path}: is a directory\n"
