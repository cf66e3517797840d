"""Individuals that are passed to children whose pre-conditions never hold of their class."""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros.driver import check_paths
from support.ontologies import PREFIXES

ONTOLOGY = """
:Thing a owl:Class . :Location a owl:Class ; rdfs:subClassOf :Thing .
:Openable a owl:Class ; rdfs:subClassOf :Location .
:Fridge a owl:Class ; rdfs:subClassOf :Openable .
:Table a owl:Class ; rdfs:subClassOf :Location .
:Open a owl:DatatypeProperty ; rdfs:domain :Openable ; rdfs:range xsd:boolean .
:Size a owl:DatatypeProperty ; rdfs:range xsd:float .
:leadsTo a owl:ObjectProperty ; rdfs:domain :Openable ; rdfs:range :Location .
:near a owl:ObjectProperty .
"""
SKILLS = """
from ezskiros import *
from ezskiros.ontology import load

room = load({ontology!r}).room


class Pick(SkillDescription):
    def description(self, From: room.Location, To: room.Location):
        {conditions}


class pick(Pick.SkillBase):
    def execute(self):
        return self.success(f"{{self.params.From}} {{self.params.To}}")


class Task(SkillDescription):
    def description(self, Table: room.Table, Fridge: room.Fridge, Any: room.Location): ...


class task(Task.SkillBase):
    def expandBT(self, params):
        self.serialstar(Pick(From=params.{passed}, To=params.Any))
"""


def never(folder: Path, conditions: str, passed: str) -> list[str]:
    """The arguments with which a pre-condition of the child never holds."""
    ontology, skills = folder / "room.ttl", folder / "skills.py"
    ontology.write_text(PREFIXES.replace("test.owl", "room.owl") + ONTOLOGY)
    skills.write_text(SKILLS.format(ontology=str(ontology), conditions=conditions, passed=passed))
    found = check_paths([skills]).diagnostics
    return [each.primary.span.text for each in found if each.code == "EZS561"]


@pytest.mark.parametrize("condition", ["From.Open == True", "From.Open", "From.leadsTo(To)"])
@pytest.mark.parametrize("passed", ["Table", "Fridge", "Any"])
def test_a_pre_condition_that_never_holds_of_what_is_passed(
    tmp_path: Path, condition: str, passed: str
) -> None:
    found = never(tmp_path, f"self.pre_conditions += {condition}", passed)
    assert found == (["params.Table"] if passed == "Table" else [])


@pytest.mark.parametrize(
    "conditions",
    [
        "self.pre_conditions += ~(From.Open == True)",
        "self.pre_conditions += (From.Open == True) | From.near(To)",
        "self.pre_conditions += abstract(From.leadsTo(To))",
        "self.pre_conditions += From.Size < 3",
        "self.pre_conditions += From.near(To)",
        "self.pre_conditions += To.Open == True",
        "self.post_conditions += From.Open == True",
    ],
)
def test_conditions_that_may_hold_before(tmp_path: Path, conditions: str) -> None:
    assert never(tmp_path, conditions, "Table") == []


def test_the_message_names_the_condition_and_the_class(tmp_path: Path) -> None:
    never(tmp_path, "self.pre_conditions += From.Open == True", "Table")
    (found,) = [
        each for each in check_paths([tmp_path / "skills.py"]).diagnostics if each.code == "EZS561"
    ]
    assert found.title == (
        "`Table` is a room.Table, for which `From.Open == True` of `Pick` never holds"
    )
    assert found.notes == ("in the ontology, room.Open is a property of a room.Openable",)
    assert found.help == (
        "declare `Table: room.Openable`, or call a skill without this pre-condition"
    )
