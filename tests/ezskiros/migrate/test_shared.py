"""Keys that children share and that their compound does not declare: what becomes of them."""

from __future__ import annotations

import tempfile
from pathlib import Path

import pytest

from ezskiros.migrate.files import migrate_paths
from ezskiros.migrate.migrated import Migrated
from ezskiros.migrate.module import migrate_text
from support.tree_round_trip import new_trees, old_trees

HEAD = """\
from skiros2_skill.core.skill import SkillDescription, SkillBase
from skiros2_common.core.params import ParamTypes
from skiros2_common.core.primitive import PrimitiveBase
from skiros2_common.core.world_element import Element
"""


def described(name: str, *parameters: tuple[str, str, str]) -> str:
    """A description with parameters: key, value and kind."""
    lines = "".join(
        f'        self.addParam("{key}", {value}, ParamTypes.{kind})\n'
        for key, value, kind in parameters
    )
    body = lines or "        pass\n"
    return f"\n\nclass {name}(SkillDescription):\n    def createDescription(self):\n{body}"


def primitive(name: str) -> str:
    return implementation(name, "PrimitiveBase") + (
        "\n    def execute(self):\n        return self.success()\n"
    )


def compound(name: str, *children: str, **options: str) -> str:
    lines = "".join(f"            {each},\n" for each in children)
    return implementation(name, "SkillBase", **options) + (
        f"\n    def expand(self, skill):\n        skill(\n{lines}        )\n"
    )


def implementation(name: str, base: str, of: str = "") -> str:
    return (
        f"\n\nclass {name}({base}):\n    def createDescription(self):\n"
        f"        self.setDescription({of or name.capitalize()}(), self.__class__.__name__)\n"
    )


PLACE = 'Element("skiros:Location")'
ANYTHING = 'Element("sumo:Object")'
LOOK = described("Look", ("Free", PLACE, "Optional")) + primitive("look")
DRIVE = described("Drive", ("Target", PLACE, "Required")) + primitive("drive")
FORGET = described("Forget", ("What", ANYTHING, "Required")) + primitive("forget")
SKILLS = HEAD + LOOK + DRIVE + FORGET
LOOKS = 'self.skill("Look", "look", remap={"Free": "Spot"})'
DRIVES = 'self.skill("Drive", "drive", remap={"Target": "Spot"})'
FORGETS = 'self.skill("Forget", "", remap={"What": "Spot"})'


def migrated(text: str) -> Migrated:
    return migrate_text("skills.py", text)


def said(found: Migrated) -> list[str]:
    return [f"{each.code}: {each.title}" for each in found.diagnostics]


def test_siblings_go_on_sharing_what_nobody_declares() -> None:
    text = SKILLS + described("Park", ("Lot", PLACE, "Required"))
    text += compound("park", LOOKS, DRIVES, FORGETS)
    found = migrated(text)
    assert not found.unimplemented
    assert "def description(self, Lot: skiros.Location, Spot: OPTIONAL[skiros.Location]):" in (
        found.text
    )
    assert "Drive.drive(Target=params.Spot),\n" in found.text
    with tempfile.TemporaryDirectory() as folder:
        new, _ = new_trees(found.text, text, Path(folder))
    assert new == old_trees(text)


def test_that_a_description_gets_a_parameter_is_told_once() -> None:
    text = SKILLS + described("Park") + compound("park", LOOKS, DRIVES)
    text += compound("park_again", LOOKS, DRIVES, FORGETS, of="Park")
    (problem,) = migrated(text).diagnostics
    assert (problem.code, problem.severity.value) == ("EZS736", "warning")
    assert problem.primary.span.text == "Park"
    assert "`Spot`" in problem.title
    assert problem.primary.text == "for `park` and `park_again`"
    assert problem.help is not None
    assert 'self.addParam("Spot", Element("skiros:Location"), ParamTypes.Optional)' in problem.help


def test_once_is_enough() -> None:
    once = migrated(SKILLS + described("Park") + compound("park", LOOKS, DRIVES))
    twice = migrated(once.text)
    assert (twice.text, said(twice)) == (once.text, [])


