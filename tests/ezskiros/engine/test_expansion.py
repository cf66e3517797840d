"""`expandBT` is run with the real values, and not more often than it has to be."""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros.engine import expansion
from ezskiros.trees.build import build
from support.engine import Skills

SOURCE = """
class Step(SkillDescription):
    def description(self, Name: str, Length: float = 1.0):
        pass


class step(Step.SkillBase):
    def execute(self):
        return self.success(f"{self.params.Name} {self.params.Length}")


class Mode(enum.Enum):
    FAST = 1
    SAFE = 2


class Go(SkillDescription):
    def description(self, Count: int, Mode: Mode, Length: float = 0.5):
        pass


class go(Go.SkillBase):
    def expandBT(self, params):
        steps = [Step(Name="far", Length=params.Length * 2)]
        if params.Count > 1:
            steps.append(Step(Name="more"))
        if params.Mode == Mode.SAFE:
            steps.append(Step(Name="safe", Length=params.Length))
        self.serialstar(*steps)


class Same(SkillDescription):
    def description(self, Length: float):
        pass


class same(Same.SkillBase):
    def expandBT(self, params):
        self.serial(Step(Name="near", Length=params.Length), Step(Name="far"))


class Twice(SkillDescription):
    def description(self, Length: float):
        pass


class twice(Twice.SkillBase):
    def expandBT(self, params):
        self.serial(Step(Name="twice", Length=params.Length * 2))


class Often(SkillDescription):
    def description(self):
        pass


class often(Often.SkillBase):
    def expandBT(self, params):
        self.serialstar(
            *[Go(Count=2, Mode=Mode.FAST) for _ in range(5)], Go(Count=1, Mode=Mode.FAST),
            *[Same(Length=float(number)) for number in range(5)],
        )
"""


def said(skills: Skills, *words: str) -> list[str]:
    """The messages of the steps."""
    ran = skills.run(*words)
    assert ran.outcome.is_success, ran.reason
    return [text for text in ran.notes if text not in ("Start", "End")]


def test_branches_and_computations_go_by_the_real_values(tmp_path: Path) -> None:
    skills = Skills(tmp_path, SOURCE)
    assert said(skills, "go", "Count=1", "Mode=FAST") == ["far 1.0"]
    assert said(skills, "go", "Count=2", "Mode=SAFE", "Length=3") == [
        "far 6.0",
        "more 1.0",
        "safe 3.0",
    ]
    assert said(skills, "same", "Length=2.5") == ["near 2.5", "far 1.0"]
    assert said(skills, "twice", "Length=2.5") == ["twice 5.0"]


def test_expand_is_run_once_for_the_same_values(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = []

    def counted(implementation: type, *others: object) -> object:
        made.append(implementation.__name__)
        return build(implementation, *others)  # type: ignore[arg-type]

    monkeypatch.setattr(expansion, "build", counted)
    said(Skills(tmp_path, SOURCE), "often")
    assert made == ["go", "go"]


def test_what_only_goes_wrong_with_the_real_values_is_a_failure(tmp_path: Path) -> None:
    source = SOURCE.replace("params.Length * 2", "params.Length / params.Count", 1)
    skills = Skills(tmp_path, source)
    assert said(skills, "go", "Count=1", "Mode=FAST") == ["far 0.5"]
    ran = skills.run("go", "Count=0", "Mode=FAST")
    assert ran.events[-1].code == -404
    assert "`expandBT` raised ZeroDivisionError" in ran.reason
