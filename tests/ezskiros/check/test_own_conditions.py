"""Pre-conditions that only one implementation has: which are wrong, and what counts on them."""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros.driver import Checked
from support.ontologies import PREFIXES
from support.skill_files import HEADER, checked, found

SKILLS = (
    HEADER
    + """

class Take(SkillDescription):
    def description(self, Object: skiros.Product, Force: float = 1.0, Hard: bool = True):
        self.pre_conditions += Object.Weight < 9.0


class take_light(Take.SkillBase):
    def conditions(self, {parameters}):
        {lines}

    def execute(self):
        return self.success(f"{{self.params.Object}} {{self.params.Force}} {{self.params.Hard}}")


class Place(SkillDescription):
    def description(self, Object: skiros.Product):
        self.post_conditions += Object.Weight == 5.0


class place(Place.SkillBase):
    def execute(self):
        return self.success(f"{{self.params.Object}}")


class Task(SkillDescription):
    def description(self, Object: skiros.Product):
        self.pre_conditions += Object.Weight == 2.0


class task(Task.SkillBase):
    def expandBT(self, params):
        self.serialstar({tree})
"""
)


def reported(
    lines: str, tree: str = "Place(Object=params.Object)", parameters: str = "Object"
) -> Checked:
    """The findings for the lines of `conditions` of `take_light`."""
    text = lines.replace("\n", "\n        ")
    return checked(SKILLS.format(lines=text, tree=tree, parameters=parameters))