def test_a_key_that_is_no_name() -> None:
    text = SKILLS + described("Park") + compound("park", LOOKS, DRIVES)
    found = migrated(text.replace("Spot", "free spot"))
    assert 'FreeSpot: Annotated[OPTIONAL[skiros.Location], Key("free spot")]' in found.text
    assert "Drive.drive(Target=params.FreeSpot)" in found.text


def test_the_key_of_a_sibling() -> None:
    """A key that a sibling has by itself is shared without a remap; its class is taken."""
    text = SKILLS + described("Park")
    text += compound("park", LOOKS.replace('{"Free": "Spot"}', "{}"), FORGETS)
    found = migrated(text.replace('"Spot"', '"Free"'))
    assert "def description(self, Free: OPTIONAL[skiros.Location]):" in found.text
    assert "Look.look(),\n            Forget(What=params.Free),\n" in found.text


def test_values_are_shared_too() -> None:
    text = HEAD + described("Weigh", ("Weight", "float", "Optional")) + primitive("weigh")
    text += described("Lift", ("Load", "float", "Required")) + primitive("lift")
    text += described("Park")
    weighs = 'self.skill("Weigh", remap={"Weight": "Mass"})'
    text += compound("park", weighs, 'self.skill("Lift", remap={"Load": "Mass"})')
    assert "def description(self, Mass: OPTIONAL[float]):" in migrated(text).text


ABOVE = described("Tidy") + compound(
    "tidy", 'self.skill("Park", "")', 'self.skill("Forget", "", remap={"What": "Spot"})'
)


def test_a_key_of_skills_below() -> None:
    """`Tidy` forgets what a child of `Park` has found: `Park` has to hand it up."""
    for park in (
        compound("park", LOOKS, DRIVES),
        compound("park", 'self.skill("Look", "look")').replace("Look", "LookFor"),
    ):
        text = SKILLS + described("LookFor", ("Spot", PLACE, "Optional"))
        text += primitive("look_for").replace("Look_for", "LookFor")
        found = migrated(text + described("Park") + park + ABOVE)
        declared = "(self, Spot: OPTIONAL[skiros.Location]):"
        assert found.text.count(declared) == 3, found.text  # with that of LookFor
        assert not found.unimplemented


def test_a_key_that_is_another_one_below() -> None:
    hidden = ABOVE.replace('"Park", ""', '"Park", "", remap={"Spot": "Lot"}')
    park = described("Park", ("Spot", PLACE, "Required")) + compound("park", DRIVES)
    found = migrated(SKILLS + park + hidden)
    assert "Lot: OPTIONAL[skiros.Location]" in found.text
    assert "Spot: OPTIONAL[sumo.Object]" in found.text


def test_a_tree_that_is_left_needs_no_parameters() -> None:
    text = SKILLS + described("Park")
    text += compound("park", LOOKS, DRIVES, 'self.skill("Nowhere", "")')
    found = migrated(text)
    assert said(found) == ["EZS722: the child `Nowhere` is not described in these files"]
    assert "Spot: " not in found.text
    assert "EZS723" not in found.text


def test_classes_that_differ() -> None:
    box = described("Grip", ("Box", 'Element("skiros:Product")', "Required")) + primitive("grip")
    grips = 'self.skill("Grip", "grip", remap={"Box": "Spot"})'
    text = SKILLS + box + described("Park") + compound("park", LOOKS, grips)
    found = migrated(text)
    assert found.unimplemented == ["park"]
    (problem,) = found.diagnostics
    assert problem.code == "EZS723"
    wanted = "it is a skiros:Location for `Look`, and a skiros:Product for `Grip`"
    assert problem.primary.text == wanted


def test_classes_that_differ_below() -> None:
    """Below `Park` the key has two classes, so the tree of `Tidy` is left; `Park` needs no key."""
    individuals = described("Box", ("Spot", 'Element("skiros:Product")', "Optional")) + primitive(
        "box"
    )
    text = SKILLS + individuals + described("Lot", ("Spot", PLACE, "Optional")) + primitive("lot")
    park = described("Park") + compound("park", 'self.skill("Box", "")', 'self.skill("Lot", "")')
    found = migrated(text + park + ABOVE)
    assert found.unimplemented == ["tidy"]
    (problem,) = found.diagnostics
    assert (problem.code, problem.primary.span.text) == ("EZS723", '"Spot"')
    assert "a skiros:Product for `Box`" in problem.primary.text


