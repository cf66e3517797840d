"""Run the tests and proofs that are too slow for each test run, and write the page.

All parts run, also after a failure; the exit code is 1 if a part failed. The page has the durations
and a digest of the sources whose changes require a deep run. A part that has passed for these
sources according to the page does not run again: remove the page to run all parts. With `--remind`,
nothing runs, and the program prints if a run is due.
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
"""The folders of `src/rossmarie` with the generator, the semantics and the nodes."""

KEPT = 24
"""The number of last lines of a test run on the page: the slowest tests, and the counts."""

_DIGEST = re.compile(r"Digest of the sources:\s`(\w+)`")
_ROW = re.compile(
    r"^\| (?P<about>.+) \| passed \| (?P<day>\S+) \| (?P<minutes>[\d.]+) \|$", re.MULTILINE
)
_COMMAND = "    $ "
_OMITTED = re.compile(r"[.sxXFE]* *\[ *\d+%\]|make\[\d+\]: .*")
"""Lines that are not kept: the progress of tests, and the folders of make."""


@dataclass(frozen=True)
class Part:
    """A program, and the number of its last lines that go on the page."""

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
    """The parts. `soak` and `fuzz` are in seconds."""
    deep = f"--deep --soak={soak} --durations=10"
    folders = ("tests/rossmarie", "tests/property")
    proved = "tests/rossmarie/verification"
    rest = " ".join(f"--ignore={folder}" for folder in (*folders, "tests/live"))
    proofs = ("benchmarks/proofs.py", "--out", "docs/reference/performance-proofs.md")
    examples = runpy.run_path(str(PROVED))["EXAMPLES"]
    return (
        Part(
            "Tests of proofs, including deep tests: each mutant is refuted",
            ("make", "test", f"OPTIONS={deep} {proved}"),
            KEPT,
        ),
        Part(
            "All other tests of ROSSMarie, including deep tests, many examples of each property",
            ("make", "test", f"OPTIONS={deep} --ignore={proved} tests/rossmarie"),
            KEPT,
        ),
        Part(
            "Random machines, messages and policies, with many examples of each property",
            ("make", "test", f"OPTIONS={deep} tests/property"),
            KEPT,
        ),
        Part(
            f"Live tests, including deep tests; one node runs for {soak} s",
            ("make", "test", f"OPTIONS={deep} tests/live"),
            KEPT,
        ),
        Part(
            "All other tests, including deep tests",
            ("make", "test", f"OPTIONS={deep} {rest}"),
            KEPT,
        ),
        Part(
            "Live tests with nodes built with AddressSanitizer and UndefinedBehaviorSanitizer",
            ("make", "test", "OPTIONS=--sanitize tests/live"),
            1,
        ),
        # One part for each example, so that an interruption costs less.
        *(
            Part(
                f"[Proofs](performance-proofs.md) of {Path(example).name}",
                (sys.executable, *proofs, example),
                0,
            )
            for example in examples
        ),
        Part(
            f"Damaged files, {fuzz} s for each kind of file", ("make", "fuzz", f"SECONDS={fuzz}"), 1
        ),
    )


def ran(part: Part) -> Result:
    """Run a part and show its output immediately."""
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
            if not _OMITTED.fullmatch(line.strip()):
                lines.append(line.rstrip())
    minutes = (time.monotonic() - begin) / 60
    kept = lines[-part.kept :] if part.kept else ()
    return Result(part, running.returncode, date.today().isoformat(), minutes, kept)


def shown(command: Sequence[str]) -> str:
    """A command as text for a shell."""
    return shlex.join([Path(command[0]).name, *command[1:]])


def outcome(result: Result) -> str:
    """The result of a part in a few words."""
    return "passed" if result.code == 0 else f"failed, exit code {result.code}"


def digest() -> str:
    """The digest of the sources whose changes require a deep run."""
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
    yield "Written by `make deep`; do not edit. These parts are too slow for `make test`. They ran"
    yield f"on {os.cpu_count()} processors. Digest of the sources:"
    yield f"`{digest()}`."
    yield ""
    yield "| Part | Outcome | Day | Minutes |"
    yield "|---|---|---|---|"
    for result in results:
        text = f"{outcome(result)} | {result.day} | {result.minutes:.1f}"
        yield f"| {result.part.about} | {text} |"
    yield f"| All | | | {sum(result.minutes for result in results):.1f} |"
    for result in results:
        if result.lines:
            yield ""
            yield f"{_COMMAND}{shown(result.part.command)}"
            yield from (f"    {line}".rstrip() for line in result.lines)


def passed(wanted: Sequence[Part]) -> dict[Part, Result]:
    """The parts that have passed for these sources, according to the page."""
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
    """A line that reports if a deep run is due."""
    if len(passed(wanted)) == len(wanted):
        return "make deep has passed for the current generator and nodes"
    return "make deep is due: it has not passed for the current generator and nodes"


def main() -> int:
    """Run the parts and write the page, or print the reminder."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--remind", action="store_true", help="only print if a run is due")
    parser.add_argument(
        "--soak",
        type=int,
        default=600,
        metavar="SECONDS",
        help="time of the node in the live tests",
    )
    parser.add_argument(
        "--fuzz", type=int, default=60, metavar="SECONDS", help="time for each kind of damaged file"
    )
    arguments = parser.parse_args()
    wanted = parts(arguments.soak, arguments.fuzz)
    if arguments.remind:
        sys.stdout.write(f"{reminder(wanted)}\n")
        return 0
    results = passed(wanted)
    for part in wanted:
        if part not in results:
            results[part] = ran(part)
            # Write after each part, so that an interrupted run can continue.
            ended = [results[each] for each in wanted if each in results]
            PAGE.write_text("\n".join(page(ended)) + "\n", encoding="utf-8")
    sys.stdout.write("\n")
    for result in results.values():
        text = f"{result.minutes:6.1f} min  {outcome(result):<24}  {shown(result.part.command)}"
        sys.stdout.write(f"{text}\n")
    return int(any(result.code for result in results.values()))


if __name__ == "__main__":
    sys.exit(main())
