"""All checks of contracts, in one order."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

from dslkit.diagnostics import Diagnostic, Severity, listed
from ezskiros import session
from ezskiros.check.calls import check_calls
from ezskiros.check.dataflow import check_dataflow
from ezskiros.contracts.children import SkillOf, TreeChildren, names_of_tree
from ezskiros.contracts.findings import MissingCondition, TreeFindings
from ezskiros.contracts.judge import Judge
from ezskiros.contracts.knowledge import KnownFacts, Origin
from ezskiros.contracts.remarks import Branch
from ezskiros.contracts.repairs import Repairs, in_order
from ezskiros.contracts.statements import TreeCondition, asked
from ezskiros.contracts.walk import TreeWalk
from ezskiros.ontology.symbols import UnknownValue
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.interface import Clause, SkillInterface
from ezskiros.skills.nodes import calls
from ezskiros.trees.library import Library
from ezskiros.trees.tree import Tree

Added = Mapping[str, Sequence[Clause]]
NOTHING: Added = MappingProxyType({})


@dataclass(frozen=True)
class Contracts:
    """The findings, and the pre-conditions that would repair some of them."""

    diagnostics: Sequence[Diagnostic]
    missing: Sequence[MissingCondition]


def check_contracts(trees: Iterable[Tree], library: Library, added: Added = NOTHING) -> Contracts:
    """Check the conditions of compound skills against those of their children.

    Trees with invalid calls are left out. `added` are pre-conditions besides those of the library,
    by the names of their skills.
    """
    found: dict[tuple[object, ...], Diagnostic] = {}
    missing: dict[tuple[str, object], MissingCondition] = {}
    trees = list(trees)
    for tree in trees:
        session.come_to(tree.span.file.path)
        if is_sound(tree, library):
            findings = check_tree(tree, library, added, branch=_branch(tree, trees))
            for key, diagnostic in findings.found.items() if findings else ():
                found.setdefault(key, diagnostic)
            for each in findings.missing.values() if findings else ():
                missing.setdefault((each.skill.name, each.statement), each)
    return Contracts(list(found.values()), list(missing.values()))


def is_sound(tree: Tree, library: Library) -> bool:
    """Say whether all calls of a tree are valid and have their values."""
    skills = [library.called(call) for call in calls(tree.root)]
    given = (value for call in calls(tree.root) for value in call.arguments.values())
    if any(isinstance(each, UnknownValue) for each in given):
        return False
    if not all(skill and library.is_whole(skill) for skill in (tree.skill, *skills)):
        return False
    found = (*check_calls(tree, library), *check_dataflow(tree, library))
    return not any(each.severity is Severity.ERROR for each in found)


def check_tree(
    tree: Tree, library: Library, added: Added = NOTHING, *, branch: Branch | None = None
) -> TreeFindings | None:
    """Check one tree; None if the tree cannot be checked. `branch` says which of several trees it
    is.
    """
    ontology = library.ontology()
    if ontology is None:
        return None
    skill = _with(tree.skill, added)
    skill_of = _skill_of(library, added)
    below = list(calls(tree.root))
    judge = Judge(ontology.model, names_of_tree(skill, below, skill_of))
    start = known_at_start(skill)
    skills = {id(each): each for each in map(skill_of, below)}.values()
    if judge.is_impossible(start.facts) or any(_is_odd(each, judge) for each in skills):
        return None
    others = in_order(library.skills())
    repairs = Repairs(skill, judge, others, tuple(below), ontology.ambiguous())
    findings = TreeFindings(tree, skill, judge, repairs, branch)
    held = list(asked(skill.hold, "hold", {}))
    outcome = TreeWalk(judge, findings, TreeChildren(skill_of), held).through(tree.root, start)
    alive = [each for each in outcome.endings if not each.is_dead]
    for each in asked(skill.post, "post", {}) if alive else ():
        _check_end(each, alive, judge, findings)
    return findings


def _branch(tree: Tree, trees: Sequence[Tree]) -> Branch | None:
    """Describe the tree, if `expandBT` builds several."""
    if sum(each.span == tree.span for each in trees) < 2:
        return None
    names = listed([call.skill.__name__ for call in calls(tree.root)])
    return Branch(children=names)


def _check_end(
    said: TreeCondition, endings: Sequence[KnownFacts], judge: Judge, findings: TreeFindings
) -> None:
    """Check a post-condition of the compound at the points where its tree may have succeeded."""
    clashes = {
        index: judge.clash(ending, said.statement)
        for index, ending in enumerate(endings)
        if not judge.entails(ending, said.statement)
    }
    is_false = len(clashes) == len(endings) and all(clashes.values())
    for index, clash in clashes.items():
        findings.at_end(said, endings[index], clash, is_false=is_false)


def known_at_start(skill: SkillInterface) -> KnownFacts:
    """The knowledge at the start of a compound."""
    said = (*asked(skill.pre, "pre", {}), *asked(skill.hold, "hold", {}))
    facts = {each.statement: Origin(each.clause.span, each.kind) for each in reversed(said)}
    bound = (each.name for each in skill.parameters if each.is_individual and not each.is_output)
    return KnownFacts(dict(reversed(facts.items())), frozenset(bound))


def _with(skill: SkillInterface, added: Added) -> SkillInterface:
    """A skill with the pre-conditions that are added to it."""
    more = added.get(skill.name)
    return replace(skill, pre=(*skill.pre, *more)) if more else skill


def _skill_of(library: Library, added: Added) -> SkillOf:
    known: dict[tuple[type, str | None], SkillInterface] = {}

    def skill_of(call: SkillCall) -> SkillInterface:
        skill = known.get((call.skill, call.implementation))
        if skill is None:
            skill = library.called(call)
            assert skill is not None  # the tree is sound
            skill = known[call.skill, call.implementation] = _with(skill, added)
        return skill

    return skill_of


def _is_odd(skill: SkillInterface, judge: Judge) -> bool:
    """Say whether the conditions of a skill contradict each other, which another check reports."""
    names = names_of_tree(skill, (), lambda _: skill)
    own = Judge(judge.model, names)
    before = own.is_impossible(known_at_start(skill).facts)
    return before or own.is_impossible(each.statement for each in asked(skill.post, "post", {}))
