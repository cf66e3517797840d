"""Runs what is too slow for each run of the tests, says how long it took, and writes the page.

All parts run, also after one that failed; the exit code is 1 if one did. Beside the figures the
page has a digest of the sources whose changes ask for a deep run. A part that the page says has
passed on these sources is not run again: remove the page to run all. With `--remind` nothing runs,
and a line says whether a run is due.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import re
import runpy
import shlex
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from datetime import date
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "reference" / "deep-tests.md"
PROVED = ROOT / "benchmarks" / "proved_examples.py"
SOURCES = ("interpreter", "ir", "lowering", "native", "runtime", "targets", "verification")
"""The generator, the semantics and the nodes, in `src/rossmarie`."""

KEPT = 24
"""Lines at the end of a run of tests: the slowest, and how many there were."""

_DIGEST = re.compile(r"Digest of the sources:\s`(\w+)`")
_ROW = re.compile(
    r"^\| (?P<about>.+) \| passed \| (?P<day>\S+) \| (?P<minutes>[\d.]+) \|$", re.MULTILINE
)
_COMMAND = "    $ "
_UNSAID = re.compile(r"[.sxXFE]* *\[ *\d+%\]|make\[\d+\]: .*")
"""Lines that are not kept: the progress of tests, and the folder that make is in."""


@dataclass(frozen=True)
class Part:
    """A program, and how many of its last lines go on the page."""

    about: str
    command: tuple[str, ...]
    kept: int


@dataclass(frozen=True)
class Result:
    """The result of a part. `day` has the form 2026-01-31."""

    part: Part
    code: int
    day: str
    minutes: float
    lines: Sequence[str]


def parts(soak: int, fuzz: int) -> tuple[Part, ...]:
    """All parts; `soak` and `fuzz` are seconds."""
    deep = f"--deep --soak={soak} --durations=10"
    folders = ("tests/rossmarie", "tests/property")
    proved = "tests/rossmarie/verification"
    rest = " ".join(f"--ignore={folder}" for folder in (*folders, "tests/live"))
    proofs = ("benchmarks/proofs.py", "--out", "docs/reference/performance-proofs.md")
    examples = runpy.run_path(str(PROVED))["EXAMPLES"]
    return (
        Part(
            "Tests of proofs, deep ones among them: each fault is refuted",
            ("make", "test", f"OPTIONS={deep} {proved}"),
            KEPT,
        ),
        Part(
            "All other tests of ROSSMarie, deep ones among them, each property with many examples",
            ("make", "test", f"OPTIONS={deep} --ignore={proved} tests/rossmarie"),
            KEPT,
        ),
        Part(
            "Random machines, messages and policies, with many examples of each property",
            ("make", "test", f"OPTIONS={deep} tests/property"),
            KEPT,
        ),
        Part(
            f"Live tests, deep ones among them; a node runs for {soak} s",
            ("make", "test", f"OPTIONS={deep} tests/live"),
            KEPT,
        ),
        Part(
            "All other tests, deep ones among them",
            ("make", "test", f"OPTIONS={deep} {rest}"),
            KEPT,
        ),
        Part(
            "Live tests, with nodes built by AddressSanitizer and UndefinedBehaviorSanitizer",
            ("make", "test", "OPTIONS=--sanitize tests/live"),
            1,
        ),
        # One by one: an interruption costs less.
        *(
            Part(
                f"[Proofs](performance-proofs.md) of {Path(example).name}",
                (sys.executable, *proofs, example),
                0,
            )
            for example in examples
        ),
        Part(f"Damaged files, for {fuzz} s of each kind", ("make", "fuzz", f"SECONDS={fuzz}"), 1),
    )


def ran(part: Part) -> Result:
    """Run a part; its output is shown as it comes."""
    sys.stdout.write(f"\n$ {shown(part.command)}\n")
    sys.stdout.flush()
    begin = time.monotonic()
    with subprocess.Popen(
        part.command,
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        errors="replace",
    ) as running:
        assert running.stdout is not None
        lines = []
        for line in running.stdout:
            sys.stdout.write(line)
            sys.stdout.flush()
            if not _UNSAID.fullmatch(line.strip()):
                lines.append(line.rstrip())
    minutes = (time.monotonic() - begin) / 60
    kept = lines[-part.kept :] if part.kept else ()
    return Result(part, running.returncode, date.today().isoformat(), minutes, kept)


def shown(command: Sequence[str]) -> str:
    """A command as one types it."""
    return shlex.join([Path(command[0]).name, *command[1:]])


def outcome(result: Result) -> str:
    """The result of a part, in a word or two."""
    return "passed" if result.code == 0 else f"failed, exit code {result.code}"


def digest() -> str:
    """A digest of the sources that ask for a deep run when they change."""
    found = hashlib.sha256()
    for folder in SOURCES:
        for path in sorted((ROOT / "src" / "rossmarie" / folder).rglob("*")):
            if path.is_file() and "__pycache__" not in path.parts:
                found.update(path.relative_to(ROOT).as_posix().encode() + b"\0")
                found.update(path.read_bytes() + b"\0")
    return found.hexdigest()[:16]


def page(results: Sequence[Result]) -> Iterator[str]:
    """The lines of the page."""
    yield "# Deep tests"
    yield ""
    yield "Written by `make deep`; do not edit. Parts that are too slow for `make test`, run with"
    yield f"{os.cpu_count()} processors. Digest of the sources:"
    yield f"`{digest()}`."
    yield ""
    yield "| Part | Outcome | Day | Minutes |"
    yield "|---|---|---|---|"
    for result in results:
        told = f"{outcome(result)} | {result.day} | {result.minutes:.1f}"
        yield f"| {result.part.about} | {told} |"
    yield f"| All | | | {sum(result.minutes for result in results):.1f} |"
    for result in results:
        if result.lines:
            yield ""
            yield f"{_COMMAND}{shown(result.part.command)}"
            yield from (f"    {line}".rstrip() for line in result.lines)


def passed(wanted: Sequence[Part]) -> dict[Part, Result]:
    """The parts that the page says have passed on these sources."""
    text = PAGE.read_text(encoding="utf-8") if PAGE.is_file() else ""
    written = _DIGEST.search(text)
    if not written or written.group(1) != digest():
        return {}
    rows = {row["about"]: row for row in _ROW.finditer(text)}
    blocks = dict(block.split("\n", 1) for block in text.split(_COMMAND)[1:])
    found = {}
    for part in wanted:
        if row := rows.get(part.about):
            block = blocks.get(shown(part.command), "").rstrip().split("\n")
            lines = tuple(line.removeprefix("    ") for line in block if block != [""])
            found[part] = Result(part, 0, row["day"], float(row["minutes"]), lines)
    return found


def reminder(wanted: Sequence[Part]) -> str:
    """A reminder whether all parts have passed on these sources."""
    if len(passed(wanted)) == len(wanted):
        return "make deep: has passed on this generator and these nodes"
    return "make deep: is due, it has not passed on this generator and these nodes"


def main() -> int:
    """Run all parts and write the page, or remind."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--remind", action="store_true", help="only say whether a run is due")
    parser.add_argument("--soak", type=int, default=600, metavar="SECONDS")
    parser.add_argument("--fuzz", type=int, default=60, metavar="SECONDS")
    arguments = parser.parse_args()
    wanted = parts(arguments.soak, arguments.fuzz)
    if arguments.remind:
        sys.stdout.write(f"{reminder(wanted)}\n")
        return 0
    results = passed(wanted)
    for part in wanted:
        if part not in results:
            results[part] = ran(part)
            # After each part: a run that is interrupted goes on where it was.
            ended = [results[each] for each in wanted if each in results]
            PAGE.write_text("\n".join(page(ended)) + "\n", encoding="utf-8")
    sys.stdout.write("\n")
    for result in results.values():
        told = f"{result.minutes:6.1f} min  {outcome(result):<24}  {shown(result.part.command)}"
        sys.stdout.write(f"{told}\n")
    return int(any(result.code for result in results.values()))


if __name__ == "__main__":
    sys.exit(main())
