"""The workload of EzSkiROS's benchmark: ontologies of any size, and skills that fit them.

An ontology is a tree of classes; some classes have a second parent. It has restrictions, groups of
disjoint classes, relations, data properties and individuals, like SkiROS2's own ontology. The
random numbers are seeded: a larger ontology begins with the smaller ontologies. Skills use only the
declarations of the first 1,000 triples.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import count
from pathlib import Path

import pyoxigraph
from pyoxigraph import BlankNode, Literal, NamedNode, Triple

SEED = 20240607
ONTOLOGY = "http://example.org/bench.owl"
RDF = "http://www.w3.org/1999/02/22-rdf-syntax-ns#"
RDFS = "http://www.w3.org/2000/01/rdf-schema#"
OWL = "http://www.w3.org/2002/07/owl#"
XSD = "http://www.w3.org/2001/XMLSchema#"
TYPE = RDF + "type"

USED_CLASSES = 80
USED_RELATIONS = 8
USED_VALUES = 4
"""The numbers of classes, relations and properties that skills use: the first of each kind."""


@dataclass(frozen=True)
class Size:
    """The number of declarations in an ontology."""

    triples: int
    classes: int


def write_ontology(path: Path, triples: int) -> Size:
    """Write an ontology of at least `triples` triples, as RDF/XML."""
    written: list[Triple] = []
    for part in _parts():
        written += part
        if len(written) >= triples:
            break
    pyoxigraph.serialize(
        written,
        path,
        pyoxigraph.RdfFormat.RDF_XML,
        prefixes={"bench": f"{ONTOLOGY}#", "rdfs": RDFS, "owl": OWL},
    )
    classes = sum(each.object == NamedNode(OWL + "Class") for each in written)
    return Size(len(written), classes)


def _parts() -> Iterator[list[Triple]]:
    """The endless ontology, class by class."""
    chance = random.Random(SEED)
    yield [_triple(ONTOLOGY, TYPE, OWL + "Ontology"), *_class("Class_0", [])]
    for number in count(1):
        parents = {chance.randrange(number) for _ in range(2 if number % 7 == 0 else 1)}
        yield _class(f"Class_{number}", [f"Class_{each}" for each in sorted(parents)])
        if number % 4 == 0:
            target = f"Class_{chance.randrange(number)}"
            yield _restriction(f"Class_{number}", f"relates_{number // 10}", target)
        if number % 5 == 0:
            yield _individual(f"individual_{number}", f"Class_{number}")
        if number % 10 == 1:
            yield _relation(f"relates_{number // 10}")
        if number % 20 == 1:
            yield _value(f"Value_{number // 20}")
        if number % 40 == 0:
            yield _disjoint_group(number)


def _own(name: str) -> str:
    return f"{ONTOLOGY}#{name}"


def _triple(subject: str | BlankNode, predicate: str, value: str | BlankNode | Literal) -> Triple:
    start = NamedNode(subject) if isinstance(subject, str) else subject
    end = NamedNode(value) if isinstance(value, str) else value
    return Triple(start, NamedNode(predicate), end)


def _comment(name: str) -> Triple:
    return _triple(_own(name), RDFS + "comment", Literal(f"What is meant by {name}."))


def _class(name: str, parents: list[str]) -> list[Triple]:
    above = [_triple(_own(name), RDFS + "subClassOf", _own(each)) for each in parents]
    return [_triple(_own(name), TYPE, OWL + "Class"), *above, _comment(name)]


def _restriction(name: str, relation: str, target: str) -> list[Triple]:
    """A restriction: each individual of a class relates to an individual of another class."""
    node = BlankNode(f"only_{name}")
    return [
        _triple(_own(name), RDFS + "subClassOf", node),
        _triple(node, TYPE, OWL + "Restriction"),
        _triple(node, OWL + "onProperty", _own(relation)),
        _triple(node, OWL + "someValuesFrom", _own(target)),
    ]


def _individual(name: str, kind: str) -> list[Triple]:
    return [
        _triple(_own(name), TYPE, OWL + "NamedIndividual"),
        _triple(_own(name), TYPE, _own(kind)),
    ]


def _relation(name: str) -> list[Triple]:
    return [
        _triple(_own(name), TYPE, OWL + "ObjectProperty"),
        _triple(_own(name), RDFS + "domain", _own("Class_0")),
        _triple(_own(name), RDFS + "range", _own("Class_0")),
        _comment(name),
    ]


def _value(name: str) -> list[Triple]:
    return [
        _triple(_own(name), TYPE, OWL + "DatatypeProperty"),
        _triple(_own(name), RDFS + "range", XSD + "float"),
    ]


def _disjoint_group(number: int) -> list[Triple]:
    """Some disjoint classes without subclasses."""
    names = [f"Kind_{number}_{each}" for each in range(5)]
    group, *cells = (BlankNode(f"kinds_{number}_{each}") for each in range(6))
    found = [triple for name in names for triple in _class(name, [f"Class_{number}"])]
    found.append(_triple(group, TYPE, OWL + "AllDisjointClasses"))
    found.append(_triple(group, OWL + "members", cells[0]))
    for name, cell, rest in zip(names, cells, [*cells[1:], RDF + "nil"], strict=True):
        found.append(_triple(cell, RDF + "first", _own(name)))
        found.append(_triple(cell, RDF + "rest", rest))
    return found


HEADER = """\
import enum

