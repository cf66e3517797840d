"""Skills of several files, which name each other's: what is imported, and from where."""

from __future__ import annotations

from pathlib import Path

import pytest

from dslkit.diagnostics import Severity
from ezskiros.driver import Checked, check_paths
from ezskiros.migrate.files import Migration, migrate_paths

DRIVE = """\
from skiros2_skill.core.skill import SkillDescription
from skiros2_common.core.params import ParamTypes
from skiros2_common.core.world_element import Element


class Drive(SkillDescription):
    def createDescription(self):
        self.addParam("Target", Element("skiros:Location"), ParamTypes.Required)
"""
DELIVER = DRIVE.replace("Drive", "Deliver")
PRIMITIVE = """

class drive(PrimitiveBase):
    def createDescription(self):
        self.setDescription(Drive(), self.__class__.__name__)

    def execute(self):
        return self.success("done")
"""
COMPOUND = """

class deliver(SkillBase):
    def createDescription(self):
        self.setDescription(Deliver(), self.__class__.__name__)

    def expand(self, skill):
        skill(self.skill("Drive", "drive"))
"""
OTHER_WAY = (
    COMPOUND.replace('"Drive", "drive"', '"Deliver", "deliver"')
    .replace("Deliver()", "Drive()")
    .replace("class deliver", "class drive_by_delivering")
)
IMPORT_BASE = "from skiros2_skill.core.skill import SkillBase\n"
IMPORT_PRIMITIVE = "from skiros2_common.core.primitive import PrimitiveBase\n"
IMPORT_THREAD = "from skiros2_common.core.primitive_thread import PrimitiveThreadBase\n"
ONTOLOGY = """\
@prefix owl: <http://www.w3.org/2002/07/owl#> .
<http://example.org/skiros.owl#Location> a owl:Class .
<http://example.org/sumo.owl#Agent> a owl:Class .
"""
WORLD = """\
from pathlib import Path

from ezskiros.ontology import load

globals().update(load(Path(__file__).with_name("all.ttl")).namespaces)
"""


def written(folder: Path, **texts: str) -> Path:
    """A package with modules."""
    package = folder / "lib"
    package.mkdir()
    for name, text in {"__init__": "", **texts}.items():
        (package / f"{name}.py").write_text(text)
    return package


def migrated(package: Path) -> tuple[Migration, dict[str, str]]:
    """The migration of a package, and the new texts of its modules, which are written."""
    found = migrate_paths([package], ".world")
    for each in found.files:
        each.write()
    return found, {each.path.stem: each.path.read_text() for each in found.files}


def checked(package: Path) -> Checked:
    """The check of a package, which gets a world module."""
    (package / "all.ttl").write_text(ONTOLOGY)
    (package / "world.py").write_text(WORLD)
    return check_paths([package])


def errors(found: Checked) -> list[str]:
    wrong = [each for each in found.diagnostics if each.severity is Severity.ERROR]
    return [f"{each.code}: {each.title}" for each in wrong]


def test_skills_that_another_file_describes(tmp_path: Path) -> None:
    package = written(
        tmp_path,
        described=DRIVE + DELIVER.partition("\n\n\n")[2].join(["\n\n", ""]),
        driving=f"{IMPORT_PRIMITIVE}from .described import Drive\n{PRIMITIVE}",
        delivering=f"{IMPORT_BASE}from .described import Deliver\n{COMPOUND}",
    )
    found, texts = migrated(package)
    assert not found.diagnostics
    assert texts["driving"].startswith(
        "from .described import Drive\n\n\nclass drive(Drive.SkillBase):\n    def execute(self):\n"
    )
    assert texts["delivering"] == (
        "from .described import Deliver, Drive\n\n\n"
        "class deliver(Deliver.SkillBase):\n"
        "    def expandBT(self, params):\n"
        "        self.serialstar(Drive.drive())\n"
    )
    result = checked(package)
    assert errors(result) == []
    assert [each.implementation for each in result.trees] == ["deliver"]


