"""Looks for files that crash `rossmarie check`, or that it takes too long for: `make fuzz`.

Led by coverage where atheris is installed; elsewhere by chance. A file that is found is kept in
build/fuzz; once the defect is mended it belongs into tests/fuzz/found, where the tests check it.
"""

from __future__ import annotations

import argparse
import hashlib
import importlib.util
import random
import sys
import tempfile
import time
from pathlib import Path

from fuzz.mutation import ROOT, mutate, seeds

FOUND = ROOT / "build" / "fuzz"


def main() -> int:
    """Fuzz for a while; the exit code is 1 if something was found."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=int, default=60)
    seconds = parser.parse_args().seconds
    FOUND.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        if importlib.util.find_spec("atheris") is not None:
            fuzz_by_coverage(Path(folder), seconds)
        return fuzz_by_chance(Path(folder), seconds)


def fuzz_by_coverage(folder: Path, seconds: int) -> None:
    """Does not return: libFuzzer ends the process, with a file in build/fuzz if it found one."""
    import atheris

    with atheris.instrument_imports(include=["dslkit", "rossmarie"]):
        from fuzz.target import check_bytes

    corpus = folder / "corpus"
    corpus.mkdir()
    for number, content in enumerate(seeds()):
        (corpus / str(number)).write_bytes(content)
    options = [f"-max_total_time={seconds}", f"-artifact_prefix={FOUND}/", "-timeout=30"]
    atheris.Setup([sys.argv[0], *options, str(corpus)], lambda data: check_bytes(data, folder))
    atheris.Fuzz()


def fuzz_by_chance(folder: Path, seconds: int) -> int:
    """Check damaged examples until the time is up or something is found."""
    from fuzz.target import check_bytes

    chance = random.Random()
    known = seeds()
    end = time.monotonic() + seconds
    tried = 0
    while time.monotonic() < end:
        content = mutate(chance.choice(known), known, chance)
        tried += 1
        try:
            check_bytes(content, folder)
        except Exception:
            path = FOUND / f"crash-{hashlib.sha256(content).hexdigest()[:12]}"
            path.write_bytes(content)
            sys.stdout.write(f"found after {tried} files, kept in {path}\n")
            raise
    sys.stdout.write(f"nothing found in {tried} files\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
