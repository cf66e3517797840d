"""The planted faults and the model solutions: reads them, plants them, and finds them in files."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Any

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

KIT = Path(__file__).resolve().parents[1]
TASKS = KIT / "tasks"


@dataclass(frozen=True)
class Condition:
    """A language in which participants do a task, and the file that they change."""

    name: str
    task: str
    file: str
    is_ours: bool

    @property
    def folder(self) -> Path:
        """The folder of the model solution."""
        return TASKS / self.task / self.name

    @property
    def solution(self) -> str:
        """The text of the model solution."""
        return (self.folder / self.file).read_text(encoding="utf-8")


CONDITIONS: Mapping[str, Condition] = {
    each.name: each
    for each in (
        Condition("rossmarie", "rules", "rover.ross", True),
        Condition("python", "rules", "rover.py", False),
        Condition("cpp", "rules", "rover.hpp", False),
        Condition("ezskiros", "skills", "deliver.py", True),
        Condition("skiros2", "skills", "deliver.py", False),
    )
}


class State(Enum):
    """The state of a planted fault in a participant's file.

    A file with neither the wrong nor the right text is `CHANGED`: the leader judges it.
    """

    KEPT = "kept"
    FIXED = "fixed"
    CHANGED = "changed"


@dataclass(frozen=True)
class Variant:
    """A fault as one condition has it.

    `codes` are the diagnostics of our language, `stage` is when plain tools find the fault.
    `absent` is the reason why nobody can write the fault in this condition, or empty.
    """

    right: str = ""
    wrong: str = ""
    codes: tuple[str, ...] = ()
    stage: str = ""
    absent: str = ""


@dataclass(frozen=True)
class Fault:
    """One planted fault in all conditions of its task."""

    id: str
    task: str
    title: str
    consequence: str
    is_planted: bool
    baseline: str
    variants: Mapping[str, Variant]


def read_faults(path: Path = KIT / "faults.toml") -> Sequence[Fault]:
    """All faults of the study, in the order of the list."""
    listed = tomllib.loads(path.read_text(encoding="utf-8"))["fault"]
    return tuple(map(_fault, listed))


def _fault(entry: Mapping[str, Any]) -> Fault:
    return Fault(
        id=entry["id"],
        task=entry["task"],
        title=entry["title"],
        consequence=entry["consequence"],
        is_planted=entry["planted"],
        baseline=entry.get("baseline", ""),
        variants={name: _variant(entry[name]) for name in CONDITIONS if name in entry},
    )


def _variant(entry: Mapping[str, Any]) -> Variant:
    return Variant(
        right=entry.get("right", ""),
        wrong=entry.get("wrong", ""),
        codes=tuple(entry.get("found", ())),
        stage=entry.get("stage", ""),
        absent=entry.get("absent", ""),
    )


def planted_in(condition: Condition) -> Sequence[Fault]:
    """The faults in the starting file of a condition."""
    return [
        each
        for each in read_faults()
        if each.is_planted and each.task == condition.task and condition.name in each.variants
    ]


def plant(condition: Condition, faults: Iterable[Fault]) -> str:
    """The text of the model solution with faults. Raises `ValueError` for one that does not fit."""
    text = condition.solution
    for fault in faults:
        variant = fault.variants[condition.name]
        if not variant.right or text.count(variant.right) != 1:
            raise ValueError(f"{fault.id} does not fit {condition.name}/{condition.file}")
        text = text.replace(variant.right, variant.wrong)
    return text


def states(condition: Condition, text: str) -> Mapping[str, State]:
    """The state of each planted fault in a participant's text, by the name of the fault.

    The comparison ignores white space.
    """
    compact = _compact(text)
    return {
        each.id: _state(each.variants[condition.name], compact) for each in planted_in(condition)
    }


def _state(variant: Variant, compact: str) -> State:
    wrong, right = _compact(variant.wrong), _compact(variant.right)
    leaves_out = wrong in right
    if not leaves_out and wrong in compact:
        return State.KEPT
    if right in compact:
        return State.FIXED
    return State.KEPT if leaves_out else State.CHANGED


def _compact(text: str) -> str:
    return "".join(text.split())
