"""Measure EzSkiROS in one run and write the page (the second half of `make bench`).

The figures are CPU times. Each process measures one thing, the processes run in turn, and each
figure is the median of the rounds. All libraries that load ontologies have to find the same
superclasses; the run compares the results.
"""

from __future__ import annotations

import json
import os
import platform
import statistics
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from machine import processor
from ontology_workload import Size, write_ontology, write_skills
from written_page import written_page

HERE = Path(__file__).parent
BENCH = HERE.parent / "build" / "bench"
FOLDER = BENCH / "ontologies"
SHARED = HERE.parents[1] / "shared" / "ontologies"
PEERS = BENCH / "venv" / "bin" / "python"
LIBRARIES = {
    "**EzSkiROS**": (sys.executable, "ezskiros"),
    "rdflib 7.6.0": (PEERS, "rdflib"),
    "owlready2 0.51": (PEERS, "owlready2"),
}
OURS = next(iter(LIBRARIES))
ROUNDS = 5
SIZES = (1_000, 10_000, 100_000)

Measured = dict[str, float]


def measured(command: Sequence[object], environment: Mapping[str, str]) -> Measured | None:
    """The output of a program; None if the program is missing or failed."""
    done = subprocess.run(
        [str(word) for word in command],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, **environment},
    )
    if done.returncode:
        print(done.stderr.strip().rpartition("\n")[2])
        return None
    found: Measured = json.loads(done.stdout.strip().rpartition("\n")[2])
    return found


def in_turn(
    commands: Mapping[str, Sequence[object]], environment: Mapping[str, str]
) -> dict[str, Measured]:
    """Run each program once per round; the medians of the figures that the programs print."""
    found: dict[str, list[Measured]] = {name: [] for name in commands}
    for _ in range(ROUNDS):
        for name, command in commands.items():
            found[name] += filter(None, [measured(command, environment)])
    for name in [name for name, all_of_it in found.items() if not all_of_it]:
        print(f"bench: {name} is not installed or did not finish")
        del found[name]
    return {
        name: {key: statistics.median(each[key] for each in rounds) for key in rounds[0]}
        for name, rounds in found.items()
    }


def loaded(files: Sequence[Path]) -> dict[str, Measured]:
    """The figures of all installed libraries for the files of an ontology."""
    there = {name: each for name, each in LIBRARIES.items() if Path(each[0]).exists()}
    commands = {
        name: (python, HERE / "ontology_loading.py", library, *files)
        for name, (python, library) in there.items()
    }
    return in_turn(commands, {})


COLUMNS = (
    "| load, ms | ratio | find superclasses, ms | import, ms | memory, MiB "
    "| classes | superclasses |"
)
RULE = "---|---|---|---|---|---|---|---|"


def loading_rows(found: Mapping[str, Measured], first: str = "") -> Iterator[str]:
    """The rows of one ontology; `first` is the first cell of each."""
    ours = found[OURS]
    for name, each in found.items():
        cells = [
            f"{each['load'] * 1000:,.1f}",
            f"{each['load'] / ours['load']:.2f}",
            f"{each['ask'] * 1000:,.1f}",
            f"{each['import'] * 1000:,.0f}",
            f"{each['mebibytes']:,.0f}",
            f"{each['classes']:,.0f}",
            f"{each['above']:,.0f}",
        ]
        yield f"| {first}{name} | {' | '.join(cells)} |"


def own_ontology() -> Iterator[str]:
    """The table of SkiROS2's ontology."""
    yield "## SkiROS2's ontology"
    yield ""
    files = sorted(SHARED.glob("*.owl"))
    if not files:
        print(
            "bench: SkiROS2's ontology is not measured: the folder ../shared/ontologies is missing"
        )
        yield "Not measured: the folder `../shared/ontologies` is missing."
        return
    found = loaded(files)
    yield f"The released ontology has {len(files)} files. The target for EzSkiROS is to load them"
    yield "in less than 100 ms."
    yield ""
    yield f"| {COLUMNS}"
    yield f"|{RULE}"
    yield from loading_rows(found)


def growing(sizes: Mapping[Path, Size]) -> Iterator[str]:
    """The table of generated ontologies."""
    yield "## Larger ontologies"
    yield ""
    yield f"| triples | {COLUMNS}"
    yield f"|---|{RULE}"
    for path, size in sizes.items():
        found = loaded([path])
        answers = {(each["classes"], each["above"]) for each in found.values()}
        assert len(answers) == 1, f"the libraries do not agree about {path}: {answers}"
        yield from loading_rows(found, f"{size.triples:,} | ")


def checked(folder: Path, ontology: Path) -> Measured:
    """The skills of a folder."""
    command = (sys.executable, HERE / "skill_checking.py", folder)
    return in_turn({folder.name: command}, {"EZSKIROS_ONTOLOGY": str(ontology)})[folder.name]


def thousand(ontology: Path) -> Iterator[str]:
    """The table of many skills."""
    folders = {"in 100 files": FOLDER / "right", "in 1,000 files": FOLDER / "single"}
    folders["in 100 files, with a misspelt relation in each description"] = FOLDER / "mistaken"
    write_skills(FOLDER / "right", 100, 10)
    write_skills(FOLDER / "single", 1_000, 1)
    write_skills(FOLDER / "mistaken", 100, 10, with_mistakes=True)
    yield "## Check of 1,000 descriptions"
    yield ""
    yield "Each description has 10 parameters and 10 conditions. The times include the loading of"
    yield "the ontology (1,000 triples), but not the import of EzSkiROS."
    yield ""
    yield "| | CPU seconds | target | ratio to Python's `compile` of the files | findings |"
    yield "|---|---|---|---|---|"
    for name, folder in folders.items():
        found = checked(folder, ontology)
        assert found["skills"] == 1_000, found
        took = found["load"] + found["check"]
        wanted = "under 2" if folder.name == "right" else ""
        ratio, findings = took / found["compile"], found["findings"]
        yield f"| {name} | {took:.2f} | {wanted} | {ratio:.1f} | {findings:,.0f} |"
    yield f"| import of the command-line module | {found['import']:.2f} | | | |"


