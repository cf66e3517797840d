"""Skills that pass values to each other, and the values that their primitives have."""

from __future__ import annotations

SKILLS = """
class Push(SkillDescription):
    def description(self, Force: float = 0.5, Speed: float = 0.1):
        pass


class push(Push.SkillBase):
    def execute(self):
        return self.success(f"{self.params.Force} {self.params.Speed}")


class Twice(SkillDescription):
    def description(self, Force: float = 0.25):
        pass


class twice(Twice.SkillBase):
    def expandBT(self, params):
        self.serialstar(Push(Force=params.Force), Push(Speed=params.Force))


class Weigh(SkillDescription):
    def description(self, Found: OPTIONAL[float] = 1.0, Fails: bool = False):
        pass


class weigh(Weigh.SkillBase):
    def execute(self):
        if self.params.Fails:
            return self.fail("empty", -1)
        self.params.Found = 3.5
        return self.success(f"{self.params.Found}")


class Double(SkillDescription):
    def description(self, Force: float, Twofold: OUTPUT[float]):
        pass


class double(Double.SkillBase):
    def execute(self):
        self.params.Twofold = 2 * self.params.Force
        return self.success(f"{self.params.Twofold}")


class Tell(SkillDescription):
    def description(self, Force: float, Speed: float):
        pass


class tell(Tell.SkillBase):
    def execute(self):
        return self.success(f"{self.params.Force} {self.params.Speed}")


class Again(SkillDescription):
    def description(self, Force: float):
        pass


class again(Again.SkillBase):
    def expandBT(self, params):
        self.serialstar(Tell(Force=params.Force, Speed=params.Force * 2))


class Both(SkillDescription):
    def description(self, Force: float, Speed: float):
        pass


class both(Both.SkillBase):
    def expandBT(self, params):
        self.serialstar(Again(Force=params.Speed))


class Grow(SkillDescription):
    def description(self, Force: float):
        pass


class grow(Grow.SkillBase):
    def execute(self):
        self.params.Force = self.params.Force + 1
        return self.step() if self.params.Force < 11 else self.success(f"{self.params.Force}")


class Stay(SkillDescription):
    def description(self, Force: float = 0.75):
        pass


class stay(Stay.SkillBase):
    count = 0

    def execute(self):
        self.count += 1
        return self.step() if self.count < 3 else self.success(f"{self.params.Force}")


class Say(SkillDescription):
    def description(self, Force: str = "hard", Word: str = "soft"):
        pass


class say(Say.SkillBase):
    def execute(self):
        return self.success(f"{self.params.Force} {self.params.Word}")


class Read(SkillDescription):
    def description(self, Word: OPTIONAL[str]):
        pass


class read(Read.SkillBase):
    def execute(self):
        return self.success(f"{self.params.Word}")


class Count(SkillDescription):
    def description(self, Word: OPTIONAL[int]):
        pass


class count(Count.SkillBase):
    def execute(self):
        return self.success(f"{self.params.Word}")


class Note(SkillDescription):
    def description(self, Force: OPTIONAL[float], Speed: OPTIONAL[float]):
        pass


class note(Note.SkillBase):
    def execute(self):
        return self.success(f"{self.params.Force} {self.params.Speed}")


class Chain(SkillDescription):
    def description(self, One: float, Other: float):
        pass


class chain(Chain.SkillBase):
    def expandBT(self, params):
        self.serialstar(Note(Force=params.Other, Speed=params.One))


class Deep(SkillDescription):
    def description(self, Fails: bool = False):
        pass


class deep(Deep.SkillBase):
    def expandBT(self, params):
        self.serialstar(Read())


class Task(SkillDescription):
    def description(self, *, Mine: float = 1.0, Force: float = 2.0, Speed: float = 4.0,
                    Found: OPTIONAL[float] = 6.0, Unset: OPTIONAL[float]):
        pass


class task(Task.SkillBase):
    def expandBT(self, params):
        self.serialstar({tree})
"""

TREES = [
    ("Push(Force=params.Mine), Push(), Push(Force=params.Mine)", ["8.0 0.1", "0.5 0.1", "8.0 0.1"]),
    ("Push(Force=params.Force), Push(Force=params.Force)", ["2.0 0.1", "2.0 0.1"]),
    ("Push(Force=params.Speed, Speed=params.Force)", ["4.0 2.0"]),
    ("Push(), Push(Force=params.Force, Speed=params.Speed)", ["0.5 0.1", "2.0 4.0"]),
    ("Push(Force=params.Mine, Speed=params.Mine)", ["8.0 8.0"]),
    ("Push(Force=params.Mine * 2), Push(Force=params.Mine)", ["16.0 0.1", "8.0 0.1"]),
    ("Push(Force=params.Unset), Twice(Force=params.Unset)", ["0.5 0.1", "0.5 0.1", "0.5 0.5"]),
    ("Twice(Force=params.Mine), Push(Force=params.Force)", ["8.0 0.1", "0.5 8.0", "2.0 0.1"]),
    ("Twice(), Push(Force=params.Force)", ["0.25 0.1", "0.5 0.25", "2.0 0.1"]),
    ("Twice(Force=7.0), Push(Force=params.Force)", ["7.0 0.1", "0.5 7.0", "2.0 0.1"]),
    ("self.parallelff(Push(Force=params.Mine), Push(Speed=params.Mine))", ["8.0 0.1", "0.5 8.0"]),
    ("Weigh(), Push(Force=params.Found)", ["3.5", "3.5 0.1"]),
    ("Weigh(Found=2.0), Push(Force=params.Found)", ["3.5", "6.0 0.1"]),
    ("self.nofail(Weigh(Fails=True)), Push(Force=params.Found)", ["empty", "6.0 0.1"]),
    ("Weigh(Found=params.Mine), Push(Force=params.Mine)", ["3.5", "3.5 0.1"]),
    (
        "Double(Force=params.Mine, Twofold=params.Found), Push(Force=params.Found)",
        ["16.0", "16.0 0.1"],
    ),
]
"""Trees, and the values that their primitives have: `Mine` is given, 8.0."""
IDS = [tree for tree, _ in TREES]


def skills(tree: str) -> str:
    """The skills, among them `Task` with these children; `Mine` is to be given."""
    return SKILLS.replace("{tree}", tree)
