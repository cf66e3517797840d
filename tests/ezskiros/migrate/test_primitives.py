"""Implementations that speak of planning, and parameters that get nothing."""

from __future__ import annotations

import pytest

from ezskiros.migrate.module import migrate_text

DESCRIBED = '''\
class Forget(SkillDescription):
    def createDescription(self):
        self.addParam("What", Element("sumo:Object"), ParamTypes.Required)
        self.addParam("Speed", 0.5, ParamTypes.Required)


class forget(PrimitiveBase):
    """Takes something away."""

    def createDescription(self):
        {said}
        self.setDescription(Forget(), self.__class__.__name__)

    def execute(self):
{body}
        return self.success("done")
'''


def migrated(body: str, said: str = "pass") -> tuple[str, list[str]]:
    lines = "".join(f"        {line}\n" for line in body.splitlines()).rstrip("\n")
    found = migrate_text("skills.py", DESCRIBED.format(said=said, body=lines))
    return found.text, [each.code for each in found.diagnostics]


def test_a_skill_that_is_not_for_planning() -> None:
    text, codes = migrated("pass", "self.setAvailableForPlanning(False)  # by hand")
    assert codes == []
    assert (
        '    """Takes something away."""\n\n'
        "    # by hand\n"
        "    available_for_planning = False\n\n"
        "    def execute(self):\n"
    ) in text


def test_a_skill_that_is_for_planning() -> None:
    text, codes = migrated("pass", "self.setAvailableForPlanning(True)")
    assert codes == []
    assert "planning" not in text


def test_what_is_computed_is_left() -> None:
    assert migrated("pass", "self.setAvailableForPlanning(PLANNED)")[1] == ["EZS734"]


def test_an_individual_that_is_taken_away() -> None:
    text, codes = migrated('self.params["What"].unset()  # gone')
    assert codes == []
    assert "        self.params.What = None  # gone\n" in text


def test_a_value_cannot_be_taken_away() -> None:
    assert migrated('self.params["Speed"].unset()')[1] == ["EZS732"]


def test_a_variable_that_stands_for_a_parameter() -> None:
    text, codes = migrated(
        "# which\n"
        'what = self.params["What"]  # any\n'
        "name = what.value.id\n"
        "what.unset()\n"
        "what.value = self.other(what=name)\n"
    )
    assert codes == []
    assert (
        "        # which\n"
        "        # any\n"
        "        name = self.params.What.id\n"
        "        self.params.What = None\n"
        "        self.params.What = self.other(what=name)\n"
    ) in text


@pytest.mark.parametrize(
    "more",
    ["self.keep(what)", "what = 3", "what += 1", "for what in range(2): pass", "del what"],
)
def test_a_variable_of_which_more_becomes(more: str) -> None:
    found = migrated(f'what = self.params["What"]\nwhat.unset()\n{more}')
    assert "EZS732" in found[1]
    assert "self.params.What" not in found[0]
