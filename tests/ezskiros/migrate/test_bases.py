"""Skills on top of a base class of their own: what becomes of it, and what is left with it."""

from __future__ import annotations

from pathlib import Path

import pytest

from dslkit.diagnostics import Severity
from ezskiros.migrate.files import Migration, migrate_paths
from ezskiros.migrate.migrated import Migrated
from ezskiros.migrate.module import migrate_text
from support.engine import Skills
from support.old_callers import new_callers

IMPORTS = """\
from skiros2_skill.core.skill import SkillDescription
from skiros2_common.core.params import ParamTypes
from skiros2_common.core.primitive import PrimitiveBase
"""
BASE = """

class Caller(PrimitiveBase):
    def execute(self):
        return self.success(self.params["Text"].value)
"""
ROBOT = BASE.replace('["Text"].value', '["Robot"].value.label')
PARAMETER = 'self.addParam("Text", str, ParamTypes.Required)'


def skill(name: str, bases: str = "Caller", declared: str = PARAMETER) -> str:
    return f"""

class {name}(SkillDescription):
    def createDescription(self):
        {declared}


class {name.lower()}({bases}):
    def createDescription(self):
        self.setDescription({name}(), self.__class__.__name__)
"""


def migrated(*texts: str) -> Migrated:
    return migrate_text("skills.py", IMPORTS + "".join(texts))


def told(found: Migrated | Migration) -> list[tuple[str, str]]:
    return [(each.code, each.title) for each in found.diagnostics]


def migration(folder: Path, **texts: str) -> tuple[Migration, dict[str, str]]:
    for name, text in texts.items():
        (folder / f"{name}.py").write_text(IMPORTS + text)
    found = migrate_paths([folder])
    return found, {each.path.stem: each.migrated.text for each in found.files}


def test_the_base_stands_before_that_of_the_skill() -> None:
    found = migrated(BASE, skill("Say"), skill("Ask", "Caller, Other"))
    assert "class Caller:\n    def execute(self):\n" in found.text
    assert "class say(Caller, Say.SkillBase):" in found.text
    assert "class ask(Caller, Other, Ask.SkillBase):" in found.text
    assert "PrimitiveBase" not in found.text
    assert not found.diagnostics


def test_bases_of_a_base_stay() -> None:
    base = BASE.replace("(PrimitiveBase)", "(Named, PrimitiveBase, metaclass=Kind)")
    found = migrated(base, skill("Say"))
    assert "class Caller(Named, metaclass=Kind):" in found.text


def test_a_base_that_nothing_is_built_on_is_no_skill_of_this_migration() -> None:
    found = migrated(BASE, skill("Say", "PrimitiveBase"))
    assert BASE in found.text
    assert "class say(Say.SkillBase):" in found.text


def test_a_base_of_another_file(tmp_path: Path) -> None:
    middle = "\nfrom calling import Caller as Base\n\n\nclass Speaker(Base):\n    loud = True\n"
    found, texts = migration(
        tmp_path,
        calling=ROBOT,
        speaking=middle,
        saying=f"\nfrom speaking import Speaker\n{skill('Say', 'Speaker')}",
    )
    assert not found.diagnostics
    assert "class Caller:\n" in texts["calling"]
    assert "self.params.Robot.label" in texts["calling"]
    assert texts["speaking"].endswith(middle)
    assert "class say(Speaker, Say.SkillBase):" in texts["saying"]
    assert "Robot: INFERRED[sumo.Agent]" in texts["saying"]


def test_a_base_that_is_migrated_already(tmp_path: Path) -> None:
    _, texts = migration(tmp_path, calling=ROBOT, saying=skill("Say"))
    (tmp_path / "calling.py").write_text(texts["calling"])
    (tmp_path / "saying.py").write_text(texts["saying"])
    found, more = migration(tmp_path, asking=f"\nfrom calling import Caller\n{skill('Ask')}")
    assert not found.diagnostics
    assert more["calling"] == texts["calling"]
    assert "class ask(Caller, Ask.SkillBase):" in more["asking"]
    assert "Robot: INFERRED[sumo.Agent]" in more["asking"]


