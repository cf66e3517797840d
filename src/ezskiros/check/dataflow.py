"""Data flow: the values that the children of a behavior tree read and write, on all paths through
the tree.

A failed child has written nothing, because outputs are only passed on after success.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from dslkit.diagnostics import DeclaredHere, Diagnostic
from dslkit.source import Span
from ezskiros.check import tree_errors as errors
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.interface import Parameter, SkillInterface
from ezskiros.skills.markers import ParameterKind
from ezskiros.skills.nodes import Decoration, Decorator, Flow, Node, Processor, calls
from ezskiros.skills.syntax import set_in
from ezskiros.trees.library import Library
from ezskiros.trees.names import Shared, all_shared
from ezskiros.trees.tree import Tree, ValueReference

_SEQUENCES = {Flow.SERIAL, Flow.SERIAL_STAR}
_SELECTORS = {Flow.SELECTOR, Flow.SELECTOR_STAR}
_PARALLELS = {Flow.PARALLEL_FF, Flow.PARALLEL_FS}

Names = frozenset[str]
Known = Names | None
"""The names that certainly have a value at a point; None for an unreachable point."""


@dataclass(frozen=True)
class After:
    """The names that certainly have a value after a node, by the result of the node."""

    success: Known
    failure: Known


def check_dataflow(tree: Tree, library: Library) -> Iterator[Diagnostic]:
    """Report values that are read but never written, or written but never read."""
    flow = _Dataflow(tree, library)
    after = flow.after(tree.root, tree.given | set(_known(tree.skill))).success
    yield from flow.found
    for parameter in tree.skill.parameters:
        if parameter.is_output and after is not None and parameter.name not in after:
            found = errors.OutputMissing(skill=tree.skill.name, parameter=parameter.name)
            yield found.at(tree.span, DeclaredHere().at(parameter.span))
    yield from flow.unread()


def _known(skill: SkillInterface) -> Iterator[str]:
    """The names that have a value when the compound starts."""
    yield from skill.unclear
    for parameter in skill.parameters:
        has_value = parameter.kind is not ParameterKind.OPTIONAL or parameter.default is not None
        if not parameter.is_output and has_value:
            yield parameter.name


def writes(call: SkillCall, parameter: Parameter, library: Library) -> bool:
    """Say whether a child may set the value of a parameter. This is true if the skill declares an
    output, or if the parameter is optional and an implementation sets it, as SkiROS2 skills often
    do.
    """
    if parameter.is_output or parameter.kind is not ParameterKind.OPTIONAL:
        return parameter.is_output
    doing = library.doing(call)
    sets = any(parameter.name in set_in(each) or hasattr(each, "expandBT") for each in doing)
    return sets or not doing


def reads(parameter: Parameter) -> bool:
    """Say whether the skill requires a value."""
    return (
        parameter.kind is ParameterKind.REQUIRED
        and parameter.default is None
        and not parameter.is_output
    )


@dataclass
class _Dataflow:
    """One walk through a tree."""

    tree: Tree
    library: Library
    found: list[Diagnostic] = field(default_factory=list)
    _writers: dict[str, SkillCall] = field(default_factory=dict)
    _read: set[str] = field(default_factory=set)

    def after(self, node: Node, before: Known) -> After:
        """The names that certainly have a value after a node, given the names that have a value
        before it.
        """
        if isinstance(node, Decorator) and isinstance(node.limit, ValueReference):
            self._limited(node, node.limit.parameter)
        match node:
            case SkillCall():
                return After(self._after_skill(node, before), before)
            case Decorator(decoration=Decoration.INVERTER, child=child):
                inner = self.after(child, before)
                return After(inner.failure, inner.success)
            case Decorator(decoration=Decoration.TIMEOUT, child=child):
                return After(self.after(child, before).success, before)  # stopped at any point
            case Decorator(decoration=Decoration.RETRY, child=child):
                return self.after(child, before)
            case Processor(flow=flow, children=children) if flow in _SEQUENCES:
                return self._after_sequence(children, before)
            case Processor(flow=flow, children=children) if flow in _SELECTORS:
                return self._after_selector(children, before)
            case Processor(flow=flow, children=children) if flow in _PARALLELS:
                return self._after_parallel(flow, children, before)
            case Processor(flow=Flow.NO_FAIL, children=children):
                inner = self._after_sequence(children, before)
                return After(_in_all([inner.success, inner.failure]), None)
            case Decorator() | Processor():
                raise AssertionError(node)

    def _limited(self, node: Decorator, given: Parameter) -> None:
        """Report a time limit that may have no value when the tree is built with the decorator."""
        if given.name in self.tree.given | set(_known(self.tree.skill)):
            return
        nothing = errors.MayBeNothing(
            skill=node.decoration.value.lower(),
            parameter="count" if node.decoration is Decoration.RETRY else "seconds",
            given=given.name,
        )
        self.found.append(nothing.at(node.span, DeclaredHere().at(given.span)))

    def _after_sequence(self, children: Iterable[Node], before: Known) -> After:
        failures = []
        for child in children:
            inner = self.after(child, before)
            failures.append(inner.failure)
            before = inner.success
        return After(before, _in_all(failures))

    def _after_selector(self, children: Iterable[Node], before: Known) -> After:
        successes = []
        for child in children:
            inner = self.after(child, before)
            successes.append(inner.success)
            before = inner.failure
        return After(_in_all(successes), before)

    def _after_parallel(self, flow: Flow, children: Sequence[Node], before: Known) -> After:
        if before is not None:
            before |= self._races(children)
        inner = [self.after(child, before) for child in children]
        successes = [each.success for each in inner]
        if flow is Flow.PARALLEL_FS:
            return After(_in_all(successes), _in_all([each.failure for each in inner]))
        all_at_once = (
            None if None in successes else frozenset[str]().union(*filter(None, successes))
        )
        return After(all_at_once, before)

    def _after_skill(self, call: SkillCall, before: Known) -> Known:
        if before is None:
            return None
        after = set(before)
        for shared in self._shared(call):
            if reads(shared.parameter):
                self._read.add(shared.shared)
                if shared.shared not in before:
                    self.found.append(self._unwritten(call, shared))
            elif writes(call, shared.parameter, self.library):
                if shared.parameter.is_output:
                    self._writers.setdefault(shared.shared, call)
            elif shared.parameter.kind is ParameterKind.INFERRED:
                self._read.add(shared.shared)  # it was given, or the world model provides it
            else:
                continue
            after.add(shared.shared)
        return frozenset(after)

    def _shared(self, call: SkillCall) -> Iterable[Shared]:
        return all_shared(call, self.library)

    def _unwritten(self, call: SkillCall, shared: Shared) -> Diagnostic:
        """The finding for a value that is read but not written, or not written on all paths."""
        parameter = shared.parameter
        labels = [DeclaredHere().at(parameter.span)]
        skill = call.skill.__name__
        writer = self._writer_before(shared.shared, call)
        own = self.tree.skill.parameter(shared.shared)
        if writer is None and own is not None and not own.is_output:
            nothing = errors.MayBeNothing(skill=skill, parameter=parameter.name, given=own.name)
            return nothing.at(call.span, *labels, nothing.Optional().at(own.span))
        if writer is None:
            missing = errors.MissingArgument(skill=skill, parameter=parameter.name)
            return missing.at(call.span, *labels)
        found = errors.NotWrittenOnAllPaths(skill=skill, parameter=parameter.name)
        labels.append(found.Writer().at(writer.span))
        return found.at(call.span, *labels)

    def _writer_before(self, name: str, call: SkillCall) -> SkillCall | None:
        """A child that writes a name elsewhere in the tree."""
        for other in calls(self.tree.root):
            if other is not call and any(
                each.shared == name
                and (
                    each.parameter.kind is ParameterKind.INFERRED
                    or writes(other, each.parameter, self.library)
                )
                for each in self._shared(other)
            ):
                return other
        return None

    def _races(self, children: Iterable[Node]) -> Names:
        """Report values that one child of a parallel writes while another child reads them."""
        reported = set()
        by_child = [list(calls(child)) for child in children]
        for index, own in enumerate(by_child):
            others = [call for other in by_child[:index] + by_child[index + 1 :] for call in other]
            written = dict(self._written(others))
            for call in own:
                for shared in self._shared(call):
                    writer = written.get(shared.shared)
                    if writer is not None and reads(shared.parameter):
                        self._tell_race(call, writer, shared)
                        reported.add(shared.shared)
        return frozenset(reported)

    def _tell_race(self, call: SkillCall, writer: SkillCall, shared: Shared) -> None:
        found = errors.ReadBesides(
            skill=call.skill.__name__, parameter=shared.parameter.name,
            writer=writer.skill.__name__,
        )  # fmt: skip
        self.found.append(found.at(call.span, found.Writer().at(writer.span)))

    def _written(self, those: Iterable[SkillCall]) -> Iterator[tuple[str, SkillCall]]:
        for call in those:
            for shared in self._shared(call):
                if writes(call, shared.parameter, self.library):
                    yield shared.shared, call

    def unread(self) -> Iterator[Diagnostic]:
        """Report outputs that no node uses."""
        own: Mapping[str, Span] = {each.name: each.span for each in self.tree.skill.parameters}
        for name, call in self._writers.items():
            if name not in self._read and name not in own:
                found = errors.WrittenNeverRead(skill=call.skill.__name__, parameter=name)
                yield found.at(call.span)


def _in_all(outcomes: Iterable[Known]) -> Known:
    """The names that have a value on all reachable paths; None if there is no such path."""
    paths = [each for each in outcomes if each is not None]
    return frozenset.intersection(*paths) if paths else None
