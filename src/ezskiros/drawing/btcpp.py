"""Behavior trees as XML for BehaviorTree.CPP, version 4, and its editor Groot2.

Each SkiROS2 processor becomes the node that has the same results tick by tick (see `_CONTROLS`). A
skill is an action, a nested compound skill a subtree. Parameters are ports: a passed parameter is a
blackboard entry, `{GraspPose}`, and a constant is written directly. Subtrees have their own
blackboards, while SkiROS2 has one set of names for all. So all shared names are passed. Conditions
have no counterpart: they are notes in the model of each node.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from dslkit.diagnostics import Collector, Diagnostic
from dslkit.source import Span
from ezskiros.drawing import errors
from ezskiros.drawing.btcpp_models import BUILT_IN, literal, model_of
from ezskiros.drawing.nested import Nested
from ezskiros.drawing.outline import branch_texts
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.interface import Parameter, SkillInterface
from ezskiros.skills.nodes import Decoration, Decorator, Flow, Node, Processor, calls
from ezskiros.skills.values import Symbol, SymbolicValue
from ezskiros.trees.library import Library
from ezskiros.trees.names import shared_names
from ezskiros.trees.tree import IndividualReference, Tree, ValueReference

_CONTROLS: Mapping[Flow, tuple[str, Mapping[str, str]]] = {
    Flow.SERIAL: ("ReactiveSequence", {}),
    Flow.SERIAL_STAR: ("Sequence", {}),
    Flow.SELECTOR: ("ReactiveFallback", {}),
    Flow.SELECTOR_STAR: ("Fallback", {}),
    Flow.PARALLEL_FF: ("Parallel", {"success_count": "-1", "failure_count": "1"}),
    Flow.PARALLEL_FS: ("Parallel", {"success_count": "1", "failure_count": "1"}),
    Flow.NO_FAIL: ("Sequence", {}),
}
"""`SequenceWithMemory` is not used: after a failure it continues at the failed child."""
_Below = tuple[Tree, tuple[str, ...]]
"""A tree, and the implementations around it, including its own."""
_MOST_TRIES, _MOST_MILLISECONDS = 2**31 - 1, 2**32 - 1


def export(
    trees: Sequence[Tree], known: Sequence[Tree], library: Library, *, depth: int
) -> tuple[str, Sequence[Diagnostic]]:
    """The XML of some trees of one skill, and the findings. After an error, the XML must not be
    used.

    Compound skills among the `known` trees are written with their content, down to `depth` levels.
    """
    writer = _Writer(Nested(known, library), library)
    writer.choose(trees, depth)
    root = ET.Element("root", BTCPP_format="4")
    names = _names(trees)
    writer.names = {*names, *writer.inside}
    for name, tree in zip(names, trees, strict=True):
        if len(trees) == 1:
            root.set("main_tree_to_execute", name)
        if tree.branch:
            root.append(ET.Comment(_comment(" if " + " and ".join(branch_texts(tree)) + " ")))
        writer.write(tree, name, root)
    for name, tree in writer.inside.items():
        writer.write(tree, name, root)
    models = ET.SubElement(root, "TreeNodesModel")
    models.extend(writer.models[name] for name in sorted(writer.models))
    ET.indent(root)
    text = ET.tostring(root, encoding="unicode", xml_declaration=False)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n', writer.found.sorted()


@dataclass
class _Writer:
    nested: Nested
    library: Library
    inside: dict[str, Tree] = field(default_factory=dict)
    """The compound skills that are written as subtrees, by subtree name."""
    models: dict[str, ET.Element] = field(default_factory=dict)
    names: set[str] = field(default_factory=set)
    """The names of trees, which no action may use."""
    found: Collector = field(default_factory=Collector)

    def choose(self, trees: Sequence[Tree], depth: int) -> None:
        """Choose the compound skills that become subtrees. Such a skill is a subtree wherever it is
        called.
        """
        level: list[_Below] = [(tree, (tree.implementation,)) for tree in trees]
        for _ in range(depth):
            below: list[_Below] = []
            for tree, above in level:
                for call in calls(tree.root):
                    below += self._chosen(call, above)
            level = below

    def _chosen(self, call: SkillCall, above: tuple[str, ...]) -> Iterator[_Below]:
        trees = self.nested.trees_of(call)
        name = trees[0].implementation if trees else ""
        if name in above:
            self.found.add(errors.CallsItself(skill=name).at(call.span))
        elif len(trees) > 1:
            self.found.add(errors.SeveralTrees(skill=name).at(call.span))
        elif trees:
            self.inside.setdefault(name, trees[0])
            yield trees[0], (*above, name)

    # --- trees ------------------------------------------------------------------------------------

    def write(self, tree: Tree, name: str, root: ET.Element) -> None:
        """Write a tree, with its model and those of its skills."""
        self._name(name, tree.span)
        self.models[name] = self._model("SubTree", name, tree.skill)
        self._node(tree.root, ET.SubElement(root, "BehaviorTree", ID=name))

    def _node(self, node: Node, above: ET.Element) -> None:
        match node:
            case SkillCall():
                self._skill(node, above)
            case Processor(flow=flow, children=below):
                element, ports = _CONTROLS[flow]
                if flow is Flow.NO_FAIL:
                    above = ET.SubElement(above, "ForceSuccess")
                here = ET.SubElement(above, element, {"name": flow.value, **ports})
                for child in below:
                    self._node(child, here)
            case Decorator(child=child):
                element, ports = self._decorator(node)
                self._node(child, ET.SubElement(above, element, ports))

    def _decorator(self, node: Decorator) -> tuple[str, dict[str, str]]:
        limit = node.limit
        if limit is None:
            return "Inverter", {}
        is_retry = node.decoration is Decoration.RETRY
        if is_retry and isinstance(limit, ValueReference):
            return "RetryUntilSuccessful", {"num_attempts": f"{{{limit.parameter.name}}}"}
        if isinstance(limit, Symbol):
            computed = errors.ComputedLimit(decorator=node.decoration.value.lower())
            self.found.add(computed.at(node.span))
            limit = 1
        most = _MOST_TRIES if is_retry else _MOST_MILLISECONDS / 1000
        if limit > most:
            large = errors.LimitTooLarge(decorator=node.decoration.value.lower())
            self.found.add(large.at(node.span))
            limit = most
        if is_retry:
            return "RetryUntilSuccessful", {"num_attempts": str(int(limit))}
        # 0 would mean no timeout
        return "Timeout", {"msec": str(max(1, math.ceil(limit * 1000)))}

    def _skill(self, call: SkillCall, above: ET.Element) -> None:
        skill = self.library.skill(call.skill)
        if skill is None:  # a description without content, which is an error already
            return
        trees = self.nested.trees_of(call)
        name = trees[0].implementation if trees else ""
        if name in self.inside:
            if self._leads_to(self.inside[name], name, frozenset()):
                self.found.add(errors.CallsItself(skill=name).at(call.span))
                return
            ports = {"ID": name, **self._passed_on(self.inside[name])}
            ports |= self._ports(call, skill, is_inside=True)
            ET.SubElement(above, "SubTree", ports)
            return
        name = call.implementation or skill.name
        self._name(name, call.span)
        if name in self.names:
            self.found.add(errors.CallsItself(skill=name).at(call.span))
        self.models[name] = self._model("Action", name, skill)
        ET.SubElement(above, name, self._ports(call, skill, is_inside=False))

    def _leads_to(self, tree: Tree, wanted: str, seen: frozenset[str]) -> bool:
        """Say whether a subtree is below a tree."""
        for call in calls(tree.root):
            inner = self.nested.trees_of(call)
            name = inner[0].implementation if inner else ""
            if name not in self.inside or name in seen:
                continue
            if name == wanted or self._leads_to(inner[0], wanted, seen | {name}):
                return True
        return False

    def _passed_on(self, tree: Tree, seen: frozenset[str] = frozenset()) -> dict[str, str]:
        """The names that a subtree shares with its surroundings, besides its own parameters."""
        found: dict[str, str] = {}
        for call in calls(tree.root):
            skill = self.library.skill(call.skill)
            for shared in shared_names(call, skill) if skill else ():
                found[shared.shared] = f"{{{shared.shared}}}"
            inner = self.nested.trees_of(call)
            name = inner[0].implementation if inner else ""
            if name in self.inside and name not in seen:
                deeper = self._passed_on(inner[0], seen | {name})
                found |= {each: text for each, text in deeper.items() if each not in call.arguments}
        return found

    # --- ports ------------------------------------------------------------------------------------

    def _ports(self, call: SkillCall, skill: SkillInterface, *, is_inside: bool) -> dict[str, str]:
        """The values that each parameter of a child gets."""
        found = {each.parameter.name: f"{{{each.shared}}}" for each in shared_names(call, skill)}
        for parameter in skill.parameters:
            self._port_name(parameter)
            given = call.arguments.get(parameter.name, parameter.default)
            if isinstance(given, SymbolicValue) and not isinstance(given, ValueReference):
                computed = errors.ComputedArgument(parameter=parameter.name)
                self.found.add(computed.at(call.span))
            elif given is not None and not isinstance(given, (IndividualReference, ValueReference)):
                found[parameter.name] = self._literal(given, parameter, call.span, is_inside)
        return {each.name: found[each.name] for each in skill.parameters if each.name in found}

    def _literal(self, given: object, parameter: Parameter, span: Span, is_inside: bool) -> str:
        text, why = literal(given, parameter, is_inside=is_inside)
        if why:
            self.found.add(errors.NoLiteral(text=repr(given), why=why).at(span))
        return text

    # --- models -----------------------------------------------------------------------------------

    def _model(self, kind: str, name: str, skill: SkillInterface) -> ET.Element:
        for parameter in skill.parameters:
            self._port_name(parameter)
        return model_of(kind, name, skill, self.library.ontology())

    def _port_name(self, parameter: Parameter) -> None:
        first = parameter.name[0]
        if not (first.isascii() and first.isalpha()) or parameter.name in ("name", "ID"):
            no_port = errors.NoPort(spelled=parameter.name).at(parameter.span)
            if no_port not in self.found.sorted():
                self.found.add(no_port)

    def _name(self, name: str, span: Span) -> None:
        if name in BUILT_IN:
            self.found.add(errors.TakenName(spelled=name).at(span))


def _names(trees: Sequence[Tree]) -> list[str]:
    """The names of trees: the names of their implementations, with a number if an implementation
    has several trees.
    """
    bare = [tree.implementation for tree in trees]
    return [
        name if bare.count(name) == 1 else f"{name}_{number}" for number, name in enumerate(bare, 1)
    ]


def _comment(text: str) -> str:
    """A text that XML allows in comments."""
    return text.replace("--", "- -")
