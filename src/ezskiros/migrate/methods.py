"""The methods of primitives, of their base classes, and of compound skills except `expand`."""

from __future__ import annotations

from collections.abc import Callable, Collection

import libcst as cst

from ezskiros.migrate.aliases import without_aliases
from ezskiros.migrate.parameter_uses import ParameterUses
from ezskiros.migrate.skills import MigratedSkill
from ezskiros.migrate.states import MEMBERS, PLACEHOLDER


class Methods(ParameterUses):
    """Translates a part of the class `node`. `states` are its names for SkiROS2's `State`."""

    def __init__(
        self,
        skill: MigratedSkill,
        code: Callable[[cst.CSTNode], str],
        node: cst.ClassDef,
        states: Collection[str] = (),
    ) -> None:
        super().__init__(skill, code)
        self._statements.append(node)
        self._states = states
        self._stays: dict[int, cst.CSTNode] = {}

    def visit_Attribute(self, node: cst.Attribute) -> None:  # noqa: D102, N802
        super().visit_Attribute(node)
        self._stays[id(node.attr)] = node
        is_state = isinstance(node.value, cst.Name) and node.value.value in self._states
        if is_state and node.attr.value not in MEMBERS:
            self._stays[id(node.value)] = node
            self._warn_of(f"{node.value.value}.{node.attr.value}", node)  # type: ignore[attr-defined]

    def visit_Arg(self, node: cst.Arg) -> None:  # noqa: D102, N802
        self._stays[id(node.keyword)] = node

    def visit_Param(self, node: cst.Param) -> None:  # noqa: D102, N802
        self._stays[id(node.name)] = node

    def leave_Name(  # noqa: D102, N802
        self, original_node: cst.Name, updated_node: cst.Name
    ) -> cst.Name:
        is_state = original_node.value in self._states and id(original_node) not in self._stays
        return updated_node.with_changes(value=PLACEHOLDER) if is_state else updated_node

    def leave_Attribute(  # noqa: D102, N802
        self, original_node: cst.Attribute, updated_node: cst.Attribute
    ) -> cst.BaseExpression:
        match updated_node:
            case cst.Attribute(value=cst.Name(value=name), attr=member) if name == PLACEHOLDER:
                return updated_node.with_changes(attr=cst.Name(MEMBERS[member.value]))
            case _:  # open: any other node
                pass
        return super().leave_Attribute(original_node, updated_node)


def translated_part(
    part: cst.CSTNode, uses_of: Callable[[], ParameterUses]
) -> tuple[cst.CSTNode, ParameterUses]:
    """The new part of a class, and the findings about the old part."""
    uses = uses_of()
    new = part.visit(uses)
    if uses.findings and isinstance(part, cst.FunctionDef):
        other = uses_of()
        without = without_aliases(part).visit(other)
        if not other.findings:  # otherwise their places would not exist in the file
            new, uses.findings = without, []
    assert isinstance(new, cst.CSTNode)
    return new, uses
