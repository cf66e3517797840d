"""`modifyDescription`: pre-conditions by which an implementation is chosen."""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros.engine.events import Happened
from ezskiros.migrate.module import migrate_text
from support.engine import Skills
from support.own_conditions import NATIVE, PAIRS, SCENE

CLASSES = """\
class Open(SkillDescription):
    def createDescription(self):
        self.addParam("The Door", Element("skiros:Door"), ParamTypes.Required)
        self.addParam("Speed", 0.5, ParamTypes.Required)


class open(PrimitiveBase):
    def createDescription(self):
        self.setDescription(Open(), self.__class__.__name__)

    # Only where it helps
    def modifyDescription(self, skill):
{lines}

    def execute(self):
        return self.success("open")
"""
LOCKED = 'self.getPropCond("Locked", "skiros:Locked", "The Door", "=", True, True)'


def migrated(lines: str) -> tuple[str, list[str]]:
    """The translation of the method with these lines, and the codes of the findings."""
    text = "\n".join(f"        {line}" for line in lines.splitlines())
    found = migrate_text("skills.py", CLASSES.format(lines=text))
    new = found.text
    start = new.index("class open(")
    return new[start : new.index("    def execute")], [each.code for each in found.diagnostics]


def test_pre_conditions_are_those_of_the_method_conditions() -> None:
    lines = f'"""Not by force."""\n# first\nskill.addPreCondition({LOCKED})  # key\n# last'
    text, codes = migrated(lines)
    assert codes == []
    assert text == (
        "class open(Open.SkillBase):\n"
        "    # Only where it helps\n"
        "    def conditions(self, TheDoor):\n"
        '        """Not by force."""\n'
        "        # first\n"
        "        self.pre_conditions += TheDoor.Locked == True  # key\n"
        "        # last\n\n"
    )


def test_without_conditions_the_method_goes_and_its_comments_stay() -> None:
    text, codes = migrated("pass  # nothing yet")
    assert codes == []
    assert text == ("class open(Open.SkillBase):\n    # Only where it helps\n    # nothing yet\n")


def test_an_optional_parameter_is_declared_by_those_that_use_it() -> None:
    text, codes = migrated('skill.addParam("Key", Element("skiros:Key"), ParamTypes.Optional)')
    assert codes == []
    assert "Key" not in text


@pytest.mark.parametrize(
    ("lines", "code"),
    [
        (f"skill.addPostCondition({LOCKED})", "EZS734"),
        ('skill.addParam("Key", Element("skiros:Key"), ParamTypes.Required)', "EZS734"),
        (f"if self.careful:\n    skill.addPreCondition({LOCKED})", "EZS734"),
        ("skill.addPreCondition(self.condition)", "EZS710"),
        (
            'skill.addPreCondition(self.getHasPropCond("", "skiros:Locked", "Speed", True))',
            "EZS711",
        ),
    ],
)
def test_what_has_no_translation_is_left(lines: str, code: str) -> None:
    text, codes = migrated(lines)
    assert codes == [code]
    assert text.startswith("class open(PrimitiveBase):")
    assert f"# {code}: " in text


def test_a_second_migration_does_nothing() -> None:
    once = migrate_text("skills.py", NATIVE).text
    assert migrate_text("skills.py", once).text == once


@pytest.mark.parametrize(("one", "two", "told"), PAIRS)
def test_the_engine_chooses_among_migrated_skills(
    tmp_path: Path, one: str, two: str, told: list[str]
) -> None:
    found = migrate_text("skills.py", NATIVE)
    assert found.diagnostics == []
    source = found.text.replace("from world import skiros\n", "")
    ran = Skills(tmp_path, source, SCENE).run("Task", f"One={one}", f"Two={two}")
    ended = [each for each in ran.events if each.happened is Happened.SUCCEEDED]
    assert [each.text for each in ended if each.text != "End"] == told
