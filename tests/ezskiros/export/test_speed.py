"""An export costs little beside the check that comes before it."""

from __future__ import annotations

import runpy
import time
from pathlib import Path
from typing import Any

import pytest

from dslkit.diagnostics import Collector
from ezskiros import driver
from ezskiros.ontology.load import VARIABLE
from support.depth import deep

BENCHMARKS = Path(__file__).parents[3] / "benchmarks"
WORKLOAD = runpy.run_path(str(BENCHMARKS / "ontology_workload.py"))


def share(folder: Path, files: int, monkeypatch: pytest.MonkeyPatch) -> float:
    """The processor time of an export without its check, by that of the check."""
    WORKLOAD["write_ontology"](folder / "bench.owl", 1_000)
    skills = folder / f"skills_{files}_{time.monotonic_ns()}"
    WORKLOAD["write_skills"](skills, files, 10)
    monkeypatch.setenv(VARIABLE, str(folder / "bench.owl"))
    checks = list[float]()

    def checked(*arguments: Any, **options: Any) -> driver.Checked:
        begin = time.process_time()
        found = check_paths(*arguments, **options)
        checks.append(time.process_time() - begin)
        return found

    check_paths = driver.check_paths
    monkeypatch.setattr(driver, "check_paths", checked)
    collector, begin = Collector(), time.process_time()
    text = driver.export_paths([skills], folder / "skills.json", collector)
    took = time.process_time() - begin - checks[0]
    monkeypatch.setattr(driver, "check_paths", check_paths)
    assert text is not None, collector.sorted()
    return took / checks[0]


@pytest.mark.parametrize(("files", "most"), [(10, 0.5), *deep([(100, 0.1)])])
def test_an_export_takes_a_small_part_of_its_check(
    files: int, most: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shares = [share(tmp_path, files, monkeypatch) for _ in range(3)]
    assert min(shares) <= most
