"""CBMC in a Debian of its own: made once and whole, or not at all."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from rossmarie.verification.prover import Prover
from rossmarie.verification.setup import NoProverError, provide_prover
from support.parts import MOUNTS, ROOT, needs
from support.provers import QuickDebian, is_running, quick_debian, wait_for

MAIN = [sys.executable, "-c", "from rossmarie.cli.main import main; main()"]

needs_root = needs(ROOT)


@pytest.fixture
def debian(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> QuickDebian:
    return quick_debian(tmp_path, monkeypatch)


def refusal() -> NoProverError:
    with pytest.raises(NoProverError) as caught:
        provide_prover(lambda _: None)
    return caught.value


def left(debian: QuickDebian) -> list[str]:
    return sorted(path.name for path in debian.cache.iterdir())


# --- what keeps it from being made -----------------------------------------------------------


def test_who_is_not_root_is_told(debian: QuickDebian, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "geteuid", lambda: 65534)
    found = refusal()
    assert str(found) == "only root may run another Debian by chroot"
    assert "install the packages cbmc, cadical and z3 of Debian 13" in found.advice
    assert "as root" in found.advice
    assert debian.count() == 0


@needs_root
def test_without_debootstrap_it_says_what_to_install(
    debian: QuickDebian, monkeypatch: pytest.MonkeyPatch
) -> None:
    (debian.programs / "debootstrap").unlink()
    monkeypatch.setenv("PATH", str(debian.programs))
    assert "`apt-get install debootstrap`" in refusal().advice


@needs_root
def test_without_a_network_it_says_what_debootstrap_says(debian: QuickDebian) -> None:
    debian.write(
        "echo I: Retrieving; echo 'E: Failed getting release file' >&2; echo I: Bye; exit 1"
    )
    found = refusal()
    assert str(found) == "debootstrap failed: E: Failed getting release file"
    assert "see that mirrors of Debian can be reached" in found.advice
    assert left(debian) == ["prover.lock"]


@needs_root
def test_what_does_not_run_is_not_taken(debian: QuickDebian) -> None:
    debian.write("exit 0")
    assert str(refusal()) == "what debootstrap made does not run"
    assert left(debian) == ["prover.lock"]


@needs_root
def test_a_cache_that_cannot_be_written_is_told(
    debian: QuickDebian, monkeypatch: pytest.MonkeyPatch
) -> None:
    debian.cache.parent.write_text("a file where a folder should be")
    assert "cache" in str(refusal())


# --- making it -------------------------------------------------------------------------------


@needs_root
def test_it_is_made_once(debian: QuickDebian) -> None:
    told: list[str] = []
    root = debian.cache / "prover"
    assert provide_prover(told.append) == Prover(root)
    assert provide_prover(told.append) == Prover(root)
    assert told == [f"setting up CBMC 6, once: debootstrap makes a Debian 13 in {root}"]
    assert debian.count() == 1
    assert left(debian) == ["prover", "prover.lock"]


@needs_root
def test_what_is_broken_is_replaced_and_leftovers_go(debian: QuickDebian) -> None:
    provide_prover(lambda _: None)
    (debian.cache / "prover/usr/bin/cbmc").unlink()
    (debian.cache / "prover-broken/usr").mkdir(parents=True)
    assert provide_prover(lambda _: None).version() == "6.6.0"
    assert debian.count() == 2
    assert left(debian) == ["prover", "prover.lock"]


@pytest.fixture
def mounted(debian: QuickDebian, tmp_path: Path) -> Iterator[Path]:
    """A folder of the system that a broken run has left mounted."""
    outside, inside = tmp_path / "outside", debian.cache / "prover-broken" / "a place"
    outside.mkdir()
    inside.mkdir(parents=True)
    command = ["mount", "--bind", str(outside), str(inside)]
    subprocess.run(command, check=True)
    (outside / "precious").touch()
    yield outside
    if inside.exists():
        subprocess.run(["umount", str(inside)], check=False, capture_output=True)


@needs(MOUNTS)
def test_what_is_mounted_in_leftovers_is_not_removed(debian: QuickDebian, mounted: Path) -> None:
    provide_prover(lambda _: None)
    assert (mounted / "precious").exists()
    assert left(debian) == ["prover", "prover.lock"]


@needs_root
def test_two_at_once_make_one(debian: QuickDebian) -> None:
    debian.write("sleep 2")
    command = [*MAIN, "verify", "--set-up"]
    runs = [subprocess.Popen(command, stderr=subprocess.PIPE, text=True) for _ in range(2)]
    said = "".join(run.communicate(timeout=60)[1] for run in runs)
    assert [run.returncode for run in runs] == [0, 0]
    assert "another run sets CBMC up; waiting for it" in said
    assert debian.count() == 1


@needs_root
def test_an_interrupted_run_leaves_nothing(debian: QuickDebian) -> None:
    number = debian.cache / "number"
    debian.write(f'touch "$folder/half"; sleep 120 & echo $! > {number}; wait')
    command = [*MAIN, "verify", "--set-up"]
    with subprocess.Popen(command, stderr=subprocess.DEVNULL) as running:
        wait_for(lambda: number.exists() and number.read_text().strip() != "")
        assert [name for name in left(debian) if name.startswith("prover-")]
        running.send_signal(signal.SIGINT)
        assert running.wait(30) == 130
    wait_for(lambda: not is_running(int(number.read_text())))
    assert left(debian) == ["number", "prover.lock"]
