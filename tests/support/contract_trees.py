"""Random compound skills with their trees, and the small worlds that they are about."""

from __future__ import annotations

import random
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from dslkit.source import SourceFile, Span
from ezskiros.ontology import Ontology
from ezskiros.ontology.statements import AnyOf, Relation, Statement
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.interface import Clause, Parameter, SkillInterface
from ezskiros.skills.markers import ParameterKind
from ezskiros.skills.nodes import Decoration, Decorator, Flow, Node, Processor
from ezskiros.trees.tree import IndividualReference
from support.ontologies import START, turtle

Facts = frozenset[tuple[str, int, int]]
RELATIONS = ("p", "q")
KINDS = (
    "owl:FunctionalProperty",
    "owl:InverseFunctionalProperty",
    "owl:SymmetricProperty",
    "owl:AsymmetricProperty",
    "owl:TransitiveProperty",
)
BETWEEN = (":p rdfs:subPropertyOf :q .", ":p owl:inverseOf :q .")
INDIVIDUALS = range(4)
OWN = {"A": 0, "B": 1}
"""The parameters of the compound, and the individuals that they stand for."""
FILE = SourceFile("skills.py", " " * 4000)


@dataclass(frozen=True)
class Rules:
    """An ontology of two relations."""

    kinds: tuple[frozenset[str], frozenset[str]]
    others: frozenset[str]

    @property
    def ontology(self) -> Ontology:
        return ontology_of(self)

    def closed(self, facts: Iterable[tuple[str, int, int]]) -> Facts:
        """With all that follows."""
        found = set(facts)
        while True:
            more = {new for each in found for new in self._following(each, found)} - found
            if not more:
                return frozenset(found)
            found |= more

    def _following(
        self, fact: tuple[str, int, int], found: set[tuple[str, int, int]]
    ) -> Iterable[tuple[str, int, int]]:
        name, one, other = fact
        if BETWEEN[0] in self.others and name == "p":
            yield "q", one, other
        if BETWEEN[1] in self.others:
            yield "q" if name == "p" else "p", other, one
        kinds = self.kinds[RELATIONS.index(name)]
        if "owl:SymmetricProperty" in kinds:
            yield name, other, one
        if "owl:TransitiveProperty" in kinds:
            yield from (
                (name, one, end) for also, start, end in found if (also, start) == (name, other)
            )

    def is_possible(self, facts: Facts) -> bool:
        """Say whether facts, with all their consequences, are possible."""
        for name, kinds in zip(RELATIONS, self.kinds, strict=True):
            pairs = {(one, other) for each, one, other in facts if each == name}
            firsts, seconds = [a for a, _ in pairs], [b for _, b in pairs]
            if "owl:FunctionalProperty" in kinds and len({*firsts}) < len(firsts):
                return False
            if "owl:InverseFunctionalProperty" in kinds and len({*seconds}) < len(seconds):
                return False
            if "owl:AsymmetricProperty" in kinds and any((b, a) in pairs for a, b in pairs):
                return False
        return True


@lru_cache
def ontology_of(rules: Rules) -> Ontology:
    lines = [":T a owl:Class ."]
    for name, kinds in zip(RELATIONS, rules.kinds, strict=True):
        lines.append(f":{name} a {' , '.join(['owl:ObjectProperty', *sorted(kinds)])} .")
    return turtle("\n".join([*lines, *sorted(rules.others)]))


def holds(said: Statement, facts: Facts, individuals: Mapping[str, int]) -> bool:
    if isinstance(said, AnyOf):
        return any(holds(part, facts, individuals) for part in said.parts) == said.is_true
    assert isinstance(said, Relation)
    fact = (said.relation.removeprefix(START), individuals[said.subject], individuals[said.object])
    return (fact in facts) == said.is_true


# --- skills and trees -----------------------------------------------------------------------------