def test_a_base_that_is_nowhere_is_told_once(tmp_path: Path) -> None:
    library = "\nfrom library import Caller\n"
    found, texts = migration(
        tmp_path, saying=library + skill("Say"), asking=library + skill("Ask") + skill("Beg")
    )
    (problem,) = found.diagnostics
    assert problem.title == "`ask` inherits from `Caller`, which none of these files defines"
    assert problem.help == "if a library defines `Caller`, give its file as well"
    assert problem.notes[-1] == "for the same reason `beg` and `say` are not translated"
    assert "# EZS733: `say` inherits from `Caller`" in texts["saying"]


def test_what_is_between_a_skill_and_a_base_that_is_nowhere() -> None:
    found = migrated("\n\nclass Speaker(Caller):\n    pass\n", skill("Say", "Speaker"))
    said = "inherits from `Caller` through `Speaker`, which none of these files defines"
    assert told(found) == [("EZS733", f"`say` {said}")]


@pytest.mark.parametrize(
    ("bases", "said"),
    [("", "nothing"), ("object", "`object`"), ("beg", "`beg`")],
)
def test_bases_that_are_none_of_skills(bases: str, said: str) -> None:
    found = migrated(skill("Beg", "PrimitiveBase"), skill("Say", bases))
    assert ("EZS733", f"`say` inherits from {said}") in told(found)


def test_each_description_needs_the_parameters_of_the_base() -> None:
    found = migrated(BASE, skill("Say"), skill("Ask", declared="pass"), skill("Beg", "Caller"))
    assert told(found) == [
        ("EZS724", "`Ask` has no parameter `Text`"),
        ("EZS738", "`say`, `ask` and `beg` are not translated because `Caller` is not"),
    ]
    cause, follows = found.diagnostics
    assert cause.help == "declare it in all descriptions that are built on `Caller`"
    assert follows.severity is Severity.WARNING
    assert follows.primary.span.text == "Caller"
    left = "depends on `Caller`, which is not translated because of EZS724"
    assert f"# EZS733: `say` {left}\nclass say(Caller):\n" in found.text
    assert "class Caller(PrimitiveBase):\n" in found.text


def test_a_description_that_is_left_keeps_the_base() -> None:
    wide = PARAMETER + '\n        self.addParam("All", dict, ParamTypes.Required)'
    found = migrated(BASE, skill("Say"), skill("Ask", declared=wide))
    assert {code for code, _ in told(found)} == {"EZS704", "EZS737", "EZS738"}
    assert ("EZS738", "`Caller` and `say` are not translated because `ask` is not") in told(found)
    again = migrate_text("skills.py", found.text.replace("dict", "str"))
    assert not again.diagnostics
    assert "EZS7" not in again.text
    assert "class ask(Caller, Ask.SkillBase):" in again.text


def test_a_skill_that_is_left_for_itself_keeps_nothing() -> None:
    asking = skill("Ask") + "\n    def other(self):\n        return self.params['Text'].values\n"
    found = migrated(BASE, skill("Say"), asking)
    assert [code for code, _ in told(found)] == ["EZS732"]
    assert "class Caller:\n" in found.text
    assert "class ask(Caller):\n" in found.text


@pytest.mark.parametrize(
    ("method", "said"),
    [
        ("def expand(self, skill):\n        skill(self.child())", "`def expand`"),
        ("def child(self):\n        return self.skill('Say', '')", "a child in a class"),
    ],
)
def test_a_base_with_a_tree_is_left(method: str, said: str) -> None:
    found = migrated(BASE.replace("Primitive", "Skill"), f"\n    {method}\n", skill("Say"))
    assert [code for code, _ in told(found)] == ["EZS730", "EZS738"]
    assert found.diagnostics[0].title.startswith(said)
    assert "class Caller(SkillBase):" in found.text


