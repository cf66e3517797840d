"""Files with skills: what cannot be loaded is reported, and hides nothing else."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from ezskiros import session
from ezskiros.driver import Checked, check_paths
from ezskiros.ontology.load import VARIABLE
from support.ontologies import HALL
from support.skill_files import HEADER, checked, found, warned

SKILL = "class {name}(SkillDescription):\n    def description(self, P: skiros.Product):\n{body}\n"
FINE = SKILL.format(name="Fine", body="        self.pre_conditions += specified(P)")
WRONG = SKILL.format(name="Wrong", body="        self.pre_conditions += P.hasAA(P)")


@pytest.fixture(autouse=True)
def hall(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(VARIABLE, str(HALL))


def check(folder: Path, files: dict[str, str]) -> Checked:
    for name, text in files.items():
        path = folder / f"{name}.py"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return check_paths([folder])


@pytest.mark.parametrize(
    ("text", "code", "place"),
    [
        ("def f(:\n    pass", "EZS002", ":\n"),
        ("import not_there_at_all.part\n1 / 0", "EZS003", "1 / 0"),
        ("from .other import x", "EZS003", "from .other import x"),
        ("raise SystemExit(3)", "EZS003", "raise SystemExit(3)"),
        ("x = undefined", "EZS003", "undefined"),
    ],
)
def test_a_module_that_cannot_be_loaded_hides_no_other(
    tmp_path: Path, text: str, code: str, place: str
) -> None:
    result = check(tmp_path, {"a": text, "b": HEADER + WRONG})
    (first, second) = found(result)
    assert first[0] == code
    assert place.strip() in first[1]
    assert second == ("EZS301", "P.hasAA")
    assert [skill.name for skill in result.skills] == ["Wrong"]


def test_what_is_not_installed_is_stood_in_for(tmp_path: Path) -> None:
    text = (
        "import rospy\nimport vendor.arm as arm\nfrom geometry_msgs.msg import PoseStamped\n"
        "from skiros2_common.core.primitive import PrimitiveBase\n"
        "publisher = rospy.Publisher('/x', PoseStamped, queue_size=1)\n"
        "class primitive(PrimitiveBase):\n    pose = PoseStamped()\n"
        "    @arm.slowly\n    def execute(self):\n        return self.success(arm.SPEED)\n"
    )
    result = check(tmp_path, {"a": text + HEADER + FINE, "b": f"import rospy\n{HEADER}{WRONG}"})
    names = ["geometry_msgs", "rospy", "skiros2_common", "vendor"]
    assert sorted(text for code, text in warned(result) if code == "EZS004") == [
        *names[:2],
        *names[1:],
    ]
    assert found(result) == [("EZS301", "P.hasAA")]
    assert {skill.name for skill in result.skills} == {"Fine", "Wrong"}


def test_a_package_imports_its_own_modules(tmp_path: Path) -> None:
    files = {
        "lib/__init__": "",
        "lib/words": HEADER,
        "lib/one": f"from .words import *\n{FINE}",
        "lib/sub/__init__": "",
        "lib/sub/two": f"from ..words import *\nfrom lib.one import Fine\n{WRONG}",
    }
    result = check(tmp_path, files)
    assert found(result) == [("EZS301", "P.hasAA")]
    assert [skill.name for skill in result.skills] == ["Fine", "Wrong"]


def test_modules_of_one_name_in_two_folders_are_two(tmp_path: Path) -> None:
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        skill = SKILL.format(name=name.title(), body="        self.pre_conditions += specified(P)")
        (tmp_path / name / "skills.py").write_text(HEADER + skill)
    result = check_paths([tmp_path / "one", tmp_path / "two"])
    assert [skill.name for skill in result.skills] == ["One", "Two"]


def test_two_skills_of_one_name_are_reported(tmp_path: Path) -> None:
    result = check(tmp_path, {"a": HEADER + FINE, "b": HEADER + FINE})
    assert found(result) == [("EZS230", "Fine")]


def test_two_skills_of_one_name_in_two_libraries_are_reported_with_the_rule(tmp_path: Path) -> None:
    for name in ("first_library", "second_library"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").touch()
        done = "class fine(Fine.SkillBase):\n    def execute(self): return self.success()\n"
        (tmp_path / name / "skills.py").write_text(f"{HEADER}{FINE}\n\n{done}")
    result = check_paths([tmp_path / "first_library", tmp_path / "second_library"])
    assert found(result) == [("EZS230", "Fine"), ("EZS230", "fine")]
    for each in result.diagnostics:
        assert Path(each.primary.span.file.path).parent.name == "second_library"
        assert [Path(label.span.file.path).parent.name for label in each.labels] == [
            "first_library"
        ]
        rule = "SkiROS2 takes the definition of the library that comes first in `libraries_list`"
        assert rule in (each.help or "")


def test_a_nested_class_is_no_other_skill(tmp_path: Path) -> None:
    names = "class Names:\n    class Fine:\n        pass\n\n\n"
    assert found(check(tmp_path, {"a": HEADER + names + FINE})) == []


def test_a_path_that_leads_nowhere_is_reported(tmp_path: Path) -> None:
    result = check_paths([tmp_path / "nowhere.py"])
    assert [each.code for each in result.diagnostics] == ["EZS001"]


def test_files_without_a_skill_are_reported(tmp_path: Path) -> None:
    assert [code for code, _ in warned(check(tmp_path, {"a": "x = 1"}))] == ["EZS005"]


def test_skills_of_modules_of_one_name_are_distinguished(tmp_path: Path) -> None:
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "skills.py").write_text(f"# {name}\n{HEADER}{FINE}")
    (twice,) = check_paths([tmp_path / "one", tmp_path / "two"]).diagnostics
    places = [twice.primary.span, *(label.span for label in twice.labels)]
    assert [Path(place.file.path).parent.name for place in places] == ["two", "one"]


def test_packages_of_one_name_in_two_folders_are_two(tmp_path: Path) -> None:
    for name in ("one", "one_more"):
        skill = SKILL.format(name=name.title(), body="        self.pre_conditions += specified(P)")
        package = tmp_path / name / "lib"
        package.mkdir(parents=True)
        (package / "__init__.py").write_text("")
        (package / "skills.py").write_text(HEADER + skill)
    result = check_paths([tmp_path / "one_more", tmp_path / "one"])
    assert [skill.name for skill in result.skills] == ["One_More", "One"]


def test_libraries_know_themselves_what_to_do_without_a_module(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    library = tmp_path / "site" / "library_of_others.py"
    library.parent.mkdir()
    library.write_text("try:\n    import not_there\nexcept ImportError:\n    not_there = None\n")
    monkeypatch.syspath_prepend(library.parent)
    monkeypatch.setattr(session, "LIBRARIES", (*session.LIBRARIES, str(library.parent)))
    text = f"import library_of_others\nassert library_of_others.not_there is None\n{HEADER}{FINE}"
    result = check(tmp_path / "own", {"a": text})
    assert [(each.code, each.title) for each in result.diagnostics] == []


def test_a_stand_in_is_reported_where_it_is_imported(tmp_path: Path) -> None:
    text = f'"""Skills with rospy."""\n\nimport os.path, rospy\n{HEADER}{FINE}'
    (one,) = check(tmp_path, {"a": text}).diagnostics
    assert (one.code, one.primary.span.begin.line) == ("EZS004", 3)


def test_libraries_get_no_stand_ins_wherever_one_stands(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    library = tmp_path / "library"
    library.mkdir()
    text = "try:\n    import not_there\nexcept ImportError:\n    not_there = None\n"
    (library / "with_an_option.py").write_text(text)
    monkeypatch.setattr(session, "LIBRARIES", (f"{library}{os.sep}",))
    monkeypatch.syspath_prepend(library)
    monkeypatch.chdir(tmp_path)
    user = "import with_an_option\nassert with_an_option.not_there is None\n"
    result = check(tmp_path / "own", {"a": user + HEADER + FINE})
    assert (found(result), warned(result)) == ([], [])


def test_names_of_a_star_import_that_is_not_installed_are_explained() -> None:
    result = checked("from not_there_at_all.part import *\nclass Pick(Base): pass\n")
    (failed,) = (each for each in result.diagnostics if each.code == "EZS003")
    assert failed.primary.span.text == "Base"
    assert failed.help == (
        "`not_there_at_all.part` is not installed, so `import *` defines no names: "
        "import them one by one"
    )
