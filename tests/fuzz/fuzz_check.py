"""Looks for files that crash what reads them, or that it takes too long for: `make fuzz`.

Led by coverage where atheris is installed; elsewhere by chance. A file that is found is kept in
build/fuzz; once the defect is mended it belongs into the folder of its target in tests/fuzz/found,
where the tests read it.
"""

from __future__ import annotations

import argparse
import hashlib
import importlib.util
import random
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from fuzz.mutation import mutate

ROOT = Path(__file__).parents[2]
FOUND = ROOT / "build" / "fuzz"
MEMORY = 6 << 30
"""Address space of a process; most of it is reserved and not used."""
PACKAGES = ["crosscheck", "dslkit", "ezskiros", "fuzz.engine", "rossmarie"]
ALL = "all"


def main() -> int:
    """Fuzz for a while; the exit code is 1 if something was found."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=int, default=60, help="for each target")
    parser.add_argument("--target", default=ALL)
    arguments = parser.parse_args()
    if arguments.target == ALL:
        return fuzz_all(arguments.seconds)
    FOUND.mkdir(parents=True, exist_ok=True)
    _, most = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, most))
    with tempfile.TemporaryDirectory() as folder:
        if importlib.util.find_spec("atheris") is not None:
            fuzz_by_coverage(arguments.target, Path(folder), arguments.seconds)
        return fuzz_by_chance(arguments.target, Path(folder), arguments.seconds)


def fuzz_all(seconds: int) -> int:
    """Each target in a process of its own."""
    from fuzz.targets import TARGETS

    command = [sys.executable, "-m", "fuzz.fuzz_check", f"--seconds={seconds}"]
    codes = [subprocess.run([*command, f"--target={name}"]).returncode for name in TARGETS]
    return int(any(codes))


def fuzz_by_coverage(target: str, folder: Path, seconds: int) -> None:
    """Does not return: libFuzzer ends the process, with a file in build/fuzz if it found one."""
    import atheris

    with atheris.instrument_imports(include=PACKAGES):
        from fuzz.targets import TARGETS

    corpus = folder / "corpus"
    corpus.mkdir()
    for number, content in enumerate(TARGETS[target].seeds()):
        (corpus / str(number)).write_bytes(content)
    options = [f"-max_total_time={seconds}", f"-artifact_prefix={FOUND}/{target}-", "-timeout=30"]
    read = TARGETS[target].try_bytes
    atheris.Setup([sys.argv[0], *options, str(corpus)], lambda data: read(data, folder))
    atheris.Fuzz()


def fuzz_by_chance(target: str, folder: Path, seconds: int) -> int:
    """Read damaged examples until the time is up or something is found."""
    from fuzz.targets import TARGETS

    chance = random.Random()
    known = TARGETS[target].seeds()
    latest = FOUND / f"{target}-latest"  # what is left if the process is killed
    end = time.monotonic() + seconds
    tried = 0
    while time.monotonic() < end:
        content = mutate(chance.choice(known), known, chance)
        latest.write_bytes(content)
        tried += 1
        try:
            TARGETS[target].try_bytes(content, folder)
        except Exception:
            path = FOUND / f"{target}-crash-{hashlib.sha256(content).hexdigest()[:12]}"
            path.write_bytes(content)
            sys.stdout.write(f"{target}: found after {tried} files, kept in {path}\n")
            raise
    latest.unlink(missing_ok=True)
    sys.stdout.write(f"{target}: nothing found in {tried} files\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
