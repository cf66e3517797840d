"""Imports, and names that a file has already."""

from __future__ import annotations

import pytest

from ezskiros.migrate.labels import says_more
from ezskiros.migrate.module import migrate_text

SKILL = """\


class Go(SkillDescription):
    def createDescription(self):
        self.addParam("{key}", Element("skiros:Location"), ParamTypes.Required)
        self.addPreCondition(self.getIsSpecifiedCond("", "{key}", True))
"""
API = "from skiros2_skill.core.skill import SkillDescription"


def migrated(imports: str, rest: str = "", key: str = "Place") -> str:
    found = migrate_text("skills.py", imports + "\n" + SKILL.format(key=key) + rest)
    assert found.translated == ["Go"], found.diagnostics
    compile(found.text, "skills.py", "exec")
    return found.text


def head(text: str) -> list[str]:
    return text.partition("\n\n\nclass")[0].splitlines()


def test_names_that_nothing_needs_go() -> None:
    text = migrated(f"import rospy\n{API}, ParamOptions, SkillBase, Serial\nimport math")
    assert head(text) == [
        "import rospy",
        "from skiros2_skill.core.skill import SkillBase, Serial",
        "from ezskiros import SkillDescription, specified",
        "from world import skiros",
        "import math",
    ]


def test_names_that_something_needs_stay() -> None:
    rest = "\n\nclass go(SkillBase):\n    kind = ParamTypes.Required\n    def f(self): Element()\n"
    imports = "from skiros2_common.core.params import ParamTypes\n" + API
    text = migrated(f"{imports}\nfrom skiros2_common.core.world_element import Element", rest)
    assert "from skiros2_common.core.params import ParamTypes" in head(text)
    assert "from skiros2_common.core.world_element import Element" in head(text)


def test_what_a_module_exports_stays() -> None:
    text = migrated(f"{API}\nfrom a import b", "\n\n__all__ = ['ParamTypes', 'Go']\n")
    assert head(text)[0] == "from ezskiros import SkillDescription, specified"
    text = migrated(
        f"{API}\nfrom skiros2_common.core.params import ParamTypes",
        "\n\n__all__ = ['ParamTypes']\n",
    )
    assert "from skiros2_common.core.params import ParamTypes" in head(text)


def test_names_of_the_same_meaning_elsewhere_stay() -> None:
    text = migrated(f"{API}\nfrom our.world import Element\nfrom our.kinds import ParamTypes")
    assert "from our.world import Element" in head(text)
    assert "from our.kinds import ParamTypes" in head(text)


def test_the_new_class_is_not_hidden_by_the_old_one() -> None:
    text = migrated(f"from skiros2_common.core.params import ParamTypes\n{API}")
    assert head(text) == [
        "from ezskiros import SkillDescription, specified",
        "from world import skiros",
    ]


def test_an_alias_of_the_class_is_known() -> None:
    found = migrate_text(
        "skills.py",
        "from skiros2_skill.core.skill import SkillDescription as Description\n"
        "class Go(Description):\n    def createDescription(self): pass\n",
    )
    assert found.text == (
        "from ezskiros import SkillDescription\n"
        "class Go(SkillDescription):\n    def description(self):\n        pass\n"
    )


def test_an_import_of_everything_comes_first() -> None:
    text = migrated("from skiros2_common.core.params import ParamTypes\nfrom our.skills import *")
    assert head(text)[0] == "from our.skills import *"
    assert "from ezskiros import SkillDescription, specified" in head(text)[1:]


def test_docstring_future_and_comments_keep_their_places() -> None:
    text = migrated(
        f'"""Doc."""\nfrom __future__ import annotations\n\n# ours\n{API}\n# more\nimport x'
    )
    assert head(text) == [
        '"""Doc."""',
        "from __future__ import annotations",
        "",
        "# ours",
        "from ezskiros import SkillDescription, specified",
        "from world import skiros",
        "# more",
        "import x",
    ]


