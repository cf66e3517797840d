"""Writes the matrix: which fault each language finds, and when."""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from study_kit import tools
from study_kit.faults import CONDITIONS, KIT, Condition, Fault, plant, read_faults

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

PAGE = KIT / "matrix.md"
BASELINE = KIT.parents[1] / "tests" / "fixtures" / "ezskiros" / "baseline.toml"
_WORDS: Mapping[str, str] = {
    "check": "check (mypy)",
    "build": "build (g++)",
    "run": "run time (the program ends)",
    "never": "not at all",
}
_HEAD = """\
# What goes wrong, and which language finds it when

`python docs/study/study.py matrix` writes this page. The command plants each fault of
[the list](faults.toml) alone into the model solution of each language, runs the tools, and writes
the first stage at which a tool finds the fault:

- **by construction**: the language cannot express the fault.
- **writing**: a type checker in an editor finds the fault (mypy, with the stub that
  `ezskiros stubs` writes).
- **check**: a check finds the fault before anything is built or run. A code names the diagnostic.
- **build**: the compiler of the plain program rejects the fault or warns about it
  (`g++ -Wall -Wextra`).
- **run time**: the program ends with an error on [the trace](tasks/rules/trace.csv), or SkiROS2
  notices the fault.
- **not at all**: no tool of the column finds the fault, and the robot does the wrong thing.

The first matrix contains faults of rules that guard a rover, beside the same rules in plain Python
and plain C++. The plain programs have the structure of the rules, and all their functions have
types, so that a type checker has its best case. "Python alone" is the same program without mypy.
No program has tests: tests of the behavior can find each of these faults in every language.
"""
_SKILLS = """\

The second matrix contains faults of skills and a behavior tree, beside plain SkiROS2. The answers
of SkiROS2 at run time come from
[the comparison with SkiROS2](../reference/compared-with-skiros2.md), which was measured with its
core. The authors of the tools chose the faults, so that the counts say nothing about faults in
the wild.
"""
_UNKNOWN = "not measured"

Answers = Mapping[tuple[str, str], Sequence[str]]
"""The codes of a check of our language, or one stage of plain tools, by condition and fault.

`alone` stands for plain Python without a type checker, and `writing` for EzSkiROS in an editor.
"""


def write_matrix(page: Path = PAGE) -> None:
    """Run all tools over all faults and write the page."""
    page.write_text(matrix_text(answers()), encoding="utf-8")


def answers() -> Answers:
    """Plant each fault alone and run the tools of each condition; this takes minutes."""
    found: dict[tuple[str, str], Sequence[str]] = {}
    for fault in read_faults():
        for name, variant in fault.variants.items():
            if not variant.absent:
                found.update(_answers(fault, CONDITIONS[name]))
    return found


def _answers(fault: Fault, condition: Condition) -> Answers:
    with tempfile.TemporaryDirectory() as folder:
        file = tools.lay_out(condition, plant(condition, [fault]), Path(folder) / "task")
        at = (condition.name, fault.id)
        if not condition.is_ours:
            found: dict[tuple[str, str], Sequence[str]] = {at: [tools.plain_stage(condition, file)]}
        else:
            found = {at: list(dict.fromkeys(tools.codes(condition, file)))}
        if condition.name == "python":
            found["alone", fault.id] = ["never" if tools.python_runs(file.parent) else "run"]
        if condition.name == "ezskiros":
            is_accepted = tools.mypy_accepts(file, is_strict=False)
            found["writing", fault.id] = [] if is_accepted else ["writing"]
    return found


def matrix_text(found: Answers) -> str:
    """The page of some answers."""
    faults = read_faults()
    rules = [each for each in faults if each.task == "rules"]
    skills = [each for each in faults if each.task == "skills"]
    rule_rows = [_rules_row(each, found) for each in rules]
    skill_rows = [_skills_row(each, found) for each in skills]
    rule_columns = ("ROSSMARie", "Python with mypy", "Python alone", "C++")
    skill_columns = (
        *("EzSkiROS in an editor", "EzSkiROS"),
        *("SkiROS2 with mypy", "SkiROS2 at run time"),
    )
    return "".join(
        [
            _HEAD,
            *_table(rule_columns, rules, rule_rows),
            _found(rule_columns, rule_rows),
            _SKILLS,
            *_table(skill_columns, skills, skill_rows),
            _found(skill_columns[:3], skill_rows),
        ]
    )


Row = Sequence[str]


def _table(columns: Sequence[str], faults: Sequence[Fault], rows: Sequence[Row]) -> Iterator[str]:
    yield f"\n| fault | the robot | {' | '.join(columns)} |\n"
    yield f"|---|---|{'---|' * len(columns)}\n"
    for fault, row in zip(faults, rows, strict=True):
        yield f"| {fault.title} | {fault.consequence} | {' | '.join(row)} |\n"


def _found(columns: Sequence[str], rows: Sequence[Row]) -> str:
    """One sentence with the counts of faults that a tool finds before the robot runs."""
    late = ("not at all", "run time")
    told = []
    for at, column in enumerate(columns):
        cells = [row[at] for row in rows if not row[at].startswith("does not apply")]
        told.append(f"{column} {sum(not each.startswith(late) for each in cells)} of {len(cells)}")
    return f"\nFound or excluded before the robot runs: {', '.join(told)}.\n"


def _rules_row(fault: Fault, found: Answers) -> Row:
    python = _plain(fault, "python", found)
    alone = (
        "does not apply" if fault.variants["python"].absent else _WORDS[found["alone", fault.id][0]]
    )
    return _ours(fault, "rossmarie", found), python, alone, _plain(fault, "cpp", found)


def _skills_row(fault: Fault, found: Answers) -> Row:
    return (
        "writing (mypy)" if found["writing", fault.id] else "not at all",
        _ours(fault, "ezskiros", found),
        _plain(fault, "skiros2", found),
        _baseline()[fault.baseline] if fault.baseline else _UNKNOWN,
    )


def _ours(fault: Fault, name: str, found: Answers) -> str:
    absent = fault.variants[name].absent
    if absent:
        return f"by construction: {absent}"
    codes = [_link(CONDITIONS[name], code) for code in found[name, fault.id]]
    return f"check: {', '.join(codes)}" if codes else "not at all"


def _link(condition: Condition, code: str) -> str:
    return f"[{code}](../../src/{condition.name}/catalog/pages/{code}.md)"


def _plain(fault: Fault, name: str, found: Answers) -> str:
    if fault.variants[name].absent:
        return f"does not apply: {fault.variants[name].absent}"
    return _WORDS[found[name, fault.id][0]]


def _baseline() -> Mapping[str, str]:
    """The answers of SkiROS2 by the faults of the comparison."""
    listed: Sequence[Mapping[str, Any]] = tomllib.loads(BASELINE.read_text("utf-8"))["fault"]
    return {
        each["fault"]: "not at all"
        if each["when"] == "never"
        else f"run time: {each['when']}".replace("run time: never;", "not at all;")
        for each in listed
    }