class Skills:
    """Stands for a library."""

    def __init__(self, ontology: Ontology) -> None:
        self._ontology = ontology
        self.known: dict[type, SkillInterface] = {}

    def skill(self, description: type) -> SkillInterface:
        return self.known[description]

    def called(self, call: SkillCall) -> SkillInterface:
        return self.known[call.skill]

    def skills(self) -> list[SkillInterface]:
        return [*self.known.values()]

    def ontology(self) -> Ontology:
        return self._ontology


@dataclass
class Drawn:
    """A compound skill with its tree."""

    rules: Rules
    skills: Skills
    compound: SkillInterface
    root: Node


class Drawing:
    """Draws skills and nodes; each condition and each call has a place of its own."""

    def __init__(self, chance: random.Random, rules: Rules) -> None:
        self.chance, self.rules, self.skills = chance, rules, Skills(rules.ontology)
        self._count = 0

    def span(self) -> Span:
        self._count += 1
        return Span(FILE, self._count, self._count + 1)

    def parameter(self, name: str, kind: ParameterKind) -> Parameter:
        return Parameter(name, kind, self.rules.ontology.class_of(START + "T"), self.span())

    def relation(self, names: Sequence[str]) -> Relation:
        subject, other = self.chance.choice(names), self.chance.choice(names)
        iri = START + self.chance.choice(RELATIONS)
        return Relation(subject, iri, other, self.chance.random() < 0.7)

    def statement(self, names: Sequence[str]) -> Statement:
        if self.chance.random() < 0.15:
            return AnyOf((self.relation(names), self.relation(names)))
        return self.relation(names)

    def clauses(self, names: Sequence[str], least: int, most: int) -> list[Clause]:
        count = self.chance.randint(least, most)
        said = dict.fromkeys(self.statement(names) for _ in range(count))
        return [Clause(each, self.span()) for each in said]

    def skill(self, name: str, kinds: Mapping[str, ParameterKind], most: int = 1) -> SkillInterface:
        parameters = [self.parameter(each, kind) for each, kind in kinds.items()]
        pre, post = self.clauses([*kinds], 0, most), self.clauses([*kinds], 1, 2)
        hold = self.clauses([*kinds], 1, 1) if self.chance.random() < 0.2 else []
        return SkillInterface(name, self.span(), parameters, pre, hold, post)

    def call(self, compound: SkillInterface) -> SkillCall:
        """Draw a call of a new or an existing skill."""
        known: list[Any] = [*self.skills.known]
        called = self.chance.choice([*known, None, None])
        if called is None:
            kinds = {"X": ParameterKind.REQUIRED, "Y": ParameterKind.REQUIRED}
            if self.chance.random() < 0.3:
                kinds["I"] = ParameterKind.INFERRED
            called = type(f"S{len(known)}", (), {})
            self.skills.known[called] = self.skill(called.__name__, kinds)
        given = {
            name: IndividualReference(self.chance.choice(compound.parameters)) for name in "XY"
        }
        return SkillCall(called, None, given, self.span())

    def node(self, compound: SkillInterface, depth: int) -> Node:
        kind = self.chance.random() if depth else 0.0
        if kind < 0.2 and depth < 2:
            return self.call(compound)
        if kind < 0.3:
            decoration = self.chance.choice([*Decoration])
            limit = None if decoration is Decoration.INVERTER else 2
            return Decorator(decoration, self.node(compound, depth - 1), limit, self.span())
        count = self.chance.randint(1, 3)
        below = tuple(self.node(compound, depth - 1) for _ in range(count))
        flow = self.chance.choice([*Flow, Flow.SERIAL_STAR, Flow.PARALLEL_FF])
        return Processor(flow, below, self.span())


def drawn(chance: random.Random) -> Drawn:
    kinds = tuple(frozenset(chance.sample(KINDS, chance.randint(0, 1))) for _ in RELATIONS)
    rules = Rules((kinds[0], kinds[1]), frozenset(chance.sample(BETWEEN, chance.randint(0, 1))))
    drawing = Drawing(chance, rules)
    compound = drawing.skill("Compound", dict.fromkeys(OWN, ParameterKind.REQUIRED), most=4)
    return Drawn(rules, drawing.skills, compound, drawing.node(compound, 2))
