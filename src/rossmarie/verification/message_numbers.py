"""Obligations about the numbers of a monitor after a message: they have the right values.

The input is the definitions of a machine; the result is C obligations.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rossmarie.ir import model as ir
from rossmarie.verification import fields, supports
from rossmarie.verification.definitions import Definitions, converted
from rossmarie.verification.layout import ProofLayout
from rossmarie.verification.program import obligation
from rossmarie.verification.turning_points import followed


class MessageNumbers:
    """Writes these obligations for one machine."""

    def __init__(self, layout: ProofLayout, definitions: Definitions) -> None:
        self._layout = layout
        self._machine = layout.machine
        self._definitions = definitions
        self._beside = supports.beside(layout.machine)

    def meant(self, channel: int, names: Sequence[str], counts: Sequence[str]) -> list[str]:
        """The obligations about the numbers that a message on a channel determines. `names` are the
        names of its fields.
        """
        return [
            *self._arrived(channel, names, counts),
            *self._computed(channel),
            *self._tests(channel),
            *self._samples(channel),
            *followed(self._layout, self._definitions, channel),
        ]

    def _fields(self, channel: int) -> tuple[fields.CField, ...]:
        return fields.fields_of(self._layout, channel)

    def _arrived(self, channel: int, names: Sequence[str], counts: Sequence[str]) -> Iterator[str]:
        """S7; watched numbers may be kept as received until they are read (S4)."""
        named = {
            field.array: name
            for field, name in zip(self._fields(channel), names, strict=True)
            if field.array is not None
        }
        for field, name, count in zip(self._fields(channel), names, counts, strict=True):
            if field.count is not None:
                assert field.array is not None, "only arrays have elements"
                columns = supports.columns(self._machine, field.array)
                memory = ["m"] if columns[0] in self._beside.arrays else []
                found = [*memory, *(named[column] for column in columns), count]
                arguments = ", ".join(found)
                yield from self._folded(columns[0], arguments)
            if field.slot is None:
                continue
            slot = self._machine.slots[field.slot]
            kept = f"spec_finite(m->value[{self._layout.places.value_of_slot[field.slot]}])"
            meant = f"spec_finite({converted(name, slot.scale, slot.offset)})"
            path = ".".join(map(str, slot.path))
            yield obligation(f"spec_same({kept}, {meant})", f"{path} is kept in SI units")

    def _folded(self, array: int, arguments: str) -> Iterator[str]:
        """S23 to S25, S53; `array` may be the first column of a list."""
        for index, signal in enumerate(self._machine.signals):
            if self._folds(signal.node, array):
                kept = f"m->value[{self._layout.value_of_signal[index]}]"
                meant = f"spec_fold_{index}({arguments})"
                yield obligation(
                    f"spec_same({kept}, {meant})", f"`{signal.text}` has its defined value"
                )
        for proposition, value in self._layout.places.value_of_test.items():
            node = self._machine.propositions[proposition].node
            if not isinstance(node, ir.Quantified):
                continue
            if self._layout.elements.propositions[node.element] == array:
                meant = f"spec_quantified_{proposition}({arguments})"
                text = self._machine.propositions[proposition].text
                about = f"`{text}` has its defined value"
                yield obligation(f"spec_same(m->value[{value}], {meant})", about)

    def _folds(self, node: ir.SignalNode, array: int) -> bool:
        match node:
            case ir.Fold(element=element):
                return self._layout.elements.signals[element] == array
            case ir.Count(element=element):
                return self._layout.elements.propositions[element] == array
            case ir.Constant() | ir.Read() | ir.Apply() | ir.Sampled() | ir.Element():
                return False

    def _computed(self, channel: int) -> Iterator[str]:
        covered = self._layout.places.kept_raw
        for index in self._definitions.computed():
            if channel in self._layout.support_of_signal(index).channels:
                value = self._layout.value_of_signal[index]
                kept = f"m->value[{value}]"
                if value in covered and not self._definitions.is_never_infinite(index):
                    kept = f"spec_finite({kept})"
                about = f"`{self._machine.signals[index].text}` has its defined value"
                yield obligation(f"spec_same({kept}, spec_signal_{index}(m))", about)

    def _tests(self, channel: int) -> Iterator[str]:
        """Comparisons are kept as numbers: 0, 1 or unknown."""
        for proposition, value in self._layout.places.value_of_test.items():
            is_here = channel in self._layout.support_of_proposition(proposition).channels
            if is_here and not isinstance(
                self._machine.propositions[proposition].node, ir.Quantified
            ):
                kept, meant = f"m->value[{value}]", f"spec_proposition_{proposition}(m, t_ns)"
                known = f"{kept} == ({meant} == TRUE ? 1.0 : 0.0)"
                text = self._machine.propositions[proposition].text
                about = f"`{text}` has its defined value"
                yield obligation(f"{meant} >= UNKNOWN ? isnan({kept}) : {known}", about)

    def _samples(self, channel: int) -> Iterator[str]:
        """S18: the samples that the message adds."""
        for k, signal in enumerate(self._layout.sampled):
            if channel in self._layout.support_of_signal(signal).channels:
                text = self._machine.signals[signal].text
                kept = f"old.latest_ns[{k}] == t_ns ? old.before"
                taken = (
                    f"m->latest_ns[{k}] == t_ns && "
                    f"spec_same(m->latest[{k}], {self._definitions.number(signal)}) && "
                    f"spec_same(m->before[{k}], {kept}[{k}] : old.latest[{k}])"
                )
                yield obligation(taken, f"the samples of `{text}` are kept (S18)")
                instant = f"m->before_ns[{k}] == ({kept}_ns[{k}] : old.latest_ns[{k}])"
                about = f"the instant of the sample of `{text}` before is kept (S18)"
                yield obligation(f"isnan(m->before[{k}]) || {instant}", about)
