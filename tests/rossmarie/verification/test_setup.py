"""CBMC in a Debian of its own, by `tools/setup_prover_debian.sh`: whole, or not at all."""

from __future__ import annotations

import os
import signal
import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest

from rossmarie.verification.prover import PROGRAMS, Prover
from support.provers import is_running, wait_for

SCRIPT = Path(__file__).parents[3] / "tools" / "setup_prover_debian.sh"
NAMES = (*PROGRAMS, "goto-cc", "goto-instrument")

DEBOOTSTRAP = """\
#!/bin/sh
# debootstrap, but quick: its programs are scripts, and so is the loader that starts them.
for folder; do :; done
echo called >> {calls}
{before}
mkdir -p "$folder/usr/bin" "$folder/lib64" "$folder/usr/lib/any-linux-gnu"
printf '#!/bin/sh\\nshift 2\\nexec "$@"\\n' > "$folder/lib64/ld-linux-any.so.2"
for program in {names}; do
    printf '#!/bin/sh\\necho 6.6.0\\n' > "$folder/usr/bin/$program"
done
chmod +x "$folder"/usr/bin/* "$folder"/lib64/*
"""


@dataclass(frozen=True)
class QuickDebian:
    """A debootstrap on the path, and an empty cache."""

    programs: Path
    cache: Path
    calls: Path

    def write(self, before: str = "") -> None:
        """Install it; `before` is what it does at first."""
        script = self.programs / "debootstrap"
        names = " ".join(NAMES)
        script.write_text(DEBOOTSTRAP.format(calls=self.calls, before=before, names=names))
        script.chmod(0o755)

    def count(self) -> int:
        """The number of calls."""
        return self.calls.read_text().count("called") if self.calls.exists() else 0

    def left(self) -> list[str]:
        """The files in the cache."""
        return sorted(path.name for path in self.cache.iterdir())


@pytest.fixture
def debian(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> QuickDebian:
    made = QuickDebian(tmp_path / "bin", tmp_path / "cache" / "rossmarie", tmp_path / "calls")
    made.programs.mkdir()
    made.write()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setenv("PATH", f"{made.programs}:/usr/bin:/bin")
    return made


def run() -> subprocess.CompletedProcess[str]:
    return subprocess.run([SCRIPT], capture_output=True, text=True, check=False)


def test_it_is_made_once_and_runs(debian: QuickDebian, monkeypatch: pytest.MonkeyPatch) -> None:
    first, second = run(), run()
    assert (first.returncode, second.returncode) == (0, 0), first.stderr
    assert "making a Debian 13" in first.stdout
    assert second.stdout == ""
    assert debian.count() == 1
    assert debian.left() == ["prover", "prover.lock"]
    monkeypatch.setenv("PATH", f"{debian.cache}/prover/programs:/usr/bin:/bin")
    assert Prover().lacking() is None
    assert Prover().version() == "6.6.0"


def test_a_debian_that_is_there_gets_its_programs(debian: QuickDebian) -> None:
    run()
    (debian.cache / "prover/programs/z3").unlink()
    assert run().returncode == 0
    assert debian.count() == 1


def test_what_is_broken_is_replaced_and_leftovers_go(debian: QuickDebian) -> None:
    run()
    (debian.cache / "prover/usr/bin/cbmc").unlink()
    (debian.cache / "prover-broken/usr").mkdir(parents=True)
    assert run().returncode == 0
    assert debian.count() == 2
    assert debian.left() == ["prover", "prover.lock"]


def test_without_a_network_it_says_what_debootstrap_says(debian: QuickDebian) -> None:
    debian.write(
        "echo I: Retrieving; echo 'E: Failed getting release file' >&2; echo I: Bye; exit 1"
    )
    done = run()
    assert done.returncode == 1
    assert "E: Failed getting release file\n" in done.stderr
    assert "it needs root and a mirror of Debian" in done.stderr
    assert debian.left() == ["prover.lock"]


def test_what_does_not_run_is_reported(debian: QuickDebian) -> None:
    debian.write("mkdir -p $folder/lib64 $folder/usr/lib/any-linux-gnu; exit 0")
    done = run()
    assert done.returncode == 1
    assert "the programs from debootstrap do not run" in done.stderr


def test_two_at_once_make_one(debian: QuickDebian) -> None:
    debian.write("sleep 1")
    runs = [subprocess.Popen([SCRIPT]) for _ in range(2)]
    assert [each.wait(60) for each in runs] == [0, 0]
    assert debian.count() == 1


def test_an_interrupted_run_leaves_nothing(debian: QuickDebian) -> None:
    number = debian.cache / "number"
    debian.write(f'touch "$folder/half"; sleep 120 & echo $! > {number}; wait')
    with subprocess.Popen([SCRIPT], start_new_session=True) as running:
        wait_for(lambda: number.exists() and number.read_text().strip() != "")
        assert [name for name in debian.left() if name.startswith("prover-")]
        os.killpg(running.pid, signal.SIGTERM)
        assert running.wait(30) == 130
    wait_for(lambda: not is_running(int(number.read_text())))
    assert debian.left() == ["number", "prover.lock"]
