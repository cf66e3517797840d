"""Queries about the running skills, as flags of the message about them.

One query has two forms (S59). If the context is stale, the query of a rule is stale, and the query
of an exemption is false. The latter uses an input without a timeout.
"""

from __future__ import annotations

from collections.abc import Container

from rossmarie import ir
from rossmarie.check.model import CheckedDoing, CheckedInput, CheckedProgram, CheckedSkills
from rossmarie.check.names.parts import MessagePart
from rossmarie.ir.duration_text import duration_text
from rossmarie.lowering.inputs import InputLowering, InputPart
from rossmarie.lowering.nodes import Nodes, Shown
from rossmarie.syntax import ast
from rossmarie.types import Boolean

CONTEXT = "skill_context"
"""The name of the input for queries of rules. The name of the other input adds `_kept`."""


class SkillLowering:
    """Lowers queries about skills. Equal queries share a slot."""

    def __init__(self, program: CheckedProgram, inputs: InputLowering, nodes: Nodes) -> None:
        self._program = program
        self._inputs = inputs
        self._nodes = nodes

    def asked(self, node: ast.Doing) -> int:
        """The proposition that the skill runs; stale if the last message about skills is too
        old.
        """
        return self._flag(node, self._context(CONTEXT, self._skills.timeout_ns))

    def kept(self, node: ast.Doing) -> int:
        """The proposition that the skill runs and the last message about skills is not too old;
        else false.
        """
        used = self._context(f"{CONTEXT}_kept", None)
        timeout_ns = self._skills.timeout_ns
        timeout = duration_text(timeout_ns)
        late = self._nodes.leaf(
            ir.AgeReaches(self._inputs.input(used), timeout_ns),
            Shown(f"no skills reported for {timeout}", node.span),
        )
        fresh = self._nodes.negation(late, Shown(f"skills reported within {timeout}", node.span))
        text = Shown(f"{self.text(node)}, as reported in time", node.span)
        return self._nodes.conjunction((self._flag(node, used), fresh), text)

    def text(self, node: ast.Doing) -> str:
        """A query in the notation of the rules."""
        return self._found(node).text

    def permits(self, node: ast.Doing) -> tuple[str, ...]:
        """The permissions of the requested skill, in words."""
        return self._found(node).permits

    def _found(self, node: ast.Doing) -> CheckedDoing:
        return self._program.doing[node]

    @property
    def _skills(self) -> CheckedSkills:
        assert self._program.skills is not None, "checked: rules that ask name a file"
        return self._program.skills

    def _flag(self, node: ast.Doing, used: CheckedInput) -> int:
        found = self._found(node)
        file = self._skills.file
        step = ir.Doing(file.digest, found.skills, found.arguments, node.is_ahead, found.text)
        slot = self._inputs.slot(InputPart(used, MessagePart((step,))), Boolean())
        shown = Shown(found.text, node.span)
        return self._nodes.leaf(ir.Flag(self._nodes.signal(ir.Read(slot), shown)), shown)

    def _context(self, name: str, timeout_ns: int | None) -> CheckedInput:
        """The context as an input, which no rule declares."""
        file = self._skills.file
        free = _free(name, self._program.symbols.inputs)
        topic = ast.Name(file.topic, self._skills.declaration.path.span)
        declaration = ast.Input(
            ast.Name(free, topic.span), topic, None, (), None, None, None, None, topic.span
        )
        return CheckedInput(declaration, file.topic, file.message_type, (), Boolean(), timeout_ns)


def _free(name: str, taken: Container[str]) -> str:
    while name in taken:
        name += "_"
    return name
