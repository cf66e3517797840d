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


@pytest.mark.parametrize("rest", ["\n\nspecified = 1\n", "\n\ndef specified():\n    pass\n"])
def test_names_of_ours_that_are_taken_are_qualified(rest: str) -> None:
    text = migrated(API, rest)
    assert head(text) == ["import ezskiros", "from world import skiros"]
    assert "ezskiros.specified(Place)" in text


def test_a_parameter_may_be_called_like_a_function_of_ours() -> None:
    assert "ezskiros.specified(specified)" in migrated(API, key="specified")


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


def test_implementations_are_not_touched() -> None:
    text = (
        f"{API}\n\n\nclass go(SkillBase):\n    def createDescription(self):\n"
        '        self.setDescription(Go(), "go")\n'
        '        self.addParam("Extra", 1, ParamTypes.Required)\n'
    )
    found = migrate_text("skills.py", text)
    assert found.text == text
    assert not found.left


def test_properties_of_several_namespaces_are_said_by_their_namespace() -> None:
    said = 'self.addPreCondition(self.getHasPropCond("", "{}", "Place", True))'
    names = ("skiros:Weight", "store:Weight", "skiros:Height")
    lines = "".join(f"        {said.format(name)}\n" for name in names)
    text = migrate_text("skills.py", API + SKILL.format(key="Place") + lines).text
    assert "+= skiros.Weight(Place)\n" in text
    assert "+= store.Weight(Place)\n" in text
    assert "+= Place.Height\n" in text