def test_a_child_that_another_file_describes_is_imported(tmp_path: Path) -> None:
    package = written(
        tmp_path,
        driving=f"{IMPORT_PRIMITIVE}{DRIVE}{PRIMITIVE}",
        delivering=f"{IMPORT_BASE}{DELIVER}{COMPOUND}",
    )
    found, texts = migrated(package)
    assert not found.diagnostics
    assert "\nfrom .driving import Drive\n" in texts["delivering"].partition("class ")[0]
    assert "delivering" not in texts["driving"]
    assert errors(checked(package)) == []


def test_a_child_whose_name_means_something_else_here(tmp_path: Path) -> None:
    package = written(
        tmp_path,
        driving=f"{IMPORT_PRIMITIVE}{DRIVE}{PRIMITIVE}",
        delivering=f"{IMPORT_BASE}{DELIVER}{COMPOUND}\n\nDrive = 3\n",
    )
    _, texts = migrated(package)
    assert "from .driving import Drive as Drive_\n" in texts["delivering"]
    assert "self.serialstar(Drive_.drive())\n" in texts["delivering"]
    assert errors(checked(package)) == []


def test_files_that_would_import_each_other(tmp_path: Path) -> None:
    package = written(
        tmp_path,
        driving=f"{IMPORT_BASE}{IMPORT_PRIMITIVE}{DRIVE}{PRIMITIVE}{OTHER_WAY}",
        delivering=f"{IMPORT_BASE}{DELIVER}{COMPOUND}",
    )
    found, texts = migrated(package)
    assert not found.diagnostics
    assert (
        "    def expandBT(self, params):\n"
        "        from .delivering import Deliver\n"
        "        self.serialstar(Deliver.deliver())\n"
    ) in texts["driving"]
    assert (
        "    def expandBT(self, params):\n"
        "        from .driving import Drive\n"
        "        self.serialstar(Drive.drive())\n"
    ) in texts["delivering"]
    for text in texts.values():
        head = text.partition("\nclass ")[0]
        assert "import Drive" not in head
        assert "import Deliver" not in head
    result = checked(package)
    assert {each.implementation for each in result.trees} == {"deliver", "drive_by_delivering"}
    assert not [each for each in errors(result) if "import" in each]


def test_a_long_import_inside_a_tree(tmp_path: Path) -> None:
    name = "all_the_many_ways_of_driving_in_the_hall_and_outside_and_in_between_of_them"
    package = written(
        tmp_path,
        **{name: f"{IMPORT_PRIMITIVE}from . import delivering\n{DRIVE}{PRIMITIVE}"},
        delivering=f"{IMPORT_BASE}{DELIVER}{COMPOUND}",
    )
    _, texts = migrated(package)
    lines = [f"        from .{name} import (", "            Drive,", "        )"]
    assert "\n".join(lines) in texts["delivering"]
    assert errors(checked(package)) == []


def test_three_files_in_a_circle(tmp_path: Path) -> None:
    def compound(own: str, child: str) -> str:
        description = DRIVE.replace("Drive", own)
        implementation = COMPOUND.replace("deliver", own.lower()).replace("Deliver", own)
        named = f'"{child}", "{child.lower()}"'
        return f"{IMPORT_BASE}{description}{implementation}".replace('"Drive", "drive"', named)

    package = written(
        tmp_path,
        first=compound("First", "Second"),
        second=compound("Second", "Third"),
        third=compound("Third", "First"),
    )
    found, texts = migrated(package)
    assert not found.diagnostics
    for own, child in (("first", "second"), ("second", "third"), ("third", "first")):
        inside = f"        from .{child} import {child.title()}\n        self.serialstar"
        assert inside in texts[own]
    assert {each.implementation for each in checked(package).trees} == {"first", "second", "third"}


def test_a_file_that_imports_the_one_that_would_import_it(tmp_path: Path) -> None:
    package = written(
        tmp_path,
        driving=f"{IMPORT_PRIMITIVE}from . import delivering\n{DRIVE}{PRIMITIVE}",
        delivering=f"{IMPORT_BASE}{DELIVER}{COMPOUND}",
    )
    _, texts = migrated(package)
    assert "        from .driving import Drive\n        self.serialstar" in texts["delivering"]
    assert errors(checked(package)) == []


