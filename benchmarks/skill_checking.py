"""Check skills in a separate process: `skill_checking.py FOLDER`, with the ontology of the variable
EZSKIROS_ONTOLOGY.

The program prints a line of JSON: the CPU times of the import, of the loading of the ontology, of
the check, and for comparison of the compilation of the same files by Python (s); and the numbers of
skills and findings.
"""

from __future__ import annotations

import json
import sys
import time
from itertools import pairwise
from pathlib import Path


def main() -> None:
    """Measure and print."""
    instants = [time.process_time()]
    import ezskiros.cli.main  # noqa: F401
    from ezskiros.driver import check_paths
    from ezskiros.ontology import load

    # Each round is a first run, without the bytecode of an earlier run.
    sys.dont_write_bytecode = True
    instants.append(time.process_time())
    load()
    instants.append(time.process_time())
    folder = Path(sys.argv[1])
    checked = check_paths([folder])
    instants.append(time.process_time())
    for file in folder.glob("*.py"):
        compile(file.read_text(encoding="utf-8"), str(file), "exec")
    instants.append(time.process_time())
    imported, loaded, took, compiled = (b - a for a, b in pairwise(instants))
    print(
        json.dumps(
            {
                "import": imported,
                "load": loaded,
                "check": took,
                "compile": compiled,
                "skills": len(checked.skills),
                "findings": len(checked.diagnostics),
            }
        )
    )


if __name__ == "__main__":
    main()
