"""The permissions and uses of a skill, and mistakes in them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from ezskiros.hosts.skiros2_form import form_of
from ezskiros.migrate.files import migrate_paths
from ezskiros.skills.interface import SkillInterface
from support.skill_files import HEADER, checked, described, found, warned


def only(text: str) -> SkillInterface:
    result = described(text)
    assert found(result) == []
    (skill,) = result.skills
    return skill


@pytest.mark.parametrize(
    ("expression", "kind", "individuals", "limit"),
    [
        ("contact(Object)", "contact", [("Object", "skiros.Product")], None),
        (
            "contact(Object, skiros.Location)",
            "contact",
            [("Object", "skiros.Product"), (None, "skiros.Location")],
            None,
        ),
        ('closeness(Object, "30 cm")', "closeness", [("Object", "skiros.Product")], (30, 0.3)),
        ('speed("36 km/h")', "speed", [], (36, 10.0)),
        ('speed("1e-1m/s")', "speed", [], (0.1, 0.1)),
        ('force(Object, " 0.02 kN ")', "force", [("Object", "skiros.Product")], (0.02, 20.0)),
    ],
)
def test_a_permission_says_what_is_written(
    expression: str,
    kind: str,
    individuals: list[tuple[str | None, str]],
    limit: tuple[float, float] | None,
) -> None:
    (permission,) = only(f"self.permits += {expression}").permits
    assert permission.kind.value == kind
    assert [
        (each.parameter, repr(each.owl_class)) for each in permission.individuals
    ] == individuals
    given = permission.limit
    assert (given and (given.value, given.si)) == limit
    assert permission.span.text == expression


@pytest.mark.parametrize(
    ("expression", "use"),
    [
        ('topic("/cmd_vel", "geometry_msgs/Twist")', ("topic", "/cmd_vel", "geometry_msgs/Twist")),
        ('topic("/a/3d", "std_msgs/msg/Bool")', ("topic", "/a/3d", "std_msgs/Bool")),
        ('server("/move_base")', ("server", "/move_base", None)),
        (
            'server("/move_base", "move_base_msgs/MoveBase")',
            ("server", "/move_base", "move_base_msgs/MoveBase"),
        ),
    ],
)
def test_a_use_says_what_is_written(expression: str, use: tuple[str, str, str | None]) -> None:
    (given,) = only(f"self.uses += {expression}").uses
    assert (given.kind.value, given.name, given.type) == use


@pytest.mark.parametrize(
    ("line", "code", "text"),
    [
        ("self.permits += Object", "EZS250", "Object"),
        ("self.permits += Object.Weight > 3", "EZS250", "Object.Weight > 3"),
        ('self.permits += server("/a")', "EZS250", 'server("/a")'),
        ('self.permits += contact("Object")', "EZS251", 'contact("Object")'),
        ("self.permits += contact(Object, 3)", "EZS251", "contact(Object, 3)"),
        ("self.permits += contact(skiros.at)", "EZS251", "contact(skiros.at)"),
        ("self.permits += force(Object, 30)", "EZS252", "force(Object, 30)"),
        ('self.permits += force(Object, "N")', "EZS252", 'force(Object, "N")'),
        ('self.permits += force(Object, "30")', "EZS252", 'force(Object, "30")'),
        ('self.permits += force(Object, "\u0663 N")', "EZS252", 'force(Object, "\u0663 N")'),
        ('self.permits += force(Object, "30 n")', "EZS253", 'force(Object, "30 n")'),
        ('self.permits += force(Object, "3 N N")', "EZS253", 'force(Object, "3 N N")'),
        ('self.permits += speed("3 m")', "EZS254", 'speed("3 m")'),
        ('self.permits += closeness(Object, "3 deg")', "EZS254", 'closeness(Object, "3 deg")'),
        ('self.permits += force(Object, "nan N")', "EZS255", 'force(Object, "nan N")'),
        ('self.permits += force(Object, "-Infinity N")', "EZS255", 'force(Object, "-Infinity N")'),
        ('self.permits += force(Object, "1e999 N")', "EZS255", 'force(Object, "1e999 N")'),
        ('self.permits += force(Object, "1e308 kN")', "EZS255", 'force(Object, "1e308 kN")'),
        ('self.permits += force(Object, "-0 N")', "EZS255", 'force(Object, "-0 N")'),
        ("self.uses += 3", "EZS256", "3"),
        ("self.uses += contact(Object)", "EZS256", "contact(Object)"),
        ('self.uses += server("move_base")', "EZS257", 'server("move_base")'),
        ('self.uses += server("~/go")', "EZS257", 'server("~/go")'),
        ('self.uses += server("/a//b")', "EZS257", 'server("/a//b")'),
        ('self.uses += server("/a/")', "EZS257", 'server("/a/")'),
        ('self.uses += server("/\u00e9")', "EZS257", 'server("/\u00e9")'),
        ('self.uses += server("/a\\n")', "EZS257", 'server("/a\\n")'),
        ("self.uses += server(3)", "EZS257", "server(3)"),
        ('self.uses += server("/" + "a" * 255)', "EZS257", 'server("/" + "a" * 255)'),
        ('self.uses += topic("/a", None)', "EZS258", 'topic("/a", None)'),
        ('self.uses += topic("/a", "Twist")', "EZS258", 'topic("/a", "Twist")'),
        ('self.uses += server("/a", "a/b/C")', "EZS258", 'server("/a", "a/b/C")'),
        ("self.permits = contact(Object)", "EZS209", "self.permits"),
        ("self.permit += contact(Object)", "EZS212", "self.permit"),
        ("self.permits += contact(Objekt)", "EZS213", "Objekt"),
        ('self.uses.append(server("/a"))', "EZS215", "self.uses.append"),
        ("self.permits += contact(skiros.Prodct)", "EZS111", "skiros.Prodct"),
        ("self.pre_conditions += contact(Object)", "EZS309", "contact(Object)"),
    ],
)
def test_each_mistake_is_reported_at_its_place(line: str, code: str, text: str) -> None:
    result = described(f"{line}\nself.permits += contact(Place)")
    assert found(result) == [(code, text)]
    (skill,) = result.skills
    assert skill.permits[-1].individuals[0].parameter == "Place", "what comes after it is looked at"


@pytest.mark.parametrize(
    ("line", "code"),
    [
        ("self.permits += force(Object, Limit)", "EZS252"),
        ('self.permits += force(Object, f"{Limit} N")', "EZS252"),
        ('self.uses += server("/" + Name)', "EZS257"),
        ("if Limit > 3:\n    self.permits += contact(Object)", "EZS223"),
        ('if Limit > 3:\n    self.uses += server("/a")', "EZS223"),
    ],
)
def test_nothing_of_it_may_depend_on_a_value(line: str, code: str) -> None:
    result = described(line, "Object: skiros.Product, Limit: float, Name: str")
    assert [each for each, _ in found(result)] == [code]


DERIVED = """
class Move(SkillDescription):
    def description(self, Object: skiros.Product):
        self.permits += speed("0.2 m/s")
        self.uses += topic("/cmd_vel", "geometry_msgs/Twist")