def checks_of_growing(sizes: Mapping[Path, Size]) -> Iterator[str]:
    """The table of the same skills with larger and larger ontologies."""
    folders = (FOLDER / "hundred", FOLDER / "hundred_mistaken")
    for folder in folders:
        write_skills(folder, 10, 10, with_mistakes=folder.name.endswith("mistaken"))
    yield "The time to check the same 100 skills with each ontology, without the loading:"
    yield ""
    yield "| triples | check, ms | check with a misspelt relation in each skill, ms |"
    yield "|---|---|---|"
    for path, size in sizes.items():
        cells = [f"{checked(folder, path)['check'] * 1000:,.0f}" for folder in folders]
        yield f"| {size.triples:,} | {' | '.join(cells)} |"


TREES = {
    "parallel": "ParallelFf, all children running",
    "serial": "Serial, all children succeed",
    "serialstar": "SerialStar, first child running",
    "nested": "Serial in Serial, one node per level",
}
SKIROS2 = {
    ("parallel", 10): (7, 0.65),
    ("parallel", 100): (51, 7.0),
    ("parallel", 1000): (976, 69.8),
    ("serial", 10): (5.9, None),
    ("serial", 100): (43, None),
    ("serial", 1000): (425, None),
    ("serialstar", 10): (4, 0.09),
    ("serialstar", 100): (17, 0.16),
    ("serialstar", 1000): (148, 0.23),
    ("nested", 10): (4, 0.13),
    ("nested", 100): (21, 1.0),
}
"""The milliseconds of the first tick and of a later tick."""
TARGETS = {("parallel", 1000): (None, 7), ("serial", 1000): (40, None)}
ENGINE = """## Execution of behavior trees

All times are in ms, and the primitives do nothing. The first tick includes the construction of the
tree; *later* is the median of the later ticks. The columns *py_trees* are a reference:
behaviors that do nothing, in composites of py_trees, without skills, parameters and conditions.
The columns *SkiROS2* were measured once, on another machine, with the core of SkiROS2 without ROS
(master, c4438e7, Python 3.11). With 300 levels, SkiROS2 ends with a RecursionError.

| tree | nodes | first tick | target | py_trees | SkiROS2 | later | target | py_trees | SkiROS2 |
|---|---|---|---|---|---|---|---|---|---|"""


def engine() -> Iterator[str]:
    """The table of behavior trees."""
    yield ENGINE
    for tree, called in TREES.items():
        for nodes in (10, 100, 1_000):
            commands = {
                name: (sys.executable, HERE / "ezskiros_engine.py", name, tree, nodes)
                for name in ("ezskiros", "py_trees")
            }
            found = in_turn(commands, {})
            columns = [called, f"{nodes:,}"]
            for index, key in enumerate(("start", "tick")):
                columns += [
                    f"{found['ezskiros'][key] * 1000:.2f}",
                    _number(TARGETS.get((tree, nodes), (None, None))[index], "under "),
                    f"{found['py_trees'][key] * 1000:.2f}",
                    _number(SKIROS2.get((tree, nodes), (None, None))[index]),
                ]
            yield f"| {' | '.join(columns)} |"


def _number(found: float | None, before: str = "") -> str:
    return "" if found is None else f"{before}{found:g}"


PREFACE = """# Performance of EzSkiROS

Written by `make bench`; do not edit. All figures are from one run on one machine
({machine}).
Each process measures one thing. The contenders run in turn; each figure is the median of {rounds}
rounds. All times are CPU times. Absolute figures hold for this machine only; ratios carry over to
other machines.

The tables of ontologies have these columns:

- *load*: the time to read the files. After this time, EzSkiROS has the model that its checks use,
  but rdflib and owlready2 have triples.
- *ratio*: the load time relative to the load time of EzSkiROS.
- *find superclasses*: the time to find all classes and all superclasses of each class. Each library
  follows `rdfs:subClassOf`; some libraries also follow equivalent classes and intersections.
- *import*: the time to import the library.
- *memory*: the peak memory of the process.
- *superclasses*: the number of superclasses of all classes, including each class itself.

The ontologies are generated, except SkiROS2's own ontology.
"""


def main() -> None:
    """Measure, print and write the page."""
    out = written_page("Measure EzSkiROS and its peers.")
    FOLDER.mkdir(parents=True, exist_ok=True)
    sizes = {
        path: write_ontology(path, count)
        for count in SIZES
        for path in [FOLDER / f"bench_{count}.owl"]
    }
    machine = f"{processor()}; Python {platform.python_version()}"
    lines = [
        PREFACE.format(rounds=ROUNDS, machine=machine),
        *thousand(next(iter(sizes))),
        "",
        *own_ontology(),
        "",
        *growing(sizes),
        "",
        *checks_of_growing(sizes),
        "",
        *engine(),
    ]
    text = "\n".join(lines) + "\n"
    out.write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
