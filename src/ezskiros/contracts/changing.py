"""Changes of the known conditions: by a child that succeeds or fails, and where paths join."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

from ezskiros.contracts.judge import Judge
from ezskiros.contracts.knowledge import KnownFacts, Origin, Renewed, WorldChange, later
from ezskiros.ontology.statements import Specified, Statement


def changed(known: KnownFacts, changes: Sequence[WorldChange], judge: Judge) -> KnownFacts:
    """The knowledge after some changes have been made together."""
    said: dict[Statement, Origin] = {
        each.made: each.origin
        for each in changes
        if not isinstance(each.made, (Renewed, Specified))
    }
    known = _forgetting(known, changes, judge, said)
    known = replace(known, facts={**known.facts, **said})
    for each in changes:
        if isinstance(each.made, Specified) and not each.made.is_true:
            known = known.unbinding(each.made.subject)
    return judge.merged(known)


def failed(known: KnownFacts, changes: Sequence[WorldChange], judge: Judge) -> KnownFacts:
    """The knowledge after any subset of some changes may have been made, in any order."""
    if not changes:
        return known
    after = _forgetting(known, changes, judge, ())
    return after.perhaps_binding(known.bound - after.bound)


def _forgetting(
    known: KnownFacts, changes: Sequence[WorldChange], judge: Judge, kept: Collection[Statement]
) -> KnownFacts:
    """The knowledge without the facts that changes may end, alone or together with known facts."""
    for change in changes:
        if isinstance(change.made, Renewed):
            known = known.unbinding(change.made.subject)
    lost = judge.ended(known, changes).difference(kept)
    return replace(known.without(lost), changes=later(known.changes, changes))


def join(paths: Sequence[KnownFacts], judge: Judge) -> KnownFacts:
    """The knowledge where several paths meet: the facts that hold on every path that is not
    dead.
    """
    alive = [each for each in paths if not each.is_dead] or list(paths)
    first, *others = alive
    if not others:
        return first
    facts: dict[Statement, Origin] = {}
    changes: dict[WorldChange, None] = {}
    for path in alive:
        changes |= path.changes
        for fact, origin in path.facts.items():
            facts.setdefault(fact, origin)
    facts = {
        fact: origin
        for fact, origin in facts.items()
        if all(judge.entails(each, fact) for each in alive)
    }
    common = [pair for pair in first.same.items() if all(pair in w.same.items() for w in others)]
    return KnownFacts(
        facts,
        first.bound.intersection(*(each.bound for each in others)),
        frozenset().union(*(each.bound | each.perhaps for each in alive)),
        dict(common),
        changes,
        _common(alive),
        all(each.is_dead for each in alive),
    )


def _common(paths: Sequence[KnownFacts]) -> tuple[str, ...]:
    """The common beginning of the descriptions of some paths."""
    found = []
    for steps in zip(*(each.trail for each in paths), strict=False):
        if len(set(steps)) > 1:
            break
        found.append(steps[0])
    return tuple(found)
