"""The content of a drawing of a behavior tree, for all drawers: boxes with lines of text."""

from __future__ import annotations

import ast
import enum
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ezskiros.check.spelled import spelled
from ezskiros.drawing.nested import Nested
from ezskiros.ontology.statements import Statement
from ezskiros.ontology.symbols import UnknownValue
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.interface import Clause, SkillInterface
from ezskiros.skills.nodes import Decoration, Decorator, Flow, Node, Processor
from ezskiros.skills.values import Symbol, SymbolicValue
from ezskiros.trees.library import Library
from ezskiros.trees.tree import IndividualReference, Tree, ValueReference

TOKENS = {
    Flow.SERIAL: "->",
    Flow.SERIAL_STAR: "->*",
    Flow.SELECTOR: "?",
    Flow.SELECTOR_STAR: "?*",
    Flow.PARALLEL_FF: "|ff|",
    Flow.PARALLEL_FS: "|fs|",
    Flow.NO_FAIL: "NoFail(->*)",
}
"""The symbols that SkiROS2 prints for its processors."""


class Role(enum.Enum):
    """The role of a line in a box."""

    PASSED = "passed"
    VALUE = "value"
    PRE = "pre"
    HOLD = "hold"
    POST = "post"

    @property
    def is_condition(self) -> bool:
        """Say whether the line contains a pre-, hold- or post-condition."""
        return self in (Role.PRE, Role.HOLD, Role.POST)


@dataclass(frozen=True)
class Line:
    """A line of a box."""

    role: Role
    text: str


@dataclass(frozen=True)
class NodeBox:
    """A node of a tree. `token` is the symbol of a processor or decorator; a skill has none."""

    title: str
    token: str
    lines: tuple[Line, ...]
    children: tuple[NodeBox, ...]


@dataclass(frozen=True)
class Outline:
    """A tree, and the answers in `expandBT` that lead to it, as texts."""

    root: NodeBox
    branch: tuple[str, ...]


def outline(
    tree: Tree, trees: Sequence[Tree], library: Library, *, depth: int, has_conditions: bool
) -> Outline:
    """Outline a tree. Compound skills among `trees` are drawn with their own children, down to
    `depth` levels.
    """
    writer = _Writer(Nested(trees, library), library, has_conditions)
    root = NodeBox(
        f"{tree.skill.name}.{tree.implementation}",
        "",
        tuple(writer.conditions(tree.skill)),
        (writer.box(tree.root, depth, (tree.implementation,)),),
    )
    return Outline(root, branch_texts(tree))


def branch_texts(tree: Tree) -> tuple[str, ...]:
    """The answers that lead to a tree, such as `Speed > 3` or `not (Speed > 3)`."""
    return tuple(_answer(" ".join(span.text.split()), answer) for span, answer in tree.branch)


def _answer(question: str, answer: bool) -> str:
    if answer:
        return question
    return f"not ({question})" if " " in question else f"not {question}"


@dataclass(frozen=True)
class _Writer:
    nested: Nested
    library: Library
    has_conditions: bool

    def box(self, node: Node, depth: int, above: tuple[str, ...]) -> NodeBox:
        """A node with all nodes below it. `above` are the implementations around it."""
        match node:
            case SkillCall():
                return self._skill(node, depth, above)
            case Processor(flow=flow, children=below):
                inside = tuple(self.box(child, depth, above) for child in below)
                return NodeBox(flow.value.lower(), TOKENS[flow], (), inside)
            case Decorator(decoration=decoration, child=child):
                inside = (self.box(child, depth, above),)
                return NodeBox(f"{decoration.value.lower()}{_limit(node)}", "<>", (), inside)

    def _skill(self, call: SkillCall, depth: int, above: tuple[str, ...]) -> NodeBox:
        lines = [*_arguments(call)]
        skill = self.library.skill(call.skill)
        if skill is not None:
            lines += self.conditions(skill)
        found = self.nested.trees_of(call) if depth > 0 else ()
        found = [tree for tree in found if tree.implementation not in above]
        inside = [self.box(tree.root, depth - 1, (*above, tree.implementation)) for tree in found]
        if len(inside) > 1:
            inside = [
                NodeBox(" and ".join(branch_texts(tree)) or "always", "if", (), (box,))
                for tree, box in zip(found, inside, strict=True)
            ]
        name = call.skill.__name__
        title = name if call.implementation is None else f"{name}.{call.implementation}"
        return NodeBox(title, "", tuple(lines), tuple(inside))

    def conditions(self, skill: SkillInterface) -> Iterator[Line]:
        """The conditions of a skill as written in the description, if they are requested."""
        if self.has_conditions:
            for role, clauses in (
                (Role.PRE, skill.pre),
                (Role.HOLD, skill.hold),
                (Role.POST, skill.post),
            ):
                yield from (Line(role, self._condition(clause)) for clause in clauses)

    def _condition(self, clause: Clause) -> str:
        statement: Statement = clause.statement
        ontology = self.library.ontology()
        return spelled(statement, ontology.model) if ontology else clause.span.text


def _limit(node: Decorator) -> str:
    """The text after the symbol of a decorator."""
    unit = " s" if node.decoration is Decoration.TIMEOUT else ""
    match node.limit:
        case None:
            return ""
        case ValueReference(parameter=parameter):
            return f" {parameter.name}{unit}"
        case Symbol():
            return f" ...{unit}"
        case number:
            return f" {number:g}{unit}"


def _arguments(call: SkillCall) -> Iterator[Line]:
    """The values of the parameters of a child, in source order."""
    for name, given in call.arguments.items():
        match given:
            case IndividualReference(parameter=parameter) | ValueReference(parameter=parameter):
                yield Line(Role.PASSED, f"{name} <- {parameter.name}")
            case UnknownValue():
                yield Line(Role.VALUE, f"{name} = ?")
            case SymbolicValue():
                yield Line(Role.PASSED, f"{name} <- {written(call, name)}")
            case enum.Enum():
                yield Line(Role.VALUE, f"{name} = {given}")
            case _:  # open: any other value
                yield Line(Role.VALUE, f"{name} = {given!r}")


def written(call: SkillCall, name: str) -> str:
    """The source expression of an argument, such as `params.Speed * 2`; `...` if it is unclear."""
    text = call.span.text
    try:
        found = ast.parse(text, mode="eval").body
    except SyntaxError:
        return "..."
    keywords = found.keywords if isinstance(found, ast.Call) else []
    values = [each.value for each in keywords if each.arg == name]
    segment = ast.get_source_segment(text, values[0]) if values else None
    return " ".join(segment.split()) if segment else "..."
