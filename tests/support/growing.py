"""A machine that grows by one random node at a time, by the rules that `ir.verify` checks."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.core import (
    Circle,
    Polygon,
    Rectangle,
    Region,
    RegionFunction,
    RegionMeasure,
    row,
    sampling_row,
)
from support.drafts import SECOND, Draft
from support.skill_contexts import QUERIES, calls_reported

TICK = SECOND // 10

NUMBERS = (-2.0, -1.0, -0.5, -0.0, 0.0, 0.25, 0.5, 1.0, 1.5, 2.0, 3.0)
EXTREMES = (5e-324, 1e-200, 1e200, -1e200, 1.7e308, -1.7e308, 0.1, 1 / 3)

durations = st.integers(1, 8).map(lambda ticks: ticks * TICK)
timeouts = st.one_of(st.none(), durations)
finite = st.one_of(st.sampled_from(NUMBERS), st.sampled_from(NUMBERS + EXTREMES))
scales = st.sampled_from(((1.0, 0.0), (1.0, 0.0), (0.5, 0.0), (1.0, 0.25), (1e150, -1.0)))

equalities = st.sampled_from((ir.Comparison.EQUAL, ir.Comparison.NOT_EQUAL))
whole_limits = st.sampled_from((None, None, None, (0.0, 1.0), (-2.0, 2.0), (0.0, 2.0**64)))


def _polygon(name: str, *corners: tuple[float, float]) -> Polygon:
    return Polygon(name, f"polygon {name}", corners)


_L = ((-1.0, -1.0), (2.0, -1.0), (2.0, 0.25), (0.5, 0.25), (0.5, 3.0), (-1.0, 3.0))
_TRIANGLE = ((0.5, 0.0), (5.0, 1.0), (1.0, 1.5))
_STAR = tuple(
    (radius * math.cos(turn), radius * math.sin(turn))
    for radius, turn in ((1.0 + number % 2, math.pi * number / 15) for number in range(30))
)
_BOX = Rectangle("box", "a box", (-1.0, -0.5), (0.25, 1.0))
_CIRCLE = Circle("circle", "a circle", (1.0, 0.5), 0.5)
regions = st.sampled_from(
    (
        Region("ell", "an L", (_polygon("l", *_L),)),
        Region("both", "two", (_polygon("l", *_L), _polygon("triangle", *_TRIANGLE))),
        Region("post", "a point", (_polygon("point", (0.25, -0.5)),)),
        Region("star", "a star", (_polygon("star", *_STAR),)),
        Region("round", "a circle", (_CIRCLE,)),
        Region("zone", "a zone", (_BOX, _CIRCLE, _polygon("triangle", *_TRIANGLE))),
    )
)

FUNCTIONS = [each for each in ir.Function if each not in (ir.Function.RAISED, ir.Function.LOWERED)]
"""The functions of any numbers; the other two are of parameters of a node alone (S87)."""


class Growing:
    """Adds one random node at a time to a draft."""

    def __init__(self, draw: st.DrawFn) -> None:
        self.draw = draw
        self.draft = Draft(texts=("docked", "driving"))
        self.numbers: list[int] = [self.draft.constant(1.0)]
        self.element_numbers: dict[int, list[int]] = {}
        self.element_texts: dict[int, list[int]] = {}
        self.propositions: list[int] = []
        self.queries: list[int] = []

    def one_of(self, choices: Sequence[int]) -> int:
        # Later nodes are preferred a little, so that machines grow deep as well as wide.
        return self.draw(st.one_of(st.sampled_from(choices), st.sampled_from(choices[-3:])))

    def inputs(self) -> None:
        for _ in range(self.draw(st.integers(1, 3))):
            self.draft.channel()
        for channel in range(len(self.draft.channels)):
            for _ in range(self.draw(st.integers(1, 2))):
                used = self.draft.input(channel, self.draw(timeouts))
                self._fields(used)
        if self.draw(st.booleans()):
            self._skills()

    def _skills(self) -> None:
        """The context of skills, by one or two inputs that ask, the same at times. At times nothing
        is known of which answers go together.
        """
        channel = self.draft.skill_channel()
        for _ in range(self.draw(st.integers(1, 2))):
            used = self.draft.input(channel, self.draw(timeouts))
            for step in self.draw(st.lists(st.sampled_from(QUERIES), max_size=3, unique=True)):
                slot = self.draft.query(used, step)
                if isinstance(step, ir.Doing):
                    self.queries.append(slot)
                elif not step.is_boolean:
                    self.numbers.append(self.draft.signal(ir.Read(slot)))
        steps = [slot.path[0] for slot in self.draft.slots if isinstance(slot.path[0], ir.Doing)]
        self.draft.calls = calls_reported(steps) if self.draw(st.booleans()) else ()

    def _fields(self, used: int) -> None:
        # Of an input without fields only the age is read.
        kinds = st.sampled_from(
            (*ir.FieldKind, ir.FieldKind.REAL, ir.FieldKind.REAL, "array", "list")
        )
        for kind in self.draw(st.lists(kinds, max_size=3)):
            scale, offset = self.draw(scales)
            limits = self.draw(whole_limits)
            if kind == "list":
                self._list(used)
            elif isinstance(kind, str):
                array = self.draft.array(used, scale, offset, limits)
                self.element_numbers[array] = [self.draft.signal(ir.Element(array))]
            elif kind is ir.FieldKind.REAL:
                slot = self.draft.slot(used, kind, scale, offset, limits)
                self.numbers.append(self.draft.signal(ir.Read(slot)))
            else:
                self.draft.slot(used, kind)

    def _list(self, used: int) -> None:
        """A list of one or more columns; the first one has numbers."""
        of_points = self.draw(st.booleans())
        its_list = self.draft.list_of(used, self.draw(st.integers(1, 3)), of_points=of_points)
        first: int | None = None
        kinds = st.just(False) if of_points else st.booleans()
        for is_text in (False, *self.draw(st.lists(kinds, max_size=2))):
            scale, offset = self.draw(scales)
            settings = () if is_text else (scale, offset, self.draw(whole_limits))
            kind = ir.FieldKind.TEXT if is_text else ir.FieldKind.REAL
            column = self.draft.column(its_list, kind, *settings)
            first = column if first is None else first
            known = self.element_texts if is_text else self.element_numbers
            known.setdefault(first, []).append(self.draft.signal(ir.Element(column)))

    # --- signals ---

    def signal(self) -> None:
        grow = [self._constant, self._apply, self._apply, self._rate, self._previous]
        grow += [self._timed]
        if self.element_numbers:
            grow += [self._fold, self._fold, self._count]
        if self._slots_of(ir.FieldKind.TEXT):
            grow += [self._distance, self._seen]
        self.numbers.append(self.draw(st.sampled_from(grow))())

    def _constant(self) -> int:
        return self.draft.constant(self.draw(finite))

    def _apply(self) -> int:
        function = self.draw(st.sampled_from(FUNCTIONS))
        operands = [self.one_of(self.numbers) for _ in range(self._arity(function))]
        return self.draft.apply(function, *operands)

    def _arity(self, function: ir.Function) -> int:
        declared = row(function)
        return self.draw(st.integers(declared.least, declared.most or 3))

    def _distance(self) -> int:
        return self._of_region(RegionMeasure.DISTANCE)

    def _seen(self) -> int:
        """Any number, where a text says a frame (S77)."""
        slot = self.draw(st.sampled_from(self._slots_of(ir.FieldKind.TEXT)))
        seen = self.draft.signal(ir.Read(slot))
        wanted = self.draft.constant(float(self.draw(st.integers(0, 1))))
        return self.draft.apply(ir.Function.SEEN, self.one_of(self.numbers), seen, wanted)

    def _of_region(self, measure: RegionMeasure, x: int | None = None) -> int:
        """A function of a region, of any two numbers, with a text for their frame; with `x`, of the
        element at hand.
        """
        function = RegionFunction(measure, self.draw(regions))
        slot = self.draw(st.sampled_from(self._slots_of(ir.FieldKind.TEXT)))
        point = [self.one_of(self.numbers), self.one_of(self.numbers)]
        if x is not None:
            point = [x, self._beside()]
        seen = self.draft.signal(ir.Read(slot))
        wanted = self.draft.constant(float(self.draw(st.integers(0, 1))))
        return self.draft.apply(function, *point, seen, wanted)

    def _slots_of(self, kind: ir.FieldKind) -> list[int]:
        return [index for index, slot in enumerate(self.draft.slots) if slot.kind is kind]

    def _rate(self) -> int:
        return self.draft.signal(ir.Sampled(ir.Sampling.RATE, self.one_of(self.numbers)))

    def _previous(self) -> int:
        return self.draft.signal(ir.Sampled(ir.Sampling.PREVIOUS, self.one_of(self.numbers)))

    def _timed(self) -> int:
        timed = [each for each in ir.Sampling if sampling_row(each).takes_time]
        function = self.draw(st.sampled_from(timed))
        window_ns = self.draw(durations)
        return self.draft.signal(ir.Sampled(function, self.one_of(self.numbers), window_ns))

    def _fold(self) -> int:
        folding = self.draw(st.sampled_from(ir.Folding))
        return self.draft.signal(ir.Fold(folding, self._element_number(self._array())))

    def _count(self) -> int:
        return self.draft.signal(ir.Count(self._element_proposition(self._array())))

    # --- elements ---

    def _beside(self) -> int:
        """A constant, or a number of slots that may stand beside elements."""
        may_stand = ir.stand_beside(self.draft.machine())
        numbers = [index for index in self.numbers if may_stand[index]]
        return self.draw(st.sampled_from((self.one_of(numbers), self._constant())))

    def _array(self) -> int:
        return self.draw(st.sampled_from(sorted(self.element_numbers)))

    def _element_number(self, array: int) -> int:
        known = self.element_numbers[array]
        if self.draw(st.booleans()):
            return self.one_of(known)
        if self._slots_of(ir.FieldKind.TEXT) and self.draw(st.integers(0, 3)) == 0:
            known.append(self._of_region(RegionMeasure.DISTANCE, self.one_of(known)))
            return known[-1]
        function = self.draw(st.sampled_from(FUNCTIONS))
        operands = [self._beside() for _ in range(self._arity(function))]
        operands[self.draw(st.integers(0, len(operands) - 1))] = self.one_of(known)
        operands[self.draw(st.integers(0, len(operands) - 1))] = self.one_of(known)
        known.append(self.draft.apply(function, *operands))
        return known[-1]

    def _element_proposition(self, array: int, depth: int = 2) -> int:
        shapes = ["compare", "between", "flag", "not", "and", "or"] if depth else ["compare"]
        if array in self.element_texts:
            shapes += ["text", "text"]
        match self.draw(st.sampled_from(shapes)):
            case "text":
                text = self.draw(st.sampled_from(self.element_texts[array]))
                literal = self.draft.constant(float(self.draw(st.integers(0, 1))))
                return self.draft.proposition(ir.Compare(self.draw(equalities), text, literal))
            case "between":
                ends = sorted((self.draw(finite), self.draw(finite)))
                low, high = (self.draft.constant(end) for end in ends)
                if self.draw(st.integers(0, 3)) == 0:
                    low, high = self._beside(), self._beside()
                number = self._element_number(array)
                return self.draft.proposition(ir.Between(number, low, high))
            case "flag":
                return self.draft.proposition(ir.Flag(self.element_numbers[array][0]))
            case "not":
                return self.draft.proposition(ir.Not(self._element_proposition(array, depth - 1)))
            case ("and" | "or") as word:
                operands = tuple(self._element_proposition(array, depth - 1) for _ in range(2))
                return self.draft.proposition(
                    ir.And(operands) if word == "and" else ir.Or(operands)
                )
            case _:
                comparison = self.draw(st.sampled_from(ir.Comparison))
                number = self._element_number(array)
                return self.draft.proposition(ir.Compare(comparison, number, self._beside()))

    # --- propositions ---

    def proposition(self) -> None:
        grow = [self._compare, self._compare, self._between, self._age, self._oscillates]
        if self.element_numbers:
            grow += [self._quantified, self._quantified]
        if any(slot.kind is not ir.FieldKind.REAL for slot in self.draft.slots):
            grow += [self._flag_or_text]
        if self._slots_of(ir.FieldKind.TEXT):
            grow += [self._inside]
        if self.propositions:
            grow += [self._not, self._and, self._or, self._held, self._held, self._literal]
            grow += [self._since]
            grow += [self._recurs, self._recurs]
        if self.queries:
            grow += [self._doing, self._kept]
        self.propositions.append(self.draw(st.sampled_from(grow))())

    def _name(self) -> str | None:
        return f"entity.c{len(self.draft.propositions)}" if self.draw(st.booleans()) else None

    def _add(self, node: ir.PropositionNode) -> int:
        return self.draft.proposition(node, self._name())

    def _literal(self) -> int:
        return self._add(ir.Literal(self.draw(st.booleans())))

    def _compare(self) -> int:
        comparison = self.draw(st.sampled_from(ir.Comparison))
        left = self.one_of(self.numbers)
        right = self.one_of([*self.numbers, self._constant()])
        return self._add(ir.Compare(comparison, left, right))

    def _between(self) -> int:
        low, high = self.one_of(self.numbers), self.one_of(self.numbers)
        return self._add(ir.Between(self.one_of(self.numbers), low, high))

    def _age(self) -> int:
        used = self.draw(st.integers(0, len(self.draft.inputs) - 1))
        return self._add(ir.AgeReaches(used, self.draw(durations) + self.draw(st.integers(0, 1))))

    def _oscillates(self) -> int:
        swing = self.draw(st.sampled_from((0.0, 0.5)))
        count = self.draw(st.integers(1, 3))
        signal = self.one_of(self.numbers)
        return self._add(ir.Oscillates(signal, count, self.draw(durations), swing))

    def _quantified(self) -> int:
        quantifier = self.draw(st.sampled_from(ir.Quantifier))
        return self._add(ir.Quantified(quantifier, self._element_proposition(self._array())))

    def _flag_or_text(self) -> int:
        slots = [i for i, slot in enumerate(self.draft.slots) if slot.kind is not ir.FieldKind.REAL]
        slot = self.draw(st.sampled_from(slots))
        read = self.draft.signal(ir.Read(slot))
        if self.draft.slots[slot].kind is ir.FieldKind.FLAG:
            return self._add(ir.Flag(read))
        comparison = self.draw(equalities)
        text = self.draft.constant(float(self.draw(st.integers(0, 1))))
        return self._add(ir.Compare(comparison, read, text))

    def _inside(self) -> int:
        return self._add(ir.Flag(self._of_region(RegionMeasure.INSIDE)))

    def _doing(self) -> int:
        slot = self.draw(st.sampled_from(self.queries))
        return self._add(ir.Flag(self.draft.signal(ir.Read(slot))))

    def _kept(self) -> int:
        """An exemption rests on this: a skill runs, as reported in time (S59)."""
        slot = self.draw(st.sampled_from(self.queries))
        flag = self._add(ir.Flag(self.draft.signal(ir.Read(slot))))
        late = self._add(ir.AgeReaches(self.draft.slots[slot].input, self.draw(durations)))
        return self._add(ir.And((flag, self._add(ir.Not(late)))))

    def _not(self) -> int:
        return self._add(ir.Not(self.one_of(self.propositions)))

    def _operands(self) -> tuple[int, ...]:
        return tuple(self.one_of(self.propositions) for _ in range(self.draw(st.integers(2, 3))))

    def _and(self) -> int:
        return self._add(ir.And(self._operands()))

    def _or(self) -> int:
        return self._add(ir.Or(self._operands()))

    def _recurs(self) -> int:
        count = self.draw(st.integers(1, 3))
        return self._add(ir.Recurs(self.one_of(self.propositions), count, self.draw(durations)))

    def _held(self) -> int:
        initially = self.draw(st.booleans())
        return self._add(ir.Held(self.one_of(self.propositions), self.draw(durations), initially))

    def _since(self) -> int:
        return self._add(ir.Since(self.one_of(self.propositions), self.one_of(self.propositions)))

    def rule(self) -> None:
        if bool(self.queries) and self.draw(st.booleans()):
            self._exempted()
            return
        condition = self.one_of(self.propositions)
        match self.draw(st.sampled_from(("at once", "when", "for", "latched"))):
            case "at once":
                self.draft.rule(condition)
            case "when":
                self.draft.rule(condition, self.one_of(self.propositions))
            case "for":
                opposite = self.draft.proposition(ir.Not(condition))
                calm = self.draft.proposition(ir.Held(opposite, self.draw(durations)))
                self.draft.rule(condition, calm)
            case _:
                self.draft.rule(condition, latched=True)

    def _exempted(self) -> None:
        """A rule, and the one that stands for an exemption of it (S60)."""
        condition = self.one_of(self.propositions)
        calm = self._not() if self.draw(st.booleans()) else None
        parts = (condition, self._add(ir.Not(self._doing())))
        exempted = self.draft.rule(self._add(ir.And(parts)), calm)
        used = self.draft.rule(self._add(ir.And((condition, self._kept()))))
        exemption = ir.Exemption(self.draft.rules[exempted].name, "doing Push", ())
        self.draft.rules[used] = replace(self.draft.rules[used], exempts=exemption)