@pytest.mark.parametrize(
    ("lines", "parameters", "code", "place"),
    [
        ("self.pre_conditions += Object.Wait == 2.0", "Object", "EZS301", "Object.Wait"),
        ("self.pre_conditions += Object.Weight == 'a'", "Object", "EZS403", "'a'"),
        ("self.pre_conditions += ~(Object.Weight < 9.0)", "Object", "EZS411",
         "~(Object.Weight < 9.0)"),
        ("self.pre_conditions += Objekt.Weight", "Objekt", "EZS508", "Objekt"),
        ("self.pre_conditions += Object.Weight", "", "EZS213", "Object"),
        ("self.pre_conditions += 3", "Object", "EZS309", "3"),
        ("self.pre_conditions = Object.Weight", "Object", "EZS209",
         "def conditions(self, Object):"),
        ("self.hold_conditions += Object.Weight", "Object", "EZS563",
         "self.hold_conditions += Object.Weight"),
        ("self.post_conditions += ~Object.Weight", "Object", "EZS563",
         "self.post_conditions += ~Object.Weight"),
        ("if Hard:\n    self.pre_conditions += Object.Weight", "Object, Hard", "EZS223", "Hard"),
        ("raise ValueError('no')", "Object", "EZS220", "raise ValueError('no')"),
        ("open('x', 'w')", "Object", "EZS221", "open('x', 'w')"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_reported_where_it_is(
    lines: str, parameters: str, code: str, place: str
) -> None:
    assert found(reported(lines, parameters=parameters)) == [(code, place)]


@pytest.mark.parametrize(
    ("lines", "help"),
    [
        ("Object.Weight == 2.0", "write `self.pre_conditions += ...`, or delete the method"),
        ("yield Object.Weight", "remove `yield`: yielded values are ignored"),
    ],
)  # fmt: skip
def test_a_method_that_adds_nothing_is_reported(lines: str, help: str) -> None:
    (only,) = reported(lines).diagnostics
    assert (only.code, only.help) == ("EZS565", help)


def test_a_misspelt_attribute_is_reported_with_the_right_one() -> None:
    (only,) = reported("self.pre_condition += Object.Weight == 2.0").diagnostics
    assert (only.code, only.help) == ("EZS220", "did you mean `self.pre_conditions`?")


def test_conditions_that_are_no_method_are_reported() -> None:
    text = SKILLS.format(
        lines="self.pre_conditions += Object.Weight",
        tree="Place(Object=params.Object)",
        parameters="Object",
    )
    method = "    def conditions(self, Object):\n        self.pre_conditions += Object.Weight\n"
    for other in ("    conditions = ['light']\n", f"    @staticmethod\n{method}"):
        (only,) = checked(text.replace(method, other)).diagnostics
        assert (only.code, only.primary.span.text) == ("EZS565", "take_light")
        assert only.help is not None
        assert only.help.startswith("write `def conditions(self, Object):`")


def test_parameters_are_taken_by_their_names() -> None:
    (only,) = reported(
        "self.pre_conditions += params.Object.Weight", parameters="params"
    ).diagnostics
    assert (only.code, only.primary.span.text) == ("EZS508", "params")
    assert only.help is not None
    assert "`def conditions(self, Object):`" in only.help


def test_a_child_that_names_the_implementation_has_to_fulfil_its_conditions() -> None:
    """The weight is 5 when `Take` starts."""
    tree = "Place(Object=params.Object), Take{}(Object=params.Object)"
    light = "self.pre_conditions += Object.Weight != 5.0"
    for named in ("", ".take_light"):  # there is no other implementation
        result = reported(light, tree.format(named))
        assert [code for code, _ in found(result)] == ["EZS550"], named
        assert any(
            label.span.text == "Object.Weight != 5.0"
            for label in (result.diagnostics[0].primary, *result.diagnostics[0].labels)
        )
    assert found(reported("self.pre_conditions += Object.Weight < 6.0", tree.format(""))) == []


def test_with_a_choice_a_child_has_to_fulfil_the_description_only() -> None:
    tree = "Place(Object=params.Object), Take(Object=params.Object)"
    text = SKILLS.format(
        lines="self.pre_conditions += Object.Weight != 5.0", tree=tree, parameters="Object"
    )
    other = text[text.index("class take_light") : text.index("class Place")]
    other = other.replace("take_light", "take_heavy").replace("!= 5.0", "== 5.0")
    assert found(checked(text.replace("class Place", f"{other}class Place"))) == []


def test_a_compound_counts_on_its_own_conditions() -> None:
    """Each child needs a light object, and only the implementation says that it is one."""
    body = SKILLS.format(
        lines="self.pre_conditions += Object.Weight",
        tree="Lift(Object=params.Object)",
        parameters="Object",
    )
    lift = """
class Lift(SkillDescription):
    def description(self, Object: skiros.Product):
        self.pre_conditions += Object.Weight == 2.0


class lift(Lift.SkillBase):
    def execute(self):
        return self.success(f"{self.params.Object}")


class Task"""
    body = body.replace("class Task", lift, 1)
    condition = "        self.pre_conditions += Object.Weight == 2.0\n"
    unsaid = "        pass\n".join(body.rsplit(condition, 1))
    said = unsaid.replace(
        "class task(Task.SkillBase):\n",
        "class task(Task.SkillBase):\n    def conditions(self, Object):\n"
        "        self.pre_conditions += Object.Weight == 2.0\n\n",
    )
    warned = [each.code for each in checked(unsaid).diagnostics]
    assert [each for each in warned if each.startswith("EZS55")] != []
    assert checked(said).diagnostics == ()


def test_a_condition_that_only_some_individuals_can_fulfil_is_a_choice(tmp_path: Path) -> None:
    """In a description it is told that not each individual has the property."""
    (tmp_path / "room.ttl").write_text(
        f"{PREFIXES}:Location a owl:Class . :Openable a owl:Class ; rdfs:subClassOf :Location .\n"
        ":Open a owl:DatatypeProperty ; rdfs:domain :Openable ; rdfs:range xsd:boolean .\n"
    )
    text = f"""
from ezskiros import *
from ezskiros.ontology import load

test = load({str(tmp_path)!r}).test


class Enter(SkillDescription):
    def description(self, Place: test.Location):
        {{described}}


class enter(Enter.SkillBase):
    def conditions(self, Place):
        {{own}}

    def execute(self):
        return self.success(f"{{{{self.params.Place}}}}")
"""
    said = "self.pre_conditions += test.Open(Place) == True"
    in_description = checked(text.format(described=said, own="pass"))
    assert [each.code for each in in_description.diagnostics] == ["EZS402", "EZS565"]
    assert checked(text.format(described="pass", own=said)).diagnostics == ()
