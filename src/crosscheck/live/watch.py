"""The observation of a running robot: messages in, changes and findings out.

This module knows nothing about ROS and has no clock. Each message has its time of arrival in
seconds of a monotonic clock, and `pass_time` reports that time passes without a message.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from crosscheck.live import errors
from crosscheck.live.facts import Facts
from crosscheck.live.model import (
    Alive,
    ChangeKind,
    LiveChange,
    Message,
    NodeState,
    RunningCall,
    RunningContext,
)
from crosscheck.live.sources import LiveSource
from crosscheck.live.tally import StateCount, Tally
from dslkit.diagnostics import Diagnostic, Severity, Template, listed
from dslkit.source import Span

NODE_PATIENCE = 3.0
"""The seconds after which a node counts as silent. It reports diagnostics once a second."""

Reported = LiveChange | Diagnostic
_Call = tuple[str, str]
"""A skill, and the name of its call."""


class Watch:
    """The state of a robot while it runs."""

    def __init__(self, facts: Facts, start: float) -> None:
        self._facts, self.start, self.now = facts, start, start
        self._context = LiveSource(facts.timeout, start)
        self._node = LiveSource(NODE_PATIENCE, start)
        self._exempted: frozenset[str] = frozenset()
        self._taken: frozenset[tuple[str, str, str]] = frozenset()
        self._reported: set[type[Template]] = set()
        self.skills: Tally[_Call] = Tally()
        self.rules: Tally[str] = Tally()
        self.takings: dict[tuple[str, str, str], int] = {}
        """The number of times that a rule took a resource from a skill, by these three names."""
        self.findings = 0
        self.has_errors = False

    # --- events -----------------------------------------------------------------------------------

    def take(self, at: float, message: Message) -> list[Reported]:
        """Process a message. Returns everything new in it."""
        return [*self.pass_time(at), *self._counted(self._take(message))]

    def _take(self, message: Message) -> Iterator[Reported]:
        match message:
            case RunningContext():
                yield from self._take_context(message)
            case NodeState():
                yield from self._take_state(message)
            case Alive():
                if self._node.has_spoken:
                    self._node.speaks(self.now)

    def pass_time(self, at: float) -> list[Reported]:
        """Let time pass. Returns everything new that needs no message."""
        self.now = max(self.now, at)
        return self._counted(self._silences())

    def _silences(self) -> Iterator[Reported]:
        context, node = self._context.silence(self.now), self._node.silence(self.now)
        if context is not None:
            yield from self._context_is_silent(context)
        if node is not None:
            yield from self._node_is_silent(node)

    def pause(self, seconds: float) -> None:
        """Exclude a time in which this process did not listen."""
        self._context.heard += seconds
        self._node.heard += seconds

    def end(self, at: float) -> list[Reported]:
        """End the observation, and return everything new. A source without any message is reported,
        however short the observation was.
        """
        found = self.pass_time(at)
        if not self._context.has_spoken:
            found += self._counted(self._context_is_silent(self.now - self.start))
        if not self._node.has_spoken:
            found += self._counted(self._node_is_silent(self.now - self.start))
        for call in list(self.skills.since):
            self.skills.end(call, self.now)
        for rule in list(self.rules.since):
            self.rules.end(rule, self.now)
        return found

    def count(self, rule: str) -> StateCount:
        """Count how often a rule was active, and for how long."""
        return self.rules.counts.get(rule, StateCount())

    # --- skills -----------------------------------------------------------------------------------

    def _take_context(self, context: RunningContext) -> Iterator[Reported]:
        self._context.speaks(self.now)
        yield from self._over(errors.SilentContext, f"{self._facts.topic} is reported again")
        yield from self._unusable(context)
        if context.problem is not None:
            yield from self._forget_skills(self.now)
            return
        running = {(each.skill, each.goal): each for each in context.running}
        for call in [each for each in self.skills.since if each not in running]:
            yield self._ends(call)
        for call, each in running.items():
            if call not in self.skills.since:
                yield self._starts(each)
        yield from self._not_exported()
        yield from self._compare_takings()

    def _unusable(self, context: RunningContext) -> Iterator[Reported]:
        digest = self._facts.robot.skills.digest
        reason = context.problem
        if reason is None and context.digest != digest:
            reason = f"it is of another export, {_short(context.digest)}"
        if reason is None:
            yield from self._over(errors.UnusableContext, f"{self._facts.topic} is of this export")
            return
        wrong = errors.UnusableContext(
            topic=self._facts.topic, reason=reason, digest=_short(digest)
        )
        yield from self._tell(errors.UnusableContext, wrong.at(self._facts.declaration))

    def _starts(self, running: RunningCall) -> LiveChange:
        self.skills.begin((running.skill, running.goal), running.skill, self.now)
        arguments = ", ".join(f"{name} = {value}" for name, value in running.arguments)
        text = f"{running.skill} starts" + (f": {arguments}" if arguments else "")
        return LiveChange(
            ChangeKind.SKILL_STARTS, text, {"skill": running.skill, "goal": running.goal}
        )

    def _ends(self, call: _Call) -> LiveChange:
        text = f"{call[0]} ends after {self.skills.end(call, self.now):.3g} s"
        return LiveChange(ChangeKind.SKILL_ENDS, text, {"skill": call[0], "goal": call[1]})

    def _not_exported(self) -> Iterator[Reported]:
        known = self._facts.robot.skills.skills
        unknown = sorted({skill for skill, _ in self.skills.since if skill not in known})
        if unknown:
            found = errors.NotExported(skills=listed(unknown))
            yield from self._tell(errors.NotExported, found.at(self._facts.declaration))
        else:
            yield from self._over(errors.NotExported, "the rules know all running skills")

    def _context_is_silent(self, seconds: float) -> Iterator[Reported]:
        facts = self._facts
        silent = errors.SilentContext(topic=facts.topic, seconds=seconds, timeout=facts.timeout)
        yield from self._tell(errors.SilentContext, silent.at(facts.declaration))
        yield from self._forget_skills(self._context.heard)

    def _forget_skills(self, at: float) -> Iterator[LiveChange]:
        """Forget the running skills, which were known until a time."""
        for call in list(self.skills.since):
            self.skills.end(call, at)
            text = f"it is unknown whether {call[0]} still runs"
            yield LiveChange(ChangeKind.UNKNOWN, text, {"skill": call[0], "goal": call[1]})
        self._taken = frozenset()

    # --- rules ------------------------------------------------------------------------------------

    def _take_state(self, state: NodeState) -> Iterator[Reported]:
        self._node.speaks(self.now)
        yield from self._over(errors.SilentNode, f"{self._facts.node} reports again")
        yield from self._other_rules(state)
        active = [each for each in state.active if each in self._facts.rules]
        for rule in [each for each in self.rules.since if each not in active]:
            yield self._clears(rule)
        for rule in active:
            if rule not in self.rules.since:
                yield self._activates(rule)
        yield from self._operators(frozenset(state.exempted) & self._facts.rules.keys())
        yield from self._compare_takings()

    def _other_rules(self, state: NodeState) -> Iterator[Reported]:
        others = sorted({*state.active, *state.exempted} - self._facts.rules.keys())
        if others:
            wrong = errors.OtherRules(node=self._facts.node, rules=listed(others))
            yield from self._tell(errors.OtherRules, wrong.at(self._facts.declaration))
        else:
            yield from self._over(errors.OtherRules, f"{self._facts.node} reports these rules")

    def _activates(self, name: str) -> LiveChange:
        self.rules.begin(name, name, self.now)
        exempts = self._facts.rules[name].exempts
        if exempts is None:
            return LiveChange(ChangeKind.RULE_ACTIVATES, f"{name} is active", {"rule": name})
        permitted = self._facts.permitted(name, (skill for skill, _ in self.skills.since))
        text = f"{name} is used: {exempts.rule} is not applied, as {permitted}"
        return LiveChange(
            ChangeKind.EXEMPTION_BEGINS, text, {"rule": name, "exempted": exempts.rule}
        )

    def _clears(self, name: str) -> LiveChange:
        lasted = self.rules.end(name, self.now)
        exempts = self._facts.rules[name].exempts
        if exempts is None:
            return LiveChange(
                ChangeKind.RULE_CLEARS, f"{name} clears after {lasted:.3g} s", {"rule": name}
            )
        text = f"{name} is no longer used, after {lasted:.3g} s"
        return LiveChange(ChangeKind.EXEMPTION_ENDS, text, {"rule": name, "exempted": exempts.rule})

    def _operators(self, exempted: frozenset[str]) -> Iterator[LiveChange]:
        for name in sorted(self._exempted - exempted):
            text = f"the operator no longer exempts {name}"
            yield LiveChange(ChangeKind.OPERATOR_ENDS, text, {"rule": name})
        for name in sorted(exempted - self._exempted):
            yield LiveChange(
                ChangeKind.OPERATOR_EXEMPTS, f"the operator exempts {name}", {"rule": name}
            )
        self._exempted = exempted

    def _node_is_silent(self, seconds: float) -> Iterator[Reported]:
        silent = errors.SilentNode(node=self._facts.node, seconds=seconds)
        rules = Span(self._facts.robot.modules[-1].file, 0, 0)
        yield from self._tell(errors.SilentNode, silent.at(rules))
        for rule in list(self.rules.since):
            self.rules.end(rule, self._node.heard)
            text = f"it is unknown whether {rule} is still active"
            yield LiveChange(ChangeKind.UNKNOWN, text, {"rule": rule})
        self._taken = frozenset()

    # --- both -------------------------------------------------------------------------------------

    def _compare_takings(self) -> Iterator[LiveChange]:
        """Compare the resources that active rules take with those that running skills need."""
        machine = self._facts.robot.machine
        found = {
            (machine.rules[each.rule].name, each.use.name, skill): each
            for skill in sorted({skill for skill, _ in self.skills.since})
            for each in self._facts.takings.get(skill, ())
            if machine.rules[each.rule].name in self.rules.since
        }
        for key, taking in found.items():
            if key not in self._taken:
                self.takings[key] = self.takings.get(key, 0) + 1
                rule, resource, skill = key
                text = f"{rule} takes {resource} from {skill} ({taking.task.span})"
                yield LiveChange(
                    ChangeKind.TAKES, text, {"rule": rule, "resource": resource, "skill": skill}
                )
        self._taken = frozenset(found)

    # --- findings ---------------------------------------------------------------------------------

    def _tell(self, kind: type[Template], found: Diagnostic) -> Iterator[Diagnostic]:
        """Report a finding, unless it was reported before and is not over."""
        if kind not in self._reported:
            self._reported.add(kind)
            yield found

    def _over(self, kind: type[Template], text: str) -> Iterator[LiveChange]:
        if kind in self._reported:
            self._reported.remove(kind)
            yield LiveChange(ChangeKind.OVER, text, {"code": kind.code})

    def _counted(self, found: Iterable[Reported]) -> list[Reported]:
        reported = [*found]
        wrong = [each for each in reported if isinstance(each, Diagnostic)]
        self.findings += len(wrong)
        self.has_errors |= any(each.severity is Severity.ERROR for each in wrong)
        return reported


def _short(digest: str) -> str:
    """The beginning of a digest, for people who compare digests."""
    return f"{digest[:12]}..." if len(digest) > 12 else digest or "(none)"