from ezskiros import INFERRED, SkillDescription
from ezskiros.ontology import load

bench = load().bench


class Mode(enum.Enum):
    FAST = "fast"
    CAREFUL = "careful"
"""


def write_skills(
    folder: Path, files: int, skills_of_a_file: int, *, with_mistakes: bool = False
) -> None:
    """Write a package of skills with 10 parameters and 10 conditions each."""
    chance = random.Random(SEED)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "__init__.py").write_text('"""Generated."""\n', encoding="utf-8")
    for file in range(files):
        numbers = range(file * skills_of_a_file, (file + 1) * skills_of_a_file)
        skills = [_skill(number, chance, with_mistakes=with_mistakes) for number in numbers]
        text = "\n\n".join([HEADER, *skills])
        (folder / f"skills_{file}.py").write_text(text, encoding="utf-8")


def _skill(number: int, chance: random.Random, *, with_mistakes: bool) -> str:
    """A skill that infers six parameters from a given one. A mistake is a misspelt relation."""
    numbers = [chance.randrange(USED_CLASSES) for _ in range(7)]
    classes = [f"bench.Class_{each}" for each in numbers]
    relations = [f"relates_{chance.randrange(USED_RELATIONS)}" for _ in range(7)]
    parameters = [f"Individual_0: {classes[0]}"]
    parameters += [f"Individual_{i}: INFERRED[{classes[i]}]" for i in range(1, 7)]
    parameters += ["Speed: float = 0.1", "Style: Mode = Mode.FAST", "IsCareful: bool = True"]

    def related(relation: str, one: int, other: int) -> str:
        """The conditions relate two classes always in the same direction, as in real skills."""
        subject, object_ = sorted((one, other), key=numbers.__getitem__)
        return f"Individual_{subject}.{relation}(Individual_{object_})"

    pre = [related(relations[each], each, chance.randrange(each)) for each in range(1, 7)]
    pre.append(f"Individual_0.Value_{chance.randrange(USED_VALUES)} < 2.5")
    first = pre[0]
    if with_mistakes:
        pre[1] = pre[1].replace("relates_", "relatez_")
    lines = [f"class Skill_{number}(SkillDescription):", '    """Does something."""', ""]
    lines += ["    def description(", "        self,"]
    lines += [f"        {each}," for each in parameters]
    lines += ["    ):"]
    lines += [f"        self.pre_conditions += {each}" for each in pre]
    lines += [f"        self.hold_conditions += {related(relations[0], 0, 2)}"]
    lines += [f"        self.post_conditions += ~{first}"]
    lines += [f"        self.post_conditions += {related(relations[0], 0, 3)}"]
    return "\n".join(lines) + "\n"