def test_each_key_is_looked_for_below_each_tree() -> None:
    finds = described("Find", ("Box", ANYTHING, "Optional")) + primitive("find")
    text = SKILLS + finds + described("Inner") + compound("inner", 'self.skill("Find", "")')
    first = compound("first", LOOKS, FORGETS, FORGETS.replace("Spot", "Box"), of="Park")
    second = compound(
        "second", LOOKS, FORGETS, FORGETS.replace("Spot", "Box"), 'self.skill("Inner")', of="Park"
    )
    found = migrated(text + described("Park") + first + second)
    assert "class Inner(SkillDescription):\n    def description(self, Box: OPT" in found.text


def test_a_slip_makes_no_parameter() -> None:
    text = SKILLS + described("Park", ("Goal", PLACE, "Required"))
    drives = DRIVES.replace("Spot", "Gaol")
    (problem,) = migrated(text + compound("park", drives)).diagnostics
    assert problem.code == "EZS723"
    assert problem.primary.span.text == '"Gaol"'
    assert problem.primary.text == 'only this child has it: is "Goal" meant?'


@pytest.mark.parametrize("meant", ["Spot1", "Place"])
def test_what_is_no_slip(meant: str) -> None:
    text = SKILLS + described("Park", (meant, PLACE, "Required"))
    drives = DRIVES.replace('"Spot"', '"Spot2"')
    assert [each.code for each in migrated(text + compound("park", drives)).diagnostics] == [
        "EZS736"
    ]


def test_a_remap_of_a_key_that_the_child_lacks() -> None:
    """The first end is wrong, whatever the second is."""
    text = SKILLS + described("Park")
    drives = DRIVES.replace('"Target"', '"Traget"')
    (problem,) = migrated(text + compound("park", LOOKS, drives, DRIVES)).diagnostics
    assert (problem.code, problem.primary.span.text) == ("EZS724", '"Traget"')
    assert problem.title == "`Drive` has no parameter `Traget`"


def test_a_remap_the_wrong_way_round() -> None:
    text = SKILLS + described("Park", ("Lot", PLACE, "Required"))
    drives = 'self.skill("Drive", "drive", remap={"Lot": "Target"})'
    (problem,) = migrated(text + compound("park", drives)).diagnostics
    assert (problem.code, problem.primary.span.text) == ("EZS724", '"Lot"')
    assert problem.help == 'write {"Target": "Lot"}: the parameter of the child comes first'


def test_a_parameter_that_only_children_have_is_none_of_the_methods() -> None:
    text = SKILLS + described("Park") + compound("park", LOOKS, DRIVES)
    text += implementation("ask", "PrimitiveBase", of="Park")
    text += '\n    def execute(self):\n        return self.success(self.params["Spot"].value.id)\n'
    found = migrated(text)
    assert found.unimplemented == ["ask"]
    assert "EZS724: `Park` has no parameter `Spot`" in said(found)


def test_a_description_of_another_file(tmp_path: Path) -> None:
    (tmp_path / "described.py").write_text(HEAD + described("Park"))
    (tmp_path / "used.py").write_text(SKILLS + compound("park", LOOKS, DRIVES))
    found = migrate_paths([tmp_path])
    texts = {each.path.stem: each.migrated.text for each in found.files}
    assert "def description(self, Spot: OPTIONAL[skiros.Location]):" in texts["described"]
    assert "Drive.drive(Target=params.Spot)" in texts["used"]
    assert [each.code for each in found.diagnostics] == ["EZS736"]


def test_a_skill_of_ezskiros_gets_no_parameter(tmp_path: Path) -> None:
    new = "from ezskiros import SkillDescription\n\n\nclass Park(SkillDescription):\n"
    (tmp_path / "described.py").write_text(new + "    def description(self):\n        pass\n")
    (tmp_path / "used.py").write_text(SKILLS + compound("park", LOOKS, DRIVES))
    found = migrate_paths([tmp_path])
    assert {each.code for each in found.diagnostics} == {"EZS723"}
    assert {each.primary.text for each in found.diagnostics} == {
        "`Park` is a skill of EzSkiROS already"
    }