def test_imports_that_are_there_take_more_names() -> None:
    text = migrated(
        f"from ezskiros import INFERRED\nfrom world import cora\n{API}", "\n\nx = cora\n"
    )
    assert head(text) == [
        "from ezskiros import INFERRED, SkillDescription, specified",
        "from world import cora, skiros",
    ]


@pytest.mark.parametrize(
    "imports", [f"{API}\nimport skiros", f"{API}\nskiros = 1", f"{API}\nfrom x import y as skiros"]
)
def test_a_namespace_whose_name_is_taken_gets_another(imports: str) -> None:
    text = migrated(imports)
    assert "from world import skiros as skiros_" in head(text)
    assert "Place: skiros_.Location" in text


def test_a_parameter_may_be_called_like_a_namespace() -> None:
    text = migrated(API, key="skiros")
    assert "specified(skiros)" in text
    assert "from world import skiros as skiros_" not in head(text)


def test_a_parameter_hides_no_namespace_that_its_conditions_use() -> None:
    typed = 'self.addPreCondition(self.getOnTypeCond("", "skiros", "skiros:Location"))'
    text = migrate_text("skills.py", f"{API}{SKILL.format(key='skiros')}        {typed}\n").text
    assert "from world import skiros as skiros_\n" in text
    assert "description(self, skiros: skiros_.Location)" in text
    assert "of_type(skiros, skiros_.Location)" in text


def test_a_parameter_hides_no_namespace_that_an_unclear_property_needs() -> None:
    weighed = [
        f'self.addPreCondition(self.getPropCond("", "{prefix}:Weight", "skiros", "<", 2.0, True))'
        for prefix in ("store", "skiros")
    ]
    body = "".join(f"        {each}\n" for each in weighed)
    text = migrate_text("skills.py", f"{API}{SKILL.format(key='skiros')}{body}").text
    assert "from world import skiros as skiros_, store\n" in text
    assert "store.Weight(skiros) < 2.0" in text
    assert "skiros_.Weight(skiros) < 2.0" in text


@pytest.mark.parametrize("rest", ["\n\nspecified = 1\n", "\n\ndef specified():\n    pass\n"])
def test_names_of_ours_that_are_taken_are_qualified(rest: str) -> None:
    text = migrated(API, rest)
    assert head(text) == ["import ezskiros", "from world import skiros"]
    assert "ezskiros.specified(Place)" in text


def test_a_parameter_may_be_called_like_a_function_of_ours() -> None:
    assert "ezskiros.specified(specified)" in migrated(API, key="specified")


def keyed(*keys: str) -> list[str]:
    """The parameters that these keys become: with comments each has a line of its own."""
    lines = "".join(
        f"        self.addParam({key!r}, 1.5, ParamTypes.Required)  # one\n" for key in keys
    )
    text = f"class Go(SkillDescription):\n    def createDescription(self):\n{lines}"
    found = migrate_text("skills.py", text)
    assert found.translated == ["Go"], found.diagnostics
    compile(found.text, "skills.py", "exec")
    return [line.partition(" = ")[0].strip() for line in found.text.split("\n") if "# one" in line]


@pytest.mark.parametrize(
    ("key", "name", "written"),
    [
        ("Start Pose", "StartPose", '"Start Pose"'),
        ("fail on timeout", "FailOnTimeout", '"fail on timeout"'),
        ("Max Angle (deg)", "MaxAngleDeg", '"Max Angle (deg)"'),
        ("On/Off", "OnOff", '"On/Off"'),
        ("object-1", "Object1", '"object-1"'),
        ("class", "Class", '"class"'),
        ("None", "ParameterNone", '"None"'),
        ("self", "Self", '"self"'),
        ("ezskiros", "Ezskiros", '"ezskiros"'),
        ("__private", "Private", '"__private"'),
        ("2nd", "Parameter2nd", '"2nd"'),
        ("?", "Parameter", '"?"'),
        ("\N{LATIN SMALL LIGATURE FI}x", "Fix", '"\N{LATIN SMALL LIGATURE FI}x"'),
        ("it's", "ItS", '"it\'s"'),
        ('so "said"', "SoSaid", "'so \"said\"'"),
        ("two\nlines", "TwoLines", '"two\\nlines"'),
        ("robot!", "Robot_2", '"robot!"'),
    ],
)
def test_a_key_that_is_no_name_gets_one(key: str, name: str, written: str) -> None:
    assert keyed(key) == [f"{name}: Annotated[float, Key({written})]"]


