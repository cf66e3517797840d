"""The context: the knowledge and the results of the checker while it visits expressions."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property

from dslkit.diagnostics import Collector, Template
from dslkit.source import Span
from rossmarie.check.frames import FrameTree
from rossmarie.check.model import (
    CheckedDoing,
    CheckedInput,
    CheckedMotion,
    CheckedSkills,
    ConditionKey,
    Value,
)
from rossmarie.check.scopes.declarations import ProgramDeclarations
from rossmarie.check.scopes.trees import stripped
from rossmarie.check.wording.suggestions import Suggestions, near_name, suggesting
from rossmarie.core import Region
from rossmarie.syntax import ast
from rossmarie.syntax.node_map import NodeMap
from rossmarie.syntax.walk import walk
from rossmarie.types import MessageCatalog, Type, Unknown
from rossmarie.types import Region as RegionType


@dataclass
class ItemUses:
    """The uses of one condition, rule or declaration. Conditions have their place."""

    inputs: set[str] = field(default_factory=set)
    conditions: dict[ConditionKey, Span] = field(default_factory=dict)


@dataclass
class Context:
    """The state of the checker.

    `types` and `values` become those of `CheckedProgram`. `constants` contains the types of
    constants (their values are in `values`, under the expression of the declaration). `used_names`
    and `used_conditions` are all names and conditions with a reference. `parents` maps each part of
    an expression to the expression whose operand it is.

    `proposed_bounds` are the inputs for which a bound of lists has been suggested. `skills` is the
    skills file, None if there is no usable file; `names_skills` is True if the program names
    one. `doing` contains each query about skills, `regions` the locations of each named class and
    zone, `motions` and `zones` the correct motions and zones, `frames` the frames, and
    `frame_inputs` the inputs for frames, by frame. `entity` and `uses` belong to the current item.
    """

    collector: Collector
    declarations: ProgramDeclarations
    messages: MessageCatalog | None = None
    inputs: dict[str, CheckedInput] = field(default_factory=dict)
    constants: dict[str, Type] = field(default_factory=dict)
    types: NodeMap[Type] = field(default_factory=NodeMap)
    values: NodeMap[Value] = field(default_factory=NodeMap)
    parents: NodeMap[ast.Expression] = field(default_factory=NodeMap)
    used_names: set[str] = field(default_factory=set)
    used_conditions: set[ConditionKey] = field(default_factory=set)
    suggestions: Suggestions = field(default_factory=Suggestions)
    proposed_bounds: set[str] = field(default_factory=set)
    skills: CheckedSkills | None = None
    names_skills: bool = False
    doing: NodeMap[CheckedDoing] = field(default_factory=NodeMap)
    regions: NodeMap[Region] = field(default_factory=NodeMap)
    motions: dict[str, CheckedMotion] = field(default_factory=dict)
    zones: dict[str, tuple[Region, RegionType]] = field(default_factory=dict)
    frames: FrameTree = field(default_factory=FrameTree)
    frame_inputs: dict[str, CheckedInput] = field(default_factory=dict)
    entity: str | None = None
    uses: ItemUses = field(default_factory=ItemUses)

    @cached_property
    def names_used_as_numbers(self) -> frozenset[str]:
        """The names that occur anywhere except after `in`."""
        parts = [
            part
            for expression in self.declarations.expressions()
            for part in walk(expression)
            if isinstance(part, ast.Reference | ast.Membership)
        ]
        ranges = [stripped(part.container) for part in parts if isinstance(part, ast.Membership)]
        return frozenset(_counted(parts) - _counted(ranges))

    @property
    def reported(self) -> dict[str, CheckedInput]:
        """All inputs by name, including the inputs for frames."""
        frames = {each.declaration.name.text: each for each in self.frame_inputs.values()}
        return frames | self.inputs

    def may_suggest(self) -> bool:
        """Say whether to search for the intended name of a misspelt name."""
        return self.suggestions.take(len(self.declarations.names))

    def report_unknown(self, finding: Template, name: ast.Name, known: Iterable[str]) -> None:
        """Report an unknown name, with the known name that the user probably meant."""
        near = near_name(name.text, known) if self.may_suggest() else None
        if near is None:
            self.collector.add(finding.at(name.span))
            return
        self.collector.add(suggesting(finding, name, near))

    def type_of(self, node: ast.Expression) -> Type:
        """The type of a node; `Unknown` if the node was skipped."""
        return self.types[node] if node in self.types else Unknown()

    def folds_around(self, node: ast.Expression) -> dict[str, ast.ListFold]:
        """The folds around a node, if the node is after their colon, by the names of their
        elements.
        """
        found: dict[str, ast.ListFold] = {}
        part, around = node, self.parents.get(node)
        while around is not None:
            if isinstance(around, ast.ListFold) and part is around.body:
                found.setdefault(around.variable.text, around)
            part, around = around, self.parents.get(around)
        return found

    def enter(self, entity: str | None) -> ItemUses:
        """Begin the next condition, rule or declaration. The result records its uses."""
        self.entity = entity
        self.uses = ItemUses()
        return self.uses


def _counted(nodes: Iterable[ast.Expression]) -> Counter[str]:
    """The names in some expressions, each with its number of occurrences."""
    return Counter(node.name.text for node in nodes if isinstance(node, ast.Reference))
