"""Tests of the benchmark's subject: the libraries agree on a generated ontology, and generated
skills are correct or have the intended mistake. Nothing is timed here.
"""

from __future__ import annotations

import json
import os
import runpy
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from support.parts import PEERS, needs

ROOT = Path(__file__).parents[2]
BENCHMARKS = ROOT / "benchmarks"
PYTHON_OF_PEERS = ROOT / "build" / "bench" / "venv" / "bin" / "python"
WORKLOAD = runpy.run_path(str(BENCHMARKS / "ontology_workload.py"))


def ran(*command: object, **environment: str) -> dict[str, Any]:
    words = [str(word) for word in command]
    done = subprocess.run(
        words, capture_output=True, text=True, check=False, env={**os.environ, **environment}
    )
    assert done.returncode == 0, done.stderr
    found: dict[str, Any] = json.loads(done.stdout)
    return found


@pytest.fixture(scope="module")
def ontology(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("bench") / "bench.owl"


@pytest.fixture(scope="module")
def size(ontology: Path) -> Any:
    return WORKLOAD["write_ontology"](ontology, 1_000)


@pytest.fixture(scope="module")
def ours(ontology: Path, size: Any) -> dict[str, Any]:
    return ran(sys.executable, BENCHMARKS / "ontology_loading.py", "ezskiros", ontology)


def test_an_ontology_is_as_large_as_it_is_said_to_be(size: Any, ours: dict[str, Any]) -> None:
    assert 1_000 <= size.triples < 1_100
    assert ours["classes"] == size.classes > 100
    assert ours["above"] > 3 * size.classes


def test_a_larger_ontology_begins_with_a_smaller_one(tmp_path: Path) -> None:
    sizes = [WORKLOAD["write_ontology"](tmp_path / f"{n}.owl", n) for n in (500, 1_000)]
    first, second = (set((tmp_path / f"{n}.owl").read_text("utf-8").split()) for n in (500, 1_000))
    assert sizes[0].classes < sizes[1].classes
    assert first < second


@needs(PEERS)
@pytest.mark.parametrize("library", ["rdflib", "owlready2"])
def test_libraries_find_the_same(
    library: str, ontology: Path, size: Any, ours: dict[str, Any]
) -> None:
    found = ran(PYTHON_OF_PEERS, BENCHMARKS / "ontology_loading.py", library, ontology)
    assert (found["classes"], found["above"]) == (ours["classes"], ours["above"])


@pytest.mark.parametrize("is_mistaken", [False, True])
def test_generated_skills_are_right_or_have_one_mistake(
    is_mistaken: bool, ontology: Path, size: Any, tmp_path: Path
) -> None:
    WORKLOAD["write_skills"](tmp_path / "skills", 2, 5, with_mistakes=is_mistaken)
    text = (tmp_path / "skills" / "skills_0.py").read_text("utf-8")
    assert text.count("_conditions += ") == 5 * 10
    assert text.partition("self,")[2].partition("):")[0].count(": ") == 10
    found = ran(
        sys.executable,
        BENCHMARKS / "skill_checking.py",
        tmp_path / "skills",
        EZSKIROS_ONTOLOGY=str(ontology),
    )
    assert (found["skills"], found["findings"]) == (10, 10 if is_mistaken else 0)


@pytest.mark.parametrize("tree", ["parallel", "serial", "serialstar", "nested"])
@pytest.mark.parametrize("engine", ["ezskiros", "py_trees"])
def test_trees_are_ticked(engine: str, tree: str) -> None:
    found = ran(sys.executable, BENCHMARKS / "ezskiros_engine.py", engine, tree, 20)
    assert found["start"] > 0
    assert found["tick"] > 0