def test_names_for_keys_are_different() -> None:
    found = keyed("a b", "A B", "AB_2", "a_b", "OtherThing", "other thing", "more", "and more")
    assert [each.partition(":")[0] for each in found] == [
        *("AB", "AB_3", "AB_2", "a_b", "OtherThing", "OtherThing_2", "more", "AndMore")
    ]


def test_what_keys_need_is_imported() -> None:
    text = migrated(API, key="the place")
    assert head(text) == [
        "from typing import Annotated",
        "from ezskiros import Key, SkillDescription, specified",
        "from world import skiros",
    ]
    assert 'ThePlace: Annotated[skiros.Location, Key("the place")]' in text
    assert "specified(ThePlace)" in text
    text = migrated(f"from typing import Any\n{API}", "\n\nx: Any = 1\n", key="the place")
    assert head(text)[0] == "from typing import Annotated, Any"
    text = migrated(API, "\n\nAnnotated = 1\n", key="the place")
    assert head(text) == ["import typing", "import ezskiros", "from world import skiros"]
    assert 'typing.Annotated[skiros.Location, ezskiros.Key("the place")]' in text
    text = migrated(f"from typing import Annotated\n{API}", key="the place")
    assert 'ThePlace: Annotated[skiros.Location, Key("the place")]' in text
    assert head(text).count("from typing import Annotated") == 1


def test_a_file_without_descriptions_is_not_touched() -> None:
    text = f"{API}\n\n\nclass go(SkillBase):\n    def createDescription(self):\n        x = 1\n"
    assert migrate_text("skills.py", text).text == text


@pytest.mark.parametrize(
    ("label", "said", "is_true", "says"),
    [
        ("RobotAt", ("skiros:at", "Robot", "Place"), True, False),
        ("ArmHasEE", ("skiros:hasA", "Arm", "EE"), True, False),
        ("ObjectContained", ("skiros:contain", "Shelf", "Object"), True, False),
        ("StartContainsObj", ("skiros:contain", "StartLocation", "Object"), True, False),
        ("NotAt", ("skiros:at", "Robot", "Place"), False, False),
        ("NotAt", ("skiros:at", "Robot", "Place"), True, True),
        ("EmptyHanded", ("skiros:ContainerState", "Gripper", "Empty"), True, True),
        ("Holding", ("skiros:contain", "Gripper", "Object"), True, True),
        ("", (), True, False),
        ("C1", ("skiros:at",), True, False),
    ],
)
def test_labels(label: str, said: tuple[str, ...], is_true: bool, says: bool) -> None:
    assert says_more(label, said, is_true=is_true) is says


def test_properties_that_are_ambiguous_are_said_by_their_namespace() -> None:
    said = 'self.addPreCondition(self.getHasPropCond("", "skiros:{}", "Place", True))'
    lines = "".join(f"        {said.format(name)}\n" for name in ("Weight", "Height"))
    text = API + SKILL.format(key="Place") + lines
    found = migrate_text("skills.py", text, ambiguous={"Weight"}).text
    assert "+= skiros.Weight(Place)\n" in found
    assert "+= Place.Height\n" in found


def test_properties_of_several_namespaces_are_said_by_their_namespace() -> None:
    said = 'self.addPreCondition(self.getHasPropCond("", "{}", "Place", True))'
    names = ("skiros:Weight", "store:Weight", "skiros:Height")
    lines = "".join(f"        {said.format(name)}\n" for name in names)
    text = migrate_text("skills.py", API + SKILL.format(key="Place") + lines).text
    assert "+= skiros.Weight(Place)\n" in text
    assert "+= store.Weight(Place)\n" in text
    assert "+= Place.Height\n" in text
