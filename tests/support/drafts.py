"""Machines written down by hand: a draft grows node by node and becomes a `Machine`.

Every method that adds something returns its index.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from dslkit.source import SourceFile, Span
from rossmarie import ir

SECOND = 1_000_000_000

NOWHERE = Span(SourceFile("draft.ross", "draft\n"), 0, 5)


@dataclass
class Draft:
    """A machine in the making."""

    channels: list[ir.Channel] = field(default_factory=list)
    inputs: list[ir.Input] = field(default_factory=list)
    slots: list[ir.Slot] = field(default_factory=list)
    arrays: list[ir.Array] = field(default_factory=list)
    texts: tuple[str, ...] = ()
    signals: list[ir.Signal] = field(default_factory=list)
    propositions: list[ir.Proposition] = field(default_factory=list)
    rules: list[ir.Rule] = field(default_factory=list)
    lists: list[ir.List] = field(default_factory=list)
    calls: tuple[ir.SkillCall, ...] = ()

    def channel(self) -> int:
        topic = f"/topic_{len(self.channels)}"
        self.channels.append(ir.Channel(topic, "std_msgs/Float64"))
        return len(self.channels) - 1

    def skill_channel(self) -> int:
        """A channel that tells which skills run."""
        topic = f"/skills_{len(self.channels)}"
        self.channels.append(ir.Channel(topic, "skill_context_msgs/SkillContext"))
        return len(self.channels) - 1

    def input(self, channel: int, timeout_ns: int | None = None) -> int:
        name = f"input_{len(self.inputs)}"
        self.inputs.append(ir.Input(name, channel, timeout_ns, NOWHERE))
        return len(self.inputs) - 1

    def slot(
        self,
        used: int,
        kind: ir.FieldKind = ir.FieldKind.REAL,
        scale: float = 1.0,
        offset: float = 0.0,
        limits: tuple[float, float] | None = None,
    ) -> int:
        path = (f"slot_{len(self.slots)}",)
        self.slots.append(ir.Slot(used, path, kind, scale, offset, "", limits))
        return len(self.slots) - 1

    def query(self, used: int, step: ir.SkillStep) -> int:
        """A slot that is a query to the skills that run."""
        is_flag = isinstance(step, ir.Doing) or step.is_boolean
        kind = ir.FieldKind.FLAG if is_flag else ir.FieldKind.REAL
        self.slots.append(ir.Slot(used, (step,), kind, 1.0, 0.0, ""))
        return len(self.slots) - 1

    def array(
        self,
        used: int,
        scale: float = 1.0,
        offset: float = 0.0,
        limits: tuple[float, float] | None = None,
    ) -> int:
        path = (f"array_{len(self.arrays)}",)
        self.arrays.append(ir.Array(used, path, scale, offset, "", limits))
        return len(self.arrays) - 1

    def list_of(self, used: int, most: int, *, of_points: bool = False) -> int:
        path: ir.Path = (f"list_{len(self.lists)}",)
        self.lists.append(ir.List(used, (*path, ir.POINTS) if of_points else path, most))
        return len(self.lists) - 1

    def column(
        self,
        its_list: int,
        kind: ir.FieldKind = ir.FieldKind.REAL,
        scale: float = 1.0,
        offset: float = 0.0,
        limits: tuple[float, float] | None = None,
    ) -> int:
        used, path = self.lists[its_list].input, self.lists[its_list].path
        path = (*path, ir.EACH, f"column_{len(self.arrays)}")
        self.arrays.append(ir.Array(used, path, scale, offset, "", limits, kind, its_list))
        return len(self.arrays) - 1

    def signal(
        self,
        node: ir.SignalNode,
        text: str | None = None,
        unit: str = "",
        scale: float = 1.0,
        offset: float = 0.0,
    ) -> int:
        shown = f"signal_{len(self.signals)}" if text is None else text
        self.signals.append(ir.Signal(node, shown, unit, scale, offset, NOWHERE))
        return len(self.signals) - 1

    def constant(self, value: float) -> int:
        return self.signal(ir.Constant(value), repr(value))

    def apply(self, function: ir.AnyFunction, *operands: int) -> int:
        return self.signal(ir.Apply(function, operands))

    def read(self, timeout_ns: int | None = None, kind: ir.FieldKind = ir.FieldKind.REAL) -> int:
        """A signal that reads a slot of an input on a channel of its own."""
        return self.signal(ir.Read(self.slot(self.input(self.channel(), timeout_ns), kind)))

    def elements(self, timeout_ns: int | None = None) -> int:
        """A signal that stands for the elements of an array on a channel of its own."""
        return self.signal(ir.Element(self.array(self.input(self.channel(), timeout_ns))))

    def proposition(
        self, node: ir.PropositionNode, name: str | None = None, text: str | None = None
    ) -> int:
        shown = f"proposition_{len(self.propositions)}" if text is None else text
        self.propositions.append(ir.Proposition(node, name, shown, NOWHERE))
        return len(self.propositions) - 1

    def above(self, signal: int, limit: float) -> int:
        return self.proposition(ir.Compare(ir.Comparison.GREATER, signal, self.constant(limit)))

    def rule(self, condition: int, release: int | None = None, *, latched: bool = False) -> int:
        """A rule; released as soon as its condition is false if nothing else is said."""
        if release is None and not latched:
            release = self.proposition(ir.Literal(True))
        machine = self.machine()
        rule = ir.Rule(
            name=f"rule_{len(self.rules) + 1}",
            condition=condition,
            release=None if latched else release,
            actions=("stop",),
            contract="clears by contract",
            documentation=None,
            terms=ir.rule_terms(machine, condition),
            signals=ir.rule_signals(machine, condition),
            inputs=tuple(sorted(ir.supports(machine).propositions[condition].inputs)),
            span=NOWHERE,
            head=NOWHERE,
        )
        self.rules.append(rule)
        return len(self.rules) - 1

    def machine(self, name: str = "draft") -> ir.Machine:
        return ir.Machine(
            name,
            tuple(self.channels),
            tuple(self.inputs),
            tuple(self.slots),
            tuple(self.arrays),
            self.texts,
            tuple(self.signals),
            tuple(self.propositions),
            tuple(self.rules),
            lists=tuple(self.lists),
            calls=self.calls,
        )