@pytest.mark.parametrize(
    "given", ['remap={"Robot": "Robot"}', 'specify={"Robot": self.params["Robot"].value}']
)
def test_a_robot_that_another_file_speaks_of_is_written_out(tmp_path: Path, given: str) -> None:
    compound = COMPOUND.replace('"drive")', f'"drive", {given})')
    package = written(
        tmp_path,
        driving=f"{IMPORT_PRIMITIVE}{DRIVE}{PRIMITIVE}",
        described=DELIVER,
        delivering=f"{IMPORT_BASE}from .described import Deliver\n{compound}",
    )
    found, texts = migrated(package)
    assert not found.diagnostics
    assert "Target: skiros.Location, Robot: INFERRED[sumo.Agent])" in texts["driving"]
    assert "Target: skiros.Location, Robot: INFERRED[sumo.Agent])" in texts["described"]
    assert "Drive.drive(Robot=params.Robot)" in texts["delivering"]
    assert errors(checked(package)) == []


def test_a_robot_that_only_a_child_needs_is_that_of_the_compound(tmp_path: Path) -> None:
    robot = '        self.addParam("Robot", Element("sumo:Agent"), ParamTypes.Required)\n'
    package = written(
        tmp_path,
        driving=f"{IMPORT_PRIMITIVE}{DRIVE}{robot}{PRIMITIVE}",
        delivering=f"{IMPORT_BASE}{DELIVER}{COMPOUND}",
    )
    found, texts = migrated(package)
    assert not found.diagnostics
    assert "Target: skiros.Location, Robot: INFERRED[sumo.Agent])" in texts["delivering"]
    assert errors(checked(package)) == []


def test_a_robot_that_a_new_skill_needs_is_that_of_the_compound(tmp_path: Path) -> None:
    new = """\
from ezskiros import INFERRED, SkillDescription
from .world import skiros, sumo


class Drive(SkillDescription):
    def description(self, Target: skiros.Location, Robot: {robot}): ...


class drive(Drive.SkillBase):
    def execute(self):
        return self.success("done")
"""
    for folder, robot in (("needed", "sumo.Agent"), ("found", "INFERRED[sumo.Agent]")):
        (tmp_path / folder).mkdir()
        package = written(
            tmp_path / folder,
            driving=new.format(robot=robot),
            delivering=f"{IMPORT_BASE}{DELIVER}{COMPOUND}",
        )
        _, texts = migrated(package)
        is_needed = folder == "needed"
        assert ("Robot: INFERRED[sumo.Agent])" in texts["delivering"]) == is_needed
        assert errors(checked(package)) == []


def test_an_implementation_of_a_skill_that_another_file_leaves(tmp_path: Path) -> None:
    package = written(
        tmp_path,
        driving=DRIVE.replace('Element("skiros:Location")', "dict"),
        primitive=f"{IMPORT_PRIMITIVE}from .driving import Drive\n{PRIMITIVE}",
        delivering=f"{IMPORT_BASE}{DELIVER}{COMPOUND}",
    )
    found, texts = migrated(package)
    assert [each.code for each in found.diagnostics] == ["EZS704", "EZS737"]
    left = "is not translated because of EZS704\n"
    assert f"# EZS721: `Drive`, which this class implements, {left}" in texts["primitive"]
    assert f"# EZS722: the child `Drive` {left}" in texts["delivering"]
    assert "class Deliver(SkillDescription):\n    def description(" in texts["delivering"]


def test_callers_of_an_implementation_that_is_left(tmp_path: Path) -> None:
    left = PRIMITIVE.replace("(PrimitiveBase)", "(PrimitiveThreadBase)")
    package = written(
        tmp_path,
        driving=f"{IMPORT_THREAD}{DRIVE}{left}",
        delivering=f"{IMPORT_BASE}{DELIVER}{COMPOUND}",
    )
    found, texts = migrated(package)
    assert [each.code for each in found.diagnostics] == ["EZS733"]
    assert "self.serialstar(Drive.drive())" in texts["delivering"]
    assert [each[:6] for each in errors(checked(package))] == ["EZS562"]