def test_a_base_that_changes_descriptions_is_left() -> None:
    method = "\n    def modifyDescription(self, skill):\n        pass\n"
    found = migrated(BASE, method, skill("Say"))
    assert [code for code, _ in told(found)] == ["EZS734", "EZS738"]


def test_keys_that_are_no_names_are_those_of_all_skills() -> None:
    base = BASE.replace('"Text"', '"the text"')
    same = PARAMETER.replace('"Text"', '"the text"')
    found = migrated(base, skill("Say", declared=same), skill("Ask", declared=same))
    assert "self.params.TheText" in found.text
    other = 'self.addParam("TheText", 1, ParamTypes.Required)\n        ' + same
    found = migrated(base, skill("Say", declared=same), skill("Ask", declared=other))
    said = "uses `the text`, which skills on top of it call `TheText` and `TheText_2`"
    assert told(found)[0] == ("EZS733", f"`Caller` {said}")


STATE = "from skiros2_common.core.abstract_skill import State\n"


def returning(text: str) -> str:
    return f"{skill('Say', 'PrimitiveBase')}\n    def execute(self):\n        return {text}\n"


def test_states() -> None:
    found = migrated(STATE, returning("State.Running if self.State else call(State=1)"))
    assert "return State.RUNNING if self.State else call(State=1)\n" in found.text
    assert "from ezskiros import SkillDescription, State\n" in found.text
    assert "abstract_skill" not in found.text


def test_a_state_under_another_name() -> None:
    found = migrated(STATE.replace("State\n", "State as S\n"), returning("S.Success"))
    assert "return State.SUCCESS\n" in found.text


def test_states_that_only_skiros2_has() -> None:
    found = migrated(STATE, returning("State.Failure if self.x == State.Idle else 1"))
    assert [title.partition(" belongs ")[0] for _, title in told(found)] == ["`State.Idle`"]
    assert "return State_.FAILURE if self.x == State.Idle else 1\n" in found.text
    assert "import SkillDescription, State as State_\n" in found.text


CALLERS = """

class Twice(SkillDescription):
    def description(self):
        pass


class twice(Twice.SkillBase):
    def expandBT(self, params):
        self.serialstar(Greet.greet(Text="once"), Greet.greet(Text="again"))


class soon(Twice.SkillBase):
    def expandBT(self, params):
        self.parallelfs(Greet.greet(Ticks=9), Greet.greet(Text="short", Ticks=2))


class again(Twice.SkillBase):
    def expandBT(self, params):
        self.retry(self.inverter(Greet.greet(Ticks=1)), 2)


class nobody(Twice.SkillBase):
    def expandBT(self, params):
        self.serialstar(Greet.greet_nobody())


class Told(SkillDescription):
    def description(self):
        pass


class told(Told.SkillBase):
    def execute(self):
        return self.success(str(Client.asked))
"""


@pytest.mark.parametrize(
    ("tree", "is_success", "told"),
    [
        ("twice", True, ["made", "once", "made", "again"]),
        ("soon", True, ["made", "hello", "made", "short", "cancelled"]),
        ("again", False, ["made", "hello", "hello"]),
        ("nobody", False, ["made"]),
    ],
)
def test_skills_on_a_base_run(tmp_path: Path, tree: str, is_success: bool, told: list[str]) -> None:
    task = f"""

class Task(SkillDescription):
    def description(self):
        pass


class task(Task.SkillBase):
    def expandBT(self, params):
        self.serialstar(self.{"serial" if is_success else "inverter"}(Twice.{tree}()), Told())
"""
    ran = Skills(tmp_path, new_callers() + CALLERS + task).run("Task")
    assert ran.outcome.is_success, ran.reason
    assert str(told) in ran.notes
    assert ("nobody listens" in ran.notes) is (tree == "nobody")
