"""Measure the import of the command line, and the parsing and the check of 100 rules.

`queries.py` measures the queries about rules.
"""

from __future__ import annotations

import statistics
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from workload import rossmarie_rules

IMPORT = """
import time
start = time.process_time()
import rossmarie.cli.main
print(time.process_time() - start)
"""
CHECK = """
import sys
from pathlib import Path
import time
import rossmarie.cli.main
from rossmarie.driver import check_file
start = time.process_time()
result = check_file(Path(sys.argv[1]), message_folders=[Path(sys.argv[2])])
took = time.process_time() - start
assert result.program is not None
print(took)
"""
ROUNDS = 7


def lines(folder: Path) -> Iterator[str]:
    """The table of the compiler."""
    rules = folder / "hundred.ross"
    text = rossmarie_rules(34).splitlines()
    # 34 copies of three rules without the last two rules are one hundred rules.
    rules.write_text("\n".join(text[:-2]) + "\n", encoding="utf-8")
    messages = Path(__file__).parent / "msg"
    yield "## Compiler"
    yield ""
    yield "| | CPU seconds | target |"
    yield "|---|---|---|"
    yield f"| import of the command-line module | {_median(IMPORT):.2f} | under 0.3 |"
    checked = _median(CHECK, str(rules), str(messages))
    about = "check of names, types and units of 100 rules, after the import"
    yield f"| {about} | {checked:.2f} | under 0.5 |"
    yield ""
    queries = "[cost of queries](performance-queries.md)"
    yield f"`rossmarie check` also runs queries; see {queries}."
    yield ""
    operators = "[cost of operators](performance-operators.md)"
    yield f"For rules with a single operator, see {operators}."


def _median(program: str, *arguments: str) -> float:
    """The median of the numbers that a program prints; each round is a new process."""
    seconds = []
    for _ in range(ROUNDS):
        command = [sys.executable, "-c", program, *arguments]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        seconds.append(float(done.stdout))
    return statistics.median(seconds)
