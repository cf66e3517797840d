"""Comparison of the findings about combined conditions with all worlds of three individuals."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import compress, product

from hypothesis import given, settings
from hypothesis import strategies as st

from dslkit.diagnostics import Severity
from dslkit.source import SourceFile, Span
from ezskiros.check.consistency import check_consistency
from ezskiros.ontology import Ontology
from ezskiros.ontology.statements import (
    AnyOf,
    HasProperty,
    OfType,
    Relation,
    Statement,
    Value,
    ValueComparison,
)
from ezskiros.skills.interface import Clause, Parameter, SkillInterface
from ezskiros.skills.markers import ParameterKind
from support.depth import examples
from support.ontologies import START, turtle

Pairs = frozenset[tuple[int, int]]
World = dict[str, Pairs]

INDIVIDUALS = range(3)
NAMES = ("A", "B", "C")
RELATIONS = ("p", "q")
KINDS = (
    "owl:FunctionalProperty",
    "owl:InverseFunctionalProperty",
    "owl:SymmetricProperty",
    "owl:AsymmetricProperty",
    "owl:IrreflexiveProperty",
    "owl:TransitiveProperty",
)
BETWEEN = (":p rdfs:subPropertyOf :q .", ":p owl:inverseOf :q .")
ABOUT_CLASSES = (
    ":X owl:disjointWith :Y .",
    ":p rdfs:domain :X .",
    ":p rdfs:range :Y .",
    ":q rdfs:range :X .",
)
NOWHERE = SourceFile("skill.py", " " * 400)
PAIRS = tuple(product(INDIVIDUALS, INDIVIDUALS))
X, Y = START + "X", START + "Y"


@lru_cache
def relations_of(kinds: frozenset[str]) -> list[frozenset[tuple[int, int]]]:
    """All relations between the individuals that are of all these kinds."""
    chosen = (compress(PAIRS, each) for each in product((False, True), repeat=len(PAIRS)))
    return [each for each in map(frozenset, chosen) if _is(each, kinds)]


def _is(pairs: Pairs, kinds: frozenset[str]) -> bool:
    firsts, seconds = [a for a, _ in pairs], [b for _, b in pairs]
    turned = {(b, a) for a, b in pairs}
    holds = {
        "owl:FunctionalProperty": len(set(firsts)) == len(firsts),
        "owl:InverseFunctionalProperty": len(set(seconds)) == len(seconds),
        "owl:SymmetricProperty": turned == pairs,
        "owl:AsymmetricProperty": turned.isdisjoint(pairs),
        "owl:IrreflexiveProperty": all(a != b for a, b in pairs),
        "owl:TransitiveProperty": all(
            (a, d) in pairs for a, b in pairs for c, d in pairs if b == c
        ),
    }
    return all(holds[kind] for kind in kinds)


@dataclass(frozen=True)
class Rules:
    """An ontology of two relations and two classes, and its Turtle text."""

    kinds: tuple[frozenset[str], frozenset[str]]
    others: frozenset[str]

    @cached_property
    def ontology(self) -> Ontology:
        lines = [":T a owl:Class . :X rdfs:subClassOf :T . :Y rdfs:subClassOf :T ."]
        lines += [":X a owl:Class . :Y a owl:Class ."]
        for name, kinds in zip(RELATIONS, self.kinds, strict=True):
            lines.append(f":{name} a {' , '.join(['owl:ObjectProperty', *sorted(kinds)])} .")
        return turtle("\n".join([*lines, *sorted(self.others)]))

    def worlds(self, said: Sequence[Statement], individuals: dict[str, int]) -> Iterator[World]:
        """All worlds in which it is true, and in which some statements are."""
        plain = [each for each in said if isinstance(each, Relation)]
        asked = [
            (individuals[each.subject], each.owl_class) for each in said if isinstance(each, OfType)
        ]
        ps, qs = (
            [
                pairs
                for pairs in relations_of(kinds)
                if all(_holds(each, {START + name: pairs}, individuals) for each in plain
                       if each.relation == START + name)
            ]
            for name, kinds in zip(RELATIONS, self.kinds, strict=True)
        )  # fmt: skip
        ors = [each for each in said if isinstance(each, AnyOf)]
        for p in ps:
            for q in qs:
                world = {START + "p": p, START + "q": q}
                if (
                    self._goes_together(p, q)
                    and all(_holds(each, world, individuals) for each in ors)
                    and self._are_possible([*self.classes(p, q), *asked])
                ):
                    yield world

    def _goes_together(self, p: Pairs, q: Pairs) -> bool:
        if BETWEEN[0] in self.others and not p <= q:
            return False
        return BETWEEN[1] not in self.others or p == {(b, a) for a, b in q}

    def _are_possible(self, classes: list[tuple[int, str]]) -> bool:
        """Say whether individuals can be of these classes. No statement excludes an individual from
        a class.
        """
        is_disjoint = ABOUT_CLASSES[0] in self.others
        return not is_disjoint or not any({(n, X), (n, Y)} <= {*classes} for n in INDIVIDUALS)

    def classes(self, p: Pairs, q: Pairs) -> Iterator[tuple[int, str]]:
        """The classes of individuals that follow from their relations."""
        if ABOUT_CLASSES[1] in self.others:
            yield from ((a, X) for a, _ in p)
        if ABOUT_CLASSES[2] in self.others:
            yield from ((b, Y) for _, b in p)
        if ABOUT_CLASSES[3] in self.others:
            yield from ((b, X) for _, b in q)


def _holds(said: Statement, world: World, individuals: dict[str, int]) -> bool:
    """Say whether a statement is true if the parameters stand for these individuals."""
    match said:
        case AnyOf(parts=parts):
            return any(_holds(part, world, individuals) for part in parts) == said.is_true
        case Relation(subject=subject, relation=iri, object=other):
            return ((individuals[subject], individuals[other]) in world[iri]) == said.is_true
        case _:
            raise AssertionError(said)


def reported(rules: Rules, said: list[Statement], names: tuple[str, ...] = NAMES) -> set[str]:
    """The codes of errors about pre-conditions of a skill with three parameters."""
    owl_class = rules.ontology.class_of(START + "T")
    span = Span(NOWHERE, 0, 0)
    parameters = [Parameter(name, ParameterKind.REQUIRED, owl_class, span) for name in names]
    clauses = [Clause(each, Span(NOWHERE, n, n + 1)) for n, each in enumerate(said)]
    skill = SkillInterface("Skill", span, parameters, clauses, (), ())
    found = check_consistency(skill, rules.ontology)
    return {each.code for each in found if each.severity is Severity.ERROR}


relations = st.builds(
    Relation,
    st.sampled_from(NAMES),
    st.sampled_from([START + name for name in RELATIONS]),
    st.sampled_from(NAMES),
    st.booleans(),
)
types = st.builds(OfType, st.sampled_from(NAMES), st.sampled_from([START + "X", START + "Y"]))
simple = st.one_of(relations, relations, relations, types)
ors = st.builds(AnyOf, st.lists(relations, min_size=2, max_size=3).map(tuple), st.booleans())
rules = st.builds(
    Rules,
    st.tuples(*[st.frozensets(st.sampled_from(KINDS), max_size=2)] * 2),
    st.frozensets(st.sampled_from((*BETWEEN, *ABOUT_CLASSES)), max_size=4),
)


ALL_DIFFERENT = dict(zip(NAMES, INDIVIDUALS, strict=True))


@settings(max_examples=examples(2))
@given(rules, st.lists(st.one_of(simple, simple, simple, ors), min_size=1, max_size=5))
def test_what_is_reported_is_what_no_world_satisfies(rules: Rules, said: list[Statement]) -> None:
    codes = reported(rules, said)
    assert bool(codes) == (not any(rules.worlds(said, ALL_DIFFERENT))), codes


@settings(max_examples=examples(2))
@given(rules, st.lists(simple, min_size=2, max_size=5))
def test_parameters_may_stand_for_one_individual_where_nothing_is_counted(
    rules: Rules, said: list[Statement]
) -> None:
    codes = reported(rules, said)
    if not codes or "EZS412" in codes:
        return
    for individuals in product(INDIVIDUALS[:2], repeat=len(NAMES)):
        assert not any(rules.worlds(said, dict(zip(NAMES, individuals, strict=True)))), codes


@settings(max_examples=examples(2))
@given(rules, st.lists(st.one_of(simple, ors), max_size=12), st.data())
def test_what_is_so_in_a_world_has_no_finding(
    rules: Rules, drawn: list[Statement], data: st.DataObject
) -> None:
    seeds = data.draw(st.lists(simple, max_size=3))
    world = next(rules.worlds(seeds, ALL_DIFFERENT), None)
    if world is None:
        return
    classes = {*rules.classes(world[START + "p"], world[START + "q"])}
    classes |= {
        (INDIVIDUALS[NAMES.index(e.subject)], e.owl_class) for e in seeds if isinstance(e, OfType)
    }
    said = [
        each
        for each in drawn
        if (
            (ALL_DIFFERENT[each.subject], each.owl_class) in classes
            if isinstance(each, OfType)
            else _holds(each, world, ALL_DIFFERENT)
        )
    ]
    assert reported(rules, [*seeds, *said]) == set()


VALUES: tuple[Value, ...] = (1, 2)
values = st.sampled_from(VALUES)
compared = st.builds(
    ValueComparison,
    st.just("A"),
    st.just(START + "v"),
    st.sampled_from(["=", "<", ">", "<=", ">="]),
    values,
    st.booleans(),
)
present = st.builds(HasProperty, st.just("A"), st.just(START + "v"), st.booleans())
DECLARED: dict[str, list[float]] = {
    ":v a owl:DatatypeProperty .": [0.5, 1, 1.5, 2, 2.5],
    ":v a owl:DatatypeProperty ; rdfs:range xsd:integer .": [0, 1, 2, 3],
    ':v a owl:DatatypeProperty ; rdfs:range [ a rdfs:Datatype ; owl:oneOf ( "1" "2" ) ] .': [
        1, 2,
    ],
}  # fmt: skip


ontology_of = lru_cache(turtle)


def holds(said: ValueComparison | HasProperty, found: tuple[float, ...]) -> bool:
    """The truth value of a condition on a list of values in SkiROS2."""
    if isinstance(said, HasProperty):
        return bool(found) == said.is_true
    if said.operator == "=":
        return (said.value in found) == said.is_true
    compares = {
        "<": float.__lt__, ">": float.__gt__, "<=": float.__le__, ">=": float.__ge__,
    }[said.operator]  # fmt: skip
    return bool(found) and compares(float(found[0]), float(said.value)) == said.is_true


@settings(max_examples=examples(6))
@given(
    st.sampled_from(sorted(DECLARED)),
    st.booleans(),
    st.lists(st.one_of(compared, compared, compared, present), min_size=1, max_size=5),
)
def test_values_that_are_reported_cannot_be(
    declared: str, is_functional: bool, said: list[Statement]
) -> None:
    functional = ":v a owl:FunctionalProperty ." if is_functional else ""
    ontology = ontology_of(f":T a owl:Class . {declared} {functional}")
    span = Span(NOWHERE, 0, 0)
    parameter = Parameter("A", ParameterKind.REQUIRED, ontology.class_of(START + "T"), span)
    clauses = [Clause(each, Span(NOWHERE, n, n + 1)) for n, each in enumerate(said)]
    skill = SkillInterface("Skill", span, [parameter], clauses, (), ())
    codes = {each.code for each in check_consistency(skill, ontology)} - {"EZS410"}
    possible = [
        len(found)
        for count in range(2 if is_functional else 4)
        for found in product(DECLARED[declared], repeat=count)
        if all(holds(each, found) for each in said)  # type: ignore[arg-type]
    ]
    assert bool(codes - {"EZS321"}) == (not possible), codes
    if not codes:
        assert min(possible) < 2
    if codes == {"EZS321"}:
        assert min(possible) > 1
