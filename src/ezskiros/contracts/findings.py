"""The findings about contracts: their texts, labels and repairs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from dslkit.diagnostics import Diagnostic, Label, Remark, Template, listed
from ezskiros.check.clash import Clash
from ezskiros.check.inference import names as names_of
from ezskiros.check.spelled import spelled
from ezskiros.contracts import errors
from ezskiros.contracts.judge import Judge
from ezskiros.contracts.knowledge import How, KnownFacts, Renewed, WorldChange
from ezskiros.contracts.remarks import (
    BeforeItFailed,
    Branch,
    ByWhich,
    CalledHere,
    ComesHere,
    ConditionOf,
    HasEnded,
    ItsTree,
    KnownThere,
    Meanwhile,
    NothingKnown,
    OnThePath,
    Why,
)
from ezskiros.contracts.repairs import Repairs
from ezskiros.contracts.statements import TreeCondition
from ezskiros.ontology.statements import Statement
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.interface import SkillInterface
from ezskiros.trees.tree import Tree

_HOW: Mapping[How, Remark] = {
    How.DONE: HasEnded(),
    How.FAILED: BeforeItFailed(),
    How.BESIDE: Meanwhile(),
}
_MOST_KNOWN = 4


@dataclass(frozen=True)
class MissingCondition:
    """A missing pre-condition of a compound skill, which would repair a finding."""

    skill: SkillInterface
    statement: Statement
    text: str


@dataclass
class TreeFindings:
    """The findings of one tree. `missing` are the conditions that `--fix` adds; `branch` identifies
    the tree if an implementation has several.
    """

    tree: Tree
    skill: SkillInterface
    judge: Judge
    repairs: Repairs
    branch: Branch | None = None
    found: dict[tuple[object, ...], Diagnostic] = field(default_factory=dict)
    missing: dict[Statement, MissingCondition] = field(default_factory=dict)

    # --- children that start ----------------------------------------------------------------------

    def false_at_start(
        self,
        call: SkillCall,
        asked: TreeCondition,
        known: KnownFacts,
        clash: Clash,
        *,
        is_fatal: bool,
    ) -> None:
        """Report a condition of a child that is false."""
        kind = errors.CannotStart if is_fatal else errors.NeverStarts
        found = kind(child=call.skill.__name__, condition=self._spelled(asked.statement))
        labels = [*self._declared(call, asked), *self._reasons(clash, known)]
        why = clash.reason(self.judge.model)
        help = self.repairs.of_false(call, asked.statement, known, clash)
        notes = [Why(why=why)] if why else []
        self._add(found, call, asked, labels, known, help, *notes)

    def unknown_at_start(
        self, call: SkillCall, asked: TreeCondition, known: KnownFacts, *, is_fatal: bool
    ) -> None:
        """Report a condition of a child that no known fact implies."""
        change = self.last_touching(known, asked.statement)
        child, condition = call.skill.__name__, self._spelled(asked.statement)
        labels = list(self._declared(call, asked))
        if change is not None and change.how is How.BESIDE and self._excludes(change, asked):
            self._beside(call, asked, known, change)
            return
        if change is not None:
            lost = errors.MayBeLost(child=child, condition=condition)
            labels += self._changed(change)
            help = self.repairs.of_lost(call, asked.statement, known, change)
            self._add(lost, call, asked, labels, known, help)
            return
        help = self.repairs.of_unknown(asked.statement)
        if not is_fatal:
            vain = errors.TriedInVain(child=child, condition=condition, skill=self.skill.name)
            self._add(vain, call, asked, labels, known, help)
            return
        if text := self.repairs.pre_condition(asked.statement):
            self.missing[asked.statement] = MissingCondition(self.skill, asked.statement, text)
        found = errors.NotShown(child=child, condition=condition)
        self._add(found, call, asked, labels, known, help)

    def _beside(
        self, call: SkillCall, asked: TreeCondition, known: KnownFacts, change: WorldChange
    ) -> None:
        assert change.origin.call is not None
        found = errors.EndsBeside(
            other=change.origin.call.skill.__name__,
            child=call.skill.__name__,
            condition=self._spelled(asked.statement),
        )
        labels = [*self._declared(call, asked), *self._changed(change)]
        self._add(found, call, asked, labels, known, None)

    # --- the compound itself ----------------------------------------------------------------------

    def hold(
        self, call: SkillCall, asked: TreeCondition, known: KnownFacts, clash: Clash | None
    ) -> None:
        """Report that a hold-condition of the compound has ended, or may have ended, when a child
        starts.
        """
        child, condition = call.skill.__name__, self._spelled(asked.statement)
        label = ConditionOf(kind="hold", skill=self.skill.name).at(asked.clause.span)
        change = self.last_touching(known, asked.statement)
        names = {"skill": self.skill.name, "child": child, "condition": condition}
        source = change.origin.call if change else None
        key = (asked.statement, source and source.span)
        if clash is not None:
            ends = errors.EndsHold(**names)
            labels = [label, *self._reasons(clash, known)]
            repair = ends.Repair(child=child)
            self._add(ends, call, asked, labels, known, repair, key=key)
        else:
            may_end = errors.MayEndHold(**names)
            labels = [label, *self._changed(change)]
            self._add(may_end, call, asked, labels, known, None, key=key)

    def at_end(
        self, asked: TreeCondition, known: KnownFacts, clash: Clash | None, *, is_false: bool
    ) -> None:
        """Report a post-condition of the compound that does not follow after its tree has
        succeeded. With `is_false`, it is false on every path.

        It is an error only if a child has made the post-condition false. Otherwise a child without
        this post-condition may still change the fact, which is common in SkiROS2's skills.
        """
        is_made_false = is_false and clash is not None and _has_child(clash, known)
        kind = errors.NeverAchieved if is_made_false else errors.NotAchieved
        found = kind(tree=self.tree.implementation, condition=self._spelled(asked.statement))
        change = self.last_touching(known, asked.statement)
        labels = self._reasons(clash, known) if clash else self._changed(change)
        why = clash.reason(self.judge.model) if clash else ""
        notes = [*([Why(why=why)] if why else []), *self._notes(asked, known)]
        help = self.repairs.at_end(asked.statement, change)
        labels = [ItsTree().at(self.tree.span), *labels]
        written = [label for label in labels if label.span != asked.clause.span]
        key = (asked.statement, self.tree.implementation)
        self._keep(found.at(asked.clause.span, *written, notes=notes, help=help), key)

    def restart(
        self,
        call: SkillCall,
        asked: TreeCondition,
        known: KnownFacts,
        clash: Clash | None,
        again: str,
    ) -> None:
        """Report a condition that has ended when the child restarts."""
        found = errors.CannotRestart(
            child=call.skill.__name__,
            condition=self._spelled(asked.statement),
            ended="is false then" if clash else "may no longer hold",
            again=again,
        )
        change = self.last_touching(known, asked.statement)
        reasons = self._reasons(clash, known) if clash else self._changed(change)
        labels = [*self._declared(call, asked), *reasons]
        self._add(found, call, asked, labels, known, None, key=call.span)

    # --- knowledge --------------------------------------------------------------------------------

    def last_touching(self, known: KnownFacts, said: Statement) -> WorldChange | None:
        """The last change that may have ended a statement."""
        touching = (each for each in known.changes if self.judge.touches(each.made, said))
        return next(iter([*touching][::-1]), None)

    def _excludes(self, change: WorldChange, asked: TreeCondition) -> bool:
        """Say whether a change certainly ends a condition."""
        if isinstance(change.made, Renewed):
            return False
        after = KnownFacts({change.made: change.origin}, frozenset())
        return self.judge.clash(after, asked.statement) is not None

    def _notes(self, asked: TreeCondition, known: KnownFacts) -> Sequence[Remark]:
        """The notes with the known facts, and with the path to this point."""
        about = set(names_of(asked.statement))
        related = [each for each in known.facts if about & set(names_of(each))]
        related.sort(key=lambda each: -len(about & set(names_of(each))))
        texts = [self._spelled(each) for each in related[:_MOST_KNOWN]]
        held = KnownThere(conditions=listed(texts)) if texts else NothingKnown()
        path = OnThePath(path=", and ".join(known.trail)) if known.trail else None
        return [each for each in (held, path, self.branch) if each is not None]

    def _declared(self, call: SkillCall, asked: TreeCondition) -> Iterator[Label]:
        condition = ConditionOf(kind=asked.kind, skill=call.skill.__name__)
        yield condition.at(asked.clause.span)

    def _reasons(self, clash: Clash, known: KnownFacts) -> list[Label]:
        """The labels of the conditions that exclude the statement, and of their children."""
        labels: dict[Label, None] = {}
        for said in known.facts:
            if said in clash.said:
                origin = known.facts[said]
                owner = origin.call.skill.__name__ if origin.call else self.skill.name
                by_which = ByWhich(kind=origin.kind, skill=owner, condition=self._spelled(said))
                labels[by_which.at(origin.span)] = None
                if origin.call is not None:
                    labels[ComesHere(skill=owner).at(origin.call.span)] = None
        return list(labels)

    def _changed(self, change: WorldChange | None) -> list[Label]:
        if change is None or change.origin.call is None:
            return []
        call = change.origin.call
        return [
            _HOW[change.how].at(change.origin.span),
            CalledHere(skill=call.skill.__name__).at(call.span),
        ]

    def _spelled(self, said: Statement) -> str:
        return spelled(said, self.judge.model)

    # --- keeping ----------------------------------------------------------------------------------

    def _add(
        self,
        template: Template,
        call: SkillCall,
        asked: TreeCondition,
        labels: list[Label],
        known: KnownFacts,
        help: Remark | None,
        *notes: Remark,
        key: object = None,
    ) -> None:
        written = [label for label in dict.fromkeys(labels) if label.span != call.span]
        all_notes = (*notes, *self._notes(asked, known))
        found = template.at(call.span, *written, notes=all_notes, help=help)
        self._keep(found, key or (call.span, asked.statement))

    def _keep(self, found: Diagnostic, key: object) -> None:
        """Keep each finding once, however many paths lead to it."""
        self.found.setdefault((found.code, key), found)


def _has_child(clash: Clash, known: KnownFacts) -> bool:
    """Say whether a child has caused a part of a contradiction."""
    origins = (known.facts.get(said) for said in clash.said)
    return any(origin is not None and origin.call is not None for origin in origins)
