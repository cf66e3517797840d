"""`ezskiros export`: what the file says of skills, classes, trees and sources."""

from __future__ import annotations

import hashlib
import json
import shutil
from pathlib import Path
from typing import Any

import pytest

from ezskiros.export.sources import ExportedSource, digest_of
from ezskiros.skills.nodes import Decoration, Flow
from ezskiros.skills.permits import Permit
from ezskiros.skills.quantities import UNITS
from ezskiros.skills.uses import Used
from support import command_line
from support.exports import SCHEMA, export, named
from support.json_schema import faults
from support.ontologies import HALL, PREFIXES

EXAMPLES = Path(__file__).parents[3] / "examples"
WHITEBOARD = EXAMPLES / "whiteboard"
HEADER = """\
import enum
from ezskiros import *
from ezskiros.ontology import load
world = load()
cora, rparts, skiros, sumo = world.cora, world.rparts, world.skiros, world.sumo
"""


@pytest.fixture(scope="module")
def whiteboard(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    return export(WHITEBOARD / "skills", out=tmp_path_factory.mktemp("export") / "skills.json")


def of_texts(folder: Path, ontology: Path = HALL, **texts: str) -> dict[str, Any]:
    """The export of modules, by their names."""
    for name, text in texts.items():
        (folder / f"{name}.py").write_text(HEADER + text)
    paths = [folder / f"{name}.py" for name in texts]
    return export(*paths, out=folder / "skills.json", ontology=ontology)


def text_at(root: Path, place: dict[str, Any]) -> str:
    """The text at a place."""
    lines: list[str] = (root / place["path"]).read_text("utf-8").splitlines()
    assert place["line"] == place["end_line"]
    start, end = place["column"] - 1, place["end_column"] - 1
    line = lines[int(place["line"]) - 1]
    return line[int(start) : int(end)]


def test_the_example_is_exported_as_it_is_kept(tmp_path: Path) -> None:
    shutil.copytree(EXAMPLES / "pick_place", tmp_path / "pick_place")
    copy = tmp_path / "whiteboard"
    shutil.copytree(WHITEBOARD, copy)
    kept = (copy / "skills.json").read_bytes()
    export(copy / "skills", out=copy / "skills.json")
    assert (copy / "skills.json").read_bytes() == kept, "export it again, and look"


def test_order_and_folder_do_not_matter(tmp_path: Path) -> None:
    files = [WHITEBOARD / "skills" / f"{name}.py" for name in ("motions", "erasing")]
    first, second = tmp_path / "first.json", tmp_path / "second.json"
    export(*files, out=first)
    export(*files[::-1], out=second)
    assert first.read_bytes() == second.read_bytes()


def test_skills_are_reported_with_their_places(whiteboard: dict[str, Any]) -> None:
    skills = named(whiteboard["skills"])
    assert list(skills) == ["Drive", "Erase", "Reach", "Wipe"]
    wipe = skills["Wipe"]
    kept = json.loads((WHITEBOARD / "skills.json").read_text("utf-8"))
    place = named(kept["skills"])["Wipe"]
    assert text_at(WHITEBOARD, place["place"]) == "Wipe"
    assert [text_at(WHITEBOARD, each["place"]) for each in place["permits"]] == [
        "contact(Board)",
        'force(Board, "20 N")',
        'speed("0.2 m/s")',
    ]
    assert [(each["kind"], each["limit"]) for each in wipe["permits"]] == [
        ("contact", None),
        ("force", {"value": 20.0, "unit": "N", "si": 20.0}),
        ("speed", {"value": 0.2, "unit": "m/s", "si": 0.2}),
    ]
    assert wipe["permits"][0]["with"] == [{"parameter": "Board", "class": "office.Whiteboard"}]
    assert [(each["name"], each["type"]) for each in skills["Drive"]["uses"]] == [
        ("/cmd_vel", "geometry_msgs/Twist"),
        ("/move_base", "move_base_msgs/MoveBase"),
    ]
    kinds = {each["name"]: (each["kind"], each["type"]) for each in wipe["parameters"]}
    assert kinds["Sponge"] == ("inferred", "office.Sponge")


def test_classes_are_closed_and_properties_have_units(whiteboard: dict[str, Any]) -> None:
    classes = named(whiteboard["classes"])
    assert classes["office.GlassBoard"]["parents"] == ["office.Whiteboard"], "below a parameter's"
    assert "sumo.Object" in classes, "above a parameter's"
    assert "office.Person" not in classes, "no parameter can be one"
    assert all(parent in classes for each in classes.values() for parent in each["parents"])
    properties = named(whiteboard["properties"])
    assert properties["office.Withstands"]["unit"] == "N"
    assert properties["office.Withstands"]["of"] == ["office.Whiteboard"]
    assert properties["office.Clean"]["type"] == "bool"
    assert properties["skiros.Weight"]["of"] == [], "the ontology does not say"


def test_trees_tell_what_children_get(whiteboard: dict[str, Any]) -> None:
    (tree,) = named(whiteboard["skills"])["Erase"]["trees"]
    (root,) = tree["children"]
    assert (tree["implementation"], root["control"]) == ("erase", "serialstar")
    assert [(each["skill"], each["arguments"].get("Target")) for each in root["children"]] == [
        ("Drive", "Board"),
        ("Reach", None),
        ("Wipe", None),
    ]
    assert root["children"][2]["arguments"]["Board"] == "Board"


def test_sources_are_the_modules_and_the_ontology(tmp_path: Path) -> None:
    (tmp_path / "limits.py").write_text("LIMIT = '3 N'\n")
    skills = (
        "from limits import LIMIT\nclass A(SkillDescription):\n"
        "    def description(self, Object: skiros.Product):\n"
        "        self.permits += force(Object, LIMIT)\n"
    )
    found = of_texts(tmp_path, a=skills)
    names = {Path(each["path"]).name for each in found["sources"]}
    assert {"a.py", "limits.py", "skiros.ttl"} <= names
    assert "skiros_relations.ttl" not in names, "EzSkiROS itself is no source"
    for each in found["sources"]:
        content = (tmp_path / each["path"]).read_bytes()
        assert each["sha256"] == hashlib.sha256(content).hexdigest()
    assert found["digest"] == digest_of(ExportedSource(**each) for each in found["sources"])


BRANCHES = """
class Mode(enum.Enum):
    SLOW = 1

class Step(SkillDescription):
    def description(self, Speed: float, How: Mode, Text: str = "it's"):
        pass

class step(Step.SkillBase):
    def execute(self):
        return self.success("")

class Twice(SkillDescription):
    def description(self, Speed: float, Fast: bool):
        pass

class twice(Twice.SkillBase):
    def expandBT(self, params):
        if params.Fast:
            self.retry(Step(Speed=params.Speed * 2, How=Mode.SLOW), 3)
        else:
            self.serial(
                Step(Speed=0.5, How=Mode.SLOW, Text="'"), self.inverter(Step(How=Mode.SLOW))
            )
"""


def test_each_way_is_a_tree(tmp_path: Path) -> None:
    found = of_texts(tmp_path, a=BRANCHES)
    skills = named(found["skills"])
    fast, slow = (tree["children"][0] for tree in skills["Twice"]["trees"])
    assert fast["control"] == "retry"
    assert fast["children"][0]["arguments"] == {"Speed": None, "How": "Mode.SLOW"}
    first, inverter = slow["children"]
    assert first["arguments"] == {"Speed": "0.5", "How": "Mode.SLOW", "Text": '"\'"'}
    assert inverter["control"] == "inverter"
    assert inverter["children"][0]["arguments"] == {"Speed": "Speed", "How": "Mode.SLOW"}
    types = {each["name"]: each["type"] for each in skills["Step"]["parameters"]}
    assert types == {"Speed": "float", "How": "enum", "Text": "str"}


LIMITS = """
class Step(SkillDescription):
    def description(self, Far: bool = True):
        pass

class step(Step.SkillBase):
    def execute(self):
        return self.success("")

class Patient(SkillDescription):
    def description(self, Weight: float, Patience: float = 2.5, Tries: int = 3):
        pass

class patient(Patient.SkillBase):
    def expandBT(self, params):
        self.serialstar(
            self.timeout(Step(), 4.0),
            self.timeout(Step(), params.Patience),
            self.timeout(Step(), params.Patience + 1),
            self.retry(Step(), 2),
            self.retry(Step(), params.Tries),
            self.inverter(Step()),
        )
"""


def test_limits_are_numbers_or_parameters(tmp_path: Path) -> None:
    """The key is missing where a number is computed when the skill runs."""
    skills = named(of_texts(tmp_path, a=LIMITS)["skills"])
    (sequence,) = skills["Patient"]["trees"][0]["children"]
    limits = [(e["control"], e.get("seconds"), e.get("tries")) for e in sequence["children"]]
    assert limits == [
        ("timeout", 4.0, None),
        ("timeout", "Patience", None),
        ("timeout", None, None),
        ("retry", None, 2),
        ("retry", None, "Tries"),
        ("inverter", None, None),
    ]
    defaults = {e["name"]: e["default"] for e in skills["Patient"]["parameters"]}
    assert defaults == {"Weight": None, "Patience": "2.5", "Tries": "3"}
    assert skills["Step"]["parameters"][0]["default"] == "True"


DERIVED = """
class Move(SkillDescription):
    def description(self, Object: skiros.Product):
        self.permits += contact(sumo.Object)

class Push(Move):
    pass

class Shove(Push):
    def description(self, Object: skiros.Product):
        super().description(Object)
        self.permits += speed("90 deg/s")
"""


def test_parents_are_reported_nearest_first(tmp_path: Path) -> None:
    skills = named(of_texts(tmp_path, a=DERIVED)["skills"])
    assert [skills[name]["parents"] for name in ("Move", "Push", "Shove")] == [
        [],
        ["Move"],
        ["Push", "Move"],
    ]
    assert skills["Push"]["permits"][0]["with"] == [{"parameter": None, "class": "sumo.Object"}]
    assert [each["kind"] for each in skills["Shove"]["permits"]] == ["contact", "speed"]


def test_a_class_that_only_a_permission_names_is_reported(tmp_path: Path) -> None:
    text = (
        "class A(SkillDescription):\n    def description(self, X: int):\n"
        "        self.permits += contact(skiros.Container)\n"
    )
    found = of_texts(tmp_path, a=text)
    assert "skiros.Container" in named(found["classes"])


def test_names_are_those_of_python(tmp_path: Path) -> None:
    ontology = tmp_path / "test.ttl"
    ontology.write_text(
        PREFIXES + ":Large-Box a owl:Class . :Large_Box a owl:Class ."
        ' :Mass a owl:DatatypeProperty ; rdfs:domain :Large_Box ; :unit "g" .'
    )
    text = (
        "test = world.test\nclass A(SkillDescription):\n"
        '    def description(self, One: test.Large_Box, Other: test["Large-Box"]):\n'
        "        self.permits += contact(One, Other)\n"
    )
    (tmp_path / "a.py").write_text(HEADER.replace("cora, rparts, skiros, sumo =", "#") + text)
    found = export(tmp_path / "a.py", out=tmp_path / "skills.json", ontology=ontology)
    assert list(named(found["classes"])) == ["test.Large_Box", "test.Large_Box_"]
    (skill,) = found["skills"]
    assert [each["class"] for each in skill["permits"][0]["with"]] == [
        "test.Large_Box",
        "test.Large_Box_",
    ]
    assert named(found["properties"])["test.Mass"]["unit"] == "g"


def test_nothing_is_written_if_there_are_errors(tmp_path: Path) -> None:
    (tmp_path / "a.py").write_text(HEADER + "class A(SkillDescription):\n    pass\n")
    out = tmp_path / "skills.json"
    out.write_text("before")
    done = command_line.run(
        "ezskiros", "export", "a.py", "-o", out, "--force", "--ontology", HALL, folder=tmp_path
    )
    assert done.returncode == 1
    assert "error[EZS201]" in done.stdout
    assert out.read_text() == "before"


def test_errors_of_skills_of_other_files_are_reported(tmp_path: Path) -> None:
    (tmp_path / "other.py").write_text(
        HEADER + "class B(SkillDescription):\n    def description(self, X: int):\n"
        "        self.permits += contact(3)\n\nclass b(B.SkillBase):\n    def execute(self):\n"
        '        return self.success("")\n'
    )
    (tmp_path / "a.py").write_text(
        HEADER + "from other import B\nclass A(SkillDescription):\n"
        "    def description(self, X: int):\n        pass\n\nclass a(A.SkillBase):\n"
        "    def expandBT(self, params):\n        self.serial(B())\n"
    )
    out = tmp_path / "skills.json"
    done = command_line.run(
        "ezskiros", "export", "a.py", "-o", out, "--ontology", HALL, folder=tmp_path
    )
    assert (done.returncode, out.exists()) == (1, False)
    assert "error[EZS251]" in done.stdout


def test_a_file_that_cannot_be_written_is_reported_first(tmp_path: Path) -> None:
    out = tmp_path / "nowhere" / "skills.json"
    done = command_line.run("ezskiros", "export", "a.py", "-o", out)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"ezskiros: cannot write {out}: no such file or directory\n"


def test_the_schema_knows_all_words() -> None:
    known = SCHEMA["$defs"]
    assert known["unit"]["enum"] == [*UNITS]
    controls = {each.value.lower() for each in (*Flow, *Decoration)}
    assert set(known["node"]["anyOf"][1]["properties"]["control"]["enum"]) == controls
    permits = known["permission"]["properties"]["kind"]["enum"]
    assert set(permits) == {each.value for each in Permit}
    uses = known["skill"]["properties"]["uses"]["items"]["properties"]["kind"]["enum"]
    assert set(uses) == {each.value for each in Used}


def test_the_schema_refuses_what_is_not_in_it(whiteboard: dict[str, Any]) -> None:
    assert faults(whiteboard, SCHEMA) == []
    assert faults({**whiteboard, "more": 1}, SCHEMA) != []
    assert faults({**whiteboard, "version": True}, SCHEMA) != []
    skill = {**whiteboard["skills"][0], "doc": None}
    assert faults({**whiteboard, "skills": [skill]}, SCHEMA) != []
