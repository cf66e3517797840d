"""Classes that are left because a skill is left are told once, as a consequence."""

from __future__ import annotations

from pathlib import Path

from dslkit.diagnostics import Severity
from ezskiros.migrate.files import migrate_paths
from ezskiros.migrate.module import migrate_text

HEAD = """\
from skiros2_skill.core.skill import SkillDescription, SkillBase
from skiros2_common.core.params import ParamTypes
from skiros2_common.core.primitive import PrimitiveBase
"""
WRITE = """

class Write(SkillDescription):
    def createDescription(self):
        self.addParam("Values", dict, ParamTypes.Required)


class write(PrimitiveBase):
    def createDescription(self):
        self.setDescription(Write(), self.__class__.__name__)

    def execute(self):
        return self.success()
"""
OPEN = """

class Open(SkillDescription):
    def createDescription(self):
        pass


class open_door(SkillBase):
    def createDescription(self):
        self.setDescription(Open(), self.__class__.__name__)

    def expand(self, skill):
        skill(
            self.skill("Write", "", specify={"Values": {"Open": True}}),
            self.skill("Write", "", specify={"Values": {"Busy": True}}),
        )


class open_gate(SkillBase):
    def createDescription(self):
        self.setDescription(Open(), self.__class__.__name__)

    def expand(self, skill):
        skill(self.skill("Write", "", specify={"Values": {"Open": True}}))
"""


def test_all_that_is_left_with_a_description_is_one_finding() -> None:
    found = migrate_text("skills.py", HEAD + WRITE + OPEN)
    assert found.unimplemented == ["write", "open_door", "open_gate"]
    cause, follows = found.diagnostics
    assert cause.code == "EZS704"
    assert (follows.code, follows.severity) == ("EZS737", Severity.WARNING)
    assert (
        follows.title
        == "`write`, `open_door` and `open_gate` are not translated because `Write` is not"
    )
    assert follows.primary.span.text == "Write"
    assert follows.primary.text == "this description is not translated because of EZS704"


def test_each_place_has_a_mark() -> None:
    text = migrate_text("skills.py", HEAD + WRITE + OPEN).text
    assert text.count("# EZS722: the child `Write` is not translated because of EZS704\n") == 2
    assert (
        text.count(
            "# EZS721: `Write`, which this class implements, is not translated because of EZS704"
        )
        == 1
    )


def test_over_several_files(tmp_path: Path) -> None:
    (tmp_path / "opening.py").write_text(HEAD + OPEN)
    (tmp_path / "writing.py").write_text(HEAD + WRITE)
    found = migrate_paths([tmp_path])
    assert [each.code for each in found.diagnostics] == ["EZS704", "EZS737"]
    (place,) = {Path(each.primary.span.file.path).stem for each in found.diagnostics}
    assert place == "writing"


def test_a_skill_that_is_nowhere_is_told_once() -> None:
    found = migrate_text("skills.py", HEAD + OPEN)
    (problem,) = found.diagnostics
    assert problem.code == "EZS722"
    assert problem.title == "the child `Write` is not described in these files"
    assert problem.notes[-1] == "for the same reason `open_gate` is not translated"


def test_what_has_faults_of_its_own_is_told_of_those_too() -> None:
    text = (HEAD + WRITE + OPEN).replace(
        "skill(self.skill(", "skill.setProcessor(X())\n        skill(self.skill("
    )
    codes = [each.code for each in migrate_text("skills.py", text).diagnostics]
    assert codes == ["EZS704", "EZS726", "EZS737"]
