"""The CPU time of a check of one small file with all imports, compared with an empty program.

The time includes child processes, because `ezskiros` checks in a child process. The contenders run
in turn. Absolute figures differ from machine to machine, ratios much less. To run only this part:
`python benchmarks/start_up.py`.
"""

from __future__ import annotations

import os
import resource
import statistics
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

EXAMPLES = Path(__file__).parents[1] / "examples"
ROUNDS = 11
FLOOR = "empty Python program"
COMMANDS = {
    FLOOR: ("-c", "pass"),
    "`import typer, rich`": ("-c", "import typer, rich"),
    "`rossmarie check` of 8 rules": ("-m", "rossmarie", "check", EXAMPLES / "demo" / "demo.ross"),
    "`ezskiros check` of one file": (
        *("-m", "ezskiros", "check"),
        EXAMPLES / "pick_place" / "skills" / "motions.py",
    ),
}
TARGET = "under 0.4"


def lines() -> Iterator[str]:
    """The table of start-up times."""
    seconds: dict[str, list[float]] = {name: [] for name in COMMANDS}
    for words in COMMANDS.values():
        _cpu_seconds(*words)  # fills the caches of Python and of `rossmarie`
    for _ in range(ROUNDS):
        for name, words in COMMANDS.items():
            seconds[name].append(_cpu_seconds(*words))
    medians = {name: statistics.median(each) for name, each in seconds.items()}
    yield "## Start-up"
    yield ""
    yield "| | CPU seconds | target | ratio to an empty program |"
    yield "|---|---|---|---|"
    for name, took in medians.items():
        wanted = TARGET if "check" in name else ""
        yield f"| {name} | {took:.3f} | {wanted} | {took / medians[FLOOR]:.1f} |"


def _cpu_seconds(*words: str | Path) -> float:
    """The CPU time of a run of Python and of its children."""
    environment = {**os.environ}
    environment.pop("PYTHONDONTWRITEBYTECODE", None)  # otherwise each run compiles all modules
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, *words], env=environment, stdout=subprocess.DEVNULL, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


if __name__ == "__main__":
    print("\n".join(lines()))