class Push(Move):
    def description(self, Object: skiros.Product):
        super().description(Object)
        self.permits += contact(Object)

class Shove(Push):
    pass
"""


def test_what_is_derived_permits_and_uses_it_too() -> None:
    result = checked(HEADER + DERIVED)
    assert found(result) == []
    permitted = {each.name: [p.kind.value for p in each.permits] for each in result.skills}
    assert permitted == {
        "Move": ["speed"],
        "Push": ["speed", "contact"],
        "Shove": ["speed", "contact"],
    }
    assert all([use.name for use in each.uses] == ["/cmd_vel"] for each in result.skills)


IMPLEMENTED = """
class Push(SkillDescription):
    def description(self, Object: skiros.Product):
        self.permits += contact(Object)

class push(Push.SkillBase):
    def conditions(self, Object):
        self.pre_conditions += Object.Weight
        self.permits += force(Object, "3 N")
        self.uses += server("/a")

    def execute(self):
        return self.success("")
"""


def test_skiros2_sees_nothing_of_it() -> None:
    result = checked(
        HEADER
        + DERIVED
        + DERIVED.replace("Move", "Other")
        .replace('        self.permits += speed("0.2 m/s")\n', "")
        .replace(
            '        self.uses += topic("/cmd_vel", "geometry_msgs/Twist")\n', "        pass\n"
        )
        .partition("class Push")[0]
    )
    assert found(result) == []
    ontology = result.library.ontology()
    assert ontology is not None
    forms = {each.name: form_of(each, ontology.model) for each in result.skills}
    assert replace(forms["Move"], name="") == replace(forms["Other"], name="")


def test_migrate_leaves_it_as_it_is(tmp_path: Path) -> None:
    path = tmp_path / "skills.py"
    path.write_text(HEADER + DERIVED + IMPLEMENTED)
    (migrated,) = migrate_paths([path]).files
    assert not migrated.is_changed


def test_an_implementation_adds_none() -> None:
    result = checked(HEADER + IMPLEMENTED)
    assert found(result) == [
        ("EZS563", 'self.permits += force(Object, "3 N")'),
        ("EZS563", 'self.uses += server("/a")'),
    ]


def test_a_parameter_that_is_permitted_something_is_used() -> None:
    unused = "EZS420", "Object"
    assert unused not in warned(described("self.permits += contact(Object)"))
    assert unused in warned(described("self.permits += contact(Gripper)"))
