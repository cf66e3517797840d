"""Type checkers refuse what `ezskiros check` finds: tried with all that one condition can say."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from ezskiros.driver import check_paths
from ezskiros.ontology import Ontology, load
from ezskiros.ontology.iris import split
from ezskiros.ontology.python_names import identifier
from ezskiros.stubs import write_stub
from support.parts import PYRIGHT, needs
from support.type_checkers import Checker, mypy, pyright

ODD = Path(__file__).with_name("odd")
ABOUT_TERMS = {"EZS301", "EZS302", "EZS401", "EZS402", "EZS403", "EZS404", "EZS405"}
"""Codes about the meaning of terms and their classes, not about combinations of conditions."""

CLASSES = [
    *("lab.Kind", "lab.Room", "lab.Vehicle", "lab.Wagon", "shop.class_", "shop.Box"),
    *("shop.Crate", "shop.Fine", "shop.Large_Box_", "shop.Stray", "shop.Trolley"),
]
VALUES = ("1", "0.5", '"on"')
OPEN = ("shop.anyhow(", "Share")
"""Cases that type checkers cannot decide. The function of a namespace does not contain the
restrictions of single classes on a relation. Listed values have no literal type if one of them is a
fraction.
"""


@pytest.fixture(scope="module")
def skills(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with skills, the module that loads the ontology, and its stub."""
    folder = tmp_path_factory.mktemp("skills")
    ontology = load(ODD)
    (folder / "skill.py").write_text("\n".join(skills_that_say_all(ontology)), encoding="utf-8")
    (folder / "world.pyi").write_text(write_stub(ontology), encoding="utf-8")
    module = f"from ezskiros.ontology import load\nworld = load({str(ODD)!r})\n"
    module += "lab, shop = world.lab, world.shop\n"
    (folder / "world.py").write_text(module, encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def expected(skills: Path) -> set[int]:
    """The lines in which `check` finds something."""
    found = check_paths([skills / "skill.py"]).diagnostics
    return {each.primary.span.begin.line for each in found if each.code in ABOUT_TERMS}


@pytest.mark.parametrize(
    "checker",
    [mypy, pytest.param(pyright, marks=[needs(PYRIGHT), pytest.mark.deep])],
    ids=lambda each: each.__name__,
)
def test_what_is_refused_is_what_check_finds(
    checker: Checker, skills: Path, expected: set[int]
) -> None:
    lines = (skills / "skill.py").read_text(encoding="utf-8").split("\n")
    refused = {line for name, line in checker(skills) if name == "skill.py"}
    assert 500 < len(expected) < len(lines) - 500
    assert {lines[line - 1] for line in refused - expected} == set()
    missed = {lines[line - 1] for line in expected - refused}
    assert {line for line in missed if not any(each in line for each in OPEN)} == set()


def skills_that_say_all(ontology: Ontology) -> Iterator[str]:
    """Skills with a parameter of each class, and each condition between any two of them."""
    yield "from ezskiros import SkillDescription"
    yield "from world import lab, shop"
    taken = ", ".join(f"p{number}: {each}" for number, each in enumerate(CLASSES))
    for number, each in enumerate(dict.fromkeys(conditions(ontology))):
        if number % 25 == 0:
            yield f"class Skill{number}(SkillDescription):"
            yield f"    def description(self, {taken}):"
        yield f"        self.pre_conditions += {each}"


def conditions(ontology: Ontology) -> Iterator[str]:
    """All of them, said of the subject, and with the name of the namespace."""
    parameters = [f"p{number}" for number, _ in enumerate(CLASSES)]
    for iri in ontology.model.relations:
        for subject in parameters:
            for other in parameters:
                yield f"{subject}.{identifier(split(iri)[1])}({other})"
                yield from (f"{each}({subject}, {other})" for each in by_itself(ontology, iri))
    for iri in ontology.model.values:
        for subject in parameters:
            form = f"{subject}.{identifier(split(iri)[1])}"
            yield from (f"{form} {sign} {value}" for sign in ("==", "<") for value in VALUES)
            yield from (f"{each}({subject}) == {VALUES[-1]}" for each in by_itself(ontology, iri))


def by_itself(ontology: Ontology, iri: str) -> Iterator[str]:
    """The names of properties in their namespace, except the names that are also classes."""
    if iri not in ontology.model.classes:
        yield ontology.model.short(iri).replace(":", ".")
