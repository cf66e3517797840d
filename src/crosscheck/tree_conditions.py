"""The conditions of a tree when its rule becomes active, and of the skills that continue after it
(thesis, section 5.2).

The check assumes that other running skills leave the world as these skills need it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from crosscheck.beliefs import Beliefs, Names, Said, UnreadableConditionError
from crosscheck.ontology import RobotOntology, ontology_of
from crosscheck.recovery_errors import (
    ConditionsUnknown,
    EndedHere,
    EndsItsTree,
    KnownHere,
    MayNotGoOn,
    NeededHere,
    NoValueForTree,
    TreeMayNotStart,
    TreeNeverStarts,
)
from crosscheck.releases import is_cleared_by_its_condition
from crosscheck.robot import Robot
from crosscheck.situations import Situation, situations
from crosscheck.trees import TreeRun, skills_below, tree_runs
from dslkit.diagnostics import Diagnostic, Label
from ezskiros.check.inference import names as names_in
from ezskiros.contracts.changing import changed, failed
from ezskiros.contracts.judge import Judge
from ezskiros.contracts.knowledge import How, KnownFacts, Origin, WorldChange
from ezskiros.contracts.statements import renamed
from ezskiros.ontology.statements import Statement
from rossmarie.analysis.inquiry import Inquiry
from rossmarie.skills import Skill, SkillCondition

_REPLAN, _RETRY = "replan", "retry"


def find_tree_conditions(robot: Robot, inquiry: Inquiry) -> Iterator[Diagnostic]:
    """The findings on the trees of all rules, each once. Escalations are left out, because the
    skills that run at that time are unknown.
    """
    runs = [each for each in tree_runs(robot) if each.stage is not None]
    if not runs:
        return
    classes = ontology_of(robot)
    if classes.missing is not None:
        reason = f"`{classes.missing}` cannot be resolved in the ontology"
        yield ConditionsUnknown(reason=reason).at(robot.span_of(None))
        return
    reported: dict[tuple[object, ...], Diagnostic] = {}
    try:
        for run in runs:
            for situation in situations(robot, inquiry, run.rule):
                for found in _Tree(robot, classes, run, situation).findings():
                    reported.setdefault((found.code, found.title, run.task), found)
    except UnreadableConditionError as error:
        yield ConditionsUnknown(reason=str(error)).at(robot.span_of(None))
        return
    yield from reported.values()


@dataclass(frozen=True)
class _Tree:
    """A tree that a rule runs, in one situation."""

    robot: Robot
    classes: RobotOntology
    run: TreeRun
    situation: Situation

    def findings(self) -> Iterator[Diagnostic]:
        """All findings on this tree."""
        yield from self._without_value()
        yield from self._ended_by_itself()
        yield from self._at_start()
        if self.run.afterwards == _RETRY:
            for task in self._tasks():
                conditions = (*task.conditions.pre, *task.conditions.hold)
                yield from self._afterwards(task, conditions, Situation((task,)), _looked_for(task))
        elif self.run.afterwards != _REPLAN:
            for skill in self.situation.skills:
                again = () if skill.children else skill.conditions.pre
                conditions = (*again, *skill.conditions.hold)
                yield from self._afterwards(skill, conditions, self.situation)

    def _without_value(self) -> Iterator[Diagnostic]:
        rule = self.robot.machine.rules[self.run.rule]
        for skill in dict.fromkeys(skill for skill, _ in self.run.passed.values()):
            if not self.situation.has(skill):
                finding = NoValueForTree(rule=rule.name, tree=self.run.skill.name, skill=skill)
                yield finding.at(self.run.task.span)

    def _ended_by_itself(self) -> Iterator[Diagnostic]:
        """The rule queries a primitive that the tree interrupts, and nothing else keeps the rule
        active.
        """
        machine = self.robot.machine
        rule = machine.rules[self.run.rule]
        below = [each.name for each in skills_below(self.robot, self.run.skill)]
        interrupted = (
            each for each in self.situation.skills if not each.children and each.name not in below
        )
        first = next(interrupted, None)
        if first is not None and is_cleared_by_its_condition(machine, rule):
            finding = EndsItsTree(rule=rule.name, tree=self.run.skill.name, skill=first.name)
            yield finding.at(rule.head, EndsItsTree.Runs(tree=finding.tree).at(self.run.task.span))

    # --- at the start of the tree -----------------------------------------------------------------

    def _at_start(self) -> Iterator[Diagnostic]:
        tree = self.run.skill
        beliefs = Beliefs(self.robot, self.classes.iris)
        running = beliefs.names_of_running(self.situation)
        names = beliefs.names_of_tree(self.run, running)
        conditions = (*tree.conditions.pre, *tree.conditions.hold)
        asked = list(beliefs.said(tree, conditions, names))
        held, others, changes = self._facts(beliefs, running)
        judge = Judge(self.classes.ontology.model, beliefs.names)
        before = KnownFacts({**held, **others}, _bound(beliefs, running))
        known = failed(before, changes, judge).assuming(held)
        free = self._free(names, beliefs)
        found = judge.choice(known, [each.statement for each in asked], free)
        unknown = {names[each] for each in tree.parameters if names[each] in free}
        for each in asked:
            statement = renamed(each.statement, found)
            if unknown.isdisjoint(names_in(statement)) and not judge.entails(known, statement):
                yield self._not_known(each, statement, known, judge, beliefs)

    def _facts(
        self, beliefs: Beliefs, running: Mapping[str, Names]
    ) -> tuple[dict[Statement, Origin], dict[Statement, Origin], list[WorldChange]]:
        """The facts that running skills hold, the facts that they needed at their start, and the
        changes that skills in their trees may have made.
        """
        held: dict[Statement, Origin] = {}
        needed: dict[Statement, Origin] = {}
        changes: list[WorldChange] = []
        for skill in self.situation.skills:
            names = running[skill.name]
            held |= beliefs.facts(skill, skill.conditions.hold, names)
            needed |= beliefs.facts(skill, skill.conditions.pre, names)
            changes += beliefs.changes_below(skill, names)
        return held, needed, changes

    def _free(self, names: Names, beliefs: Beliefs) -> list[str]:
        """The names of individuals that the tree looks up when it starts, or that it does not need.
        Nothing is known about them here.
        """
        return [
            names[name]
            for name in self.run.skill.parameters
            if name not in self.run.arguments and names[name] in beliefs.names
        ]

    def _not_known(
        self,
        said: Said,
        statement: Statement,
        known: KnownFacts,
        judge: Judge,
        beliefs: Beliefs,
    ) -> Diagnostic:
        rule = self.robot.machine.rules[self.run.rule].name
        tree, condition = self.run.skill.name, said.condition.text
        needed = NeededHere(skill=tree).at(said.span)
        clash = judge.clash(known, statement)
        if clash is None:
            finding = TreeMayNotStart(
                rule=rule, tree=tree, condition=condition, running=str(self.situation)
            )
            ended = (each for each in known.changes if judge.touches(each.made, statement))
            return finding.at(self.run.task.span, needed, *_ended(next(ended, None), beliefs))
        spans = dict.fromkeys(known.facts[each].span for each in clash.said if each in known.facts)
        labels = [KnownHere(skill=beliefs.owners[span]).at(span) for span in spans]
        never = TreeNeverStarts(rule=rule, tree=tree, condition=condition)
        return never.at(self.run.task.span, needed, *labels)

    # --- after the tree ---------------------------------------------------------------------------

    def _tasks(self) -> Iterator[Skill]:
        """The skills that can be a task, with the running skills in them: no tree contains them."""
        for each in self.robot.skills.skills.values():
            below = [found.name for found in skills_below(self.robot, each)]
            is_around = any(running.name in below for running in self.situation.skills)
            if is_around and not any(True for _ in self.robot.callers(each.name)):
                yield each

    def _afterwards(
        self,
        skill: Skill,
        conditions: Sequence[SkillCondition],
        own: Situation,
        looked_for: Iterable[str] = (),
    ) -> Iterator[Diagnostic]:
        """The conditions of a skill that restarts or continues. `looked_for` are parameters for
        which the skill may find other individuals then.
        """
        beliefs = Beliefs(self.robot, self.classes.iris)
        running = beliefs.names_of_running(own)
        names = beliefs.names_of_tree(self.run, running)
        facts: dict[Statement, Origin] = {}
        for each in own.skills:
            before = (*each.conditions.pre, *each.conditions.hold)
            facts |= beliefs.facts(each, before, running[each.name])
        perhaps = beliefs.changes_below(self.run.skill, names)
        if own is not self.situation:
            perhaps += beliefs.changes_below(skill, running[skill.name])
        done = beliefs.changes(self.run.skill, names, How.DONE)
        judge = Judge(self.classes.ontology.model, beliefs.names)
        known = failed(KnownFacts(facts, _bound(beliefs, running)), perhaps, judge)
        after = changed(known, done, judge)
        free = {running[skill.name][each] for each in looked_for}
        for said in beliefs.said(skill, conditions, running[skill.name]):
            if judge.entails(after, said.statement) or not free.isdisjoint(
                names_in(said.statement)
            ):
                continue
            finding = MayNotGoOn(
                tree=self.run.skill.name,
                skill=skill.name,
                condition=said.condition.text,
                afterwards=self.run.afterwards,
            )
            ended = (each for each in (*perhaps, *done) if judge.touches(each.made, said.statement))
            needed = NeededHere(skill=skill.name).at(said.span)
            yield finding.at(self.run.task.span, needed, *_ended(next(ended, None), beliefs))


def _looked_for(skill: Skill) -> list[str]:
    """The parameters for which a skill finds individuals in the world when it starts."""
    return [name for name, each in skill.parameters.items() if each.is_needed and not each.is_given]


def _bound(beliefs: Beliefs, running: Mapping[str, Names]) -> frozenset[str]:
    """The names of individuals of running skills."""
    names = (name for each in running.values() for name in each.values())
    return frozenset(name for name in names if name in beliefs.names)


def _ended(change: WorldChange | None, beliefs: Beliefs) -> Iterator[Label]:
    if change is not None:
        span = change.origin.span
        yield EndedHere(skill=beliefs.owners[span]).at(span)
