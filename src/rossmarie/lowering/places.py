"""The parts of messages that expressions name, and the elements for which names of folds stand."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from rossmarie import ir
from rossmarie.check.model import CheckedProgram
from rossmarie.check.names.parts import part_at
from rossmarie.check.operations.sectors import sector_between
from rossmarie.lowering.inputs import InputPart
from rossmarie.syntax import ast


class PartPlaces:
    """Finds the parts of messages that expressions of one program name."""

    def __init__(self, program: CheckedProgram) -> None:
        self._program = program
        self._elements: dict[str, InputPart] = {}

    def place(self, node: ast.Expression) -> InputPart | None:
        """The part of a message that an expression names; None if it names something else."""
        match node:
            case ast.Parenthesized(inner=inner):
                return self.place(inner)
            case ast.Reference(name=name) if name.text in self._elements:
                return self._elements[name.text]
            case ast.Reference(name=name):
                used = self._program.symbols.inputs.get(name.text)
                return None if used is None else InputPart(used, part_at(used.base, used.type))
            case ast.Member(value=value, member=member):
                place = self.place(value)
                return (
                    None if place is None else place.field(member.text, self._program.types[node])
                )
            case ast.Index(value=value, index=index):
                place = self.place(value)
                return None if place is None else place.element(index, self._program.types[value])
            case ast.Sector(value=value, arc=arc):
                place = self.place(value)
                return None if place is None else place.sector(self._sector(arc))
            case (
                ast.Number() | ast.Boolean() | ast.Text() | ast.Bracket() | ast.Call()
                | ast.Edges() | ast.Oscillates() | ast.ListFold() | ast.Unary() | ast.Binary()
                | ast.Membership() | ast.Held() | ast.Since() | ast.Once() | ast.Response()
                | ast.Doing() | ast.Broken()
            ):  # fmt: skip
                return None

    def _sector(self, arc: ast.Arc) -> ir.Sector:
        ends = (self._program.values[end].numbers[0] for end in (arc.first, arc.last))
        sector = sector_between(*ends)
        assert sector is not None, "checked: it is a sector"
        return sector

    def element(self, name: str) -> InputPart:
        """The current element, for which the name of a fold stands."""
        return self._elements[name]

    @contextmanager
    def elements_of(self, node: ast.ListFold) -> Iterator[None]:
        """While the context is active, the variable of a fold stands for the current element of its
        list.
        """
        place = self.place(node.list)
        assert place is not None, "checked: it is a list that an input brings"
        self._elements[node.variable.text] = place.each()
        yield
        del self._elements[node.variable.text]
