"""Values for the fields of messages that make conditions true or false, found with z3.

The model has no time: every `for` equals its operand. Fields are real numbers in SI. An angle of an
orientation, a rate, a previous sample, an age, an oscillation and a count of edges are variables of
their own. `phases` and `propose` turn these variables into messages. The past of a `since` is also
a variable; earlier values bring it about. Every result is only a proposal, which the interpreter
judges.

This module is therefore not an `analysis.encoding.Encoding`, which models whether each proposition
is T, F or S and whether each number is known. Here everything is known, and a proposition is one
formula, which stays small enough for many queries. Comparisons, functions and fields are the same
terms in both.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import z3

from rossmarie import ir
from rossmarie.analysis.calls import Calls
from rossmarie.analysis.fields import field_facts, kind_facts, ramp_facts
from rossmarie.analysis.formulas import Formulas, exactly
from rossmarie.analysis.solver import Satisfiability, ask
from rossmarie.analysis.terms import constant, constants_in, exact_number, extreme, holds, within
from rossmarie.core import (
    AnyFunction,
    Function,
    RegionFunction,
    Sampling,
    defined,
    rounds,
    row,
    sampling_row,
)
from rossmarie.core.expressions import Operand, Primitive
from rossmarie.ir.path import extent
from rossmarie.testing.beams import angle, coordinate, is_column, list_of_share, sides
from rossmarie.testing.goals import ComparisonEdge, edges
from rossmarie.testing.shown_units import unit_of_edge, unit_of_field
from rossmarie.testing.variables import Ramp, Values, Variable
from rossmarie.testing.whole import slot_behind
from rossmarie.testing.wishes import Patience, Wishes
from rossmarie.testing.zones import clear_of
from rossmarie.units import Unit

_MOST_ELEMENTS = 8
_CLEAR = 10  # the number of steps that other values keep from their thresholds
_CHOSEN = {Sampling.RATE: "rate", Sampling.PREVIOUS: "previous"}
"""Functions of samples with variables of their own. All others are computed for a constant
number.
"""
_ANGLES = {Function.ROLL: "roll", Function.PITCH: "pitch", Function.YAW: "yaw"}


@dataclass
class RuleFormulas:
    """The formulas of one rule, and its variables.

    A world that `is_free` allows everything that is possible, and more: computed numbers have any
    value, and a `for` has any value. So its impossibilities are real impossibilities. In other
    worlds, `ramp` describes the messages that produce a rate.
    """

    machine: ir.Machine
    propositions: Sequence[int]
    is_free: bool = False
    ramp: Ramp | None = None
    variables: dict[Variable, z3.ArithRef] = field(default_factory=dict)
    units: dict[Variable, Unit] = field(default_factory=dict)
    _side: list[z3.BoolRef] = field(default_factory=list)
    _signals: dict[int, z3.ArithRef] = field(default_factory=dict)
    _patience: Patience = field(default_factory=Patience)
    _outside: dict[tuple[int, int | None], z3.BoolRef] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.length = self._length()
        self.calls = Calls(self.machine, "world")
        for proposition in self.propositions:
            self.formula(proposition)

    def _length(self) -> int:
        """The length of arrays: enough elements for all counts, within the bounds of lists."""
        found = [
            edge for proposition in self.propositions for edge in edges(self.machine, proposition)
        ]
        nodes = [self.machine.signals[each.signal].node for each in found]
        pairs = zip(found, nodes, strict=True)
        counted = [each.threshold for each, node in pairs if isinstance(node, ir.Count)]
        chosen = [
            extent(slot.path[-1])[1]
            for slot in self.machine.slots
            if slot.path and isinstance(slot.path[-1], int | ir.Listed)
        ]
        wanted = int(max([0.0, *counted])) + 1 + bool(counted)
        bounds = [each.most for each in self.machine.lists]
        return min(_MOST_ELEMENTS, max([wanted, *chosen]), *bounds)

    # --- formulas ----------------------------------------------------------------------------

    def formula(
        self, proposition: int, fixed: Mapping[int, bool] | None = None, part: int | None = None
    ) -> z3.BoolRef:
        """A proposition as a formula. Operands in `fixed` are replaced by their values. `part` is
        the index of the present element.
        """
        if fixed is not None and proposition in fixed:
            return z3.BoolVal(fixed[proposition])
        match self.machine.propositions[proposition].node:
            case ir.Literal(value=value):
                return z3.BoolVal(value)
            case ir.Not(operand=operand):
                return z3.Not(self.formula(operand, fixed, part))
            case ir.And(operands=operands):
                return z3.And([self.formula(each, fixed, part) for each in operands])
            case ir.Or(operands=operands):
                return z3.Or([self.formula(each, fixed, part) for each in operands])
            case ir.Quantified() if self.is_free:
                return self._bool(Variable("free", proposition))
            case (ir.Held() | ir.Since()) as node:
                return self._over_time(proposition, node, fixed)
            case ir.AgeReaches(input=used):
                return self._bool(Variable("aged", used))
            case ir.Oscillates() | ir.Recurs():
                return self._bool(Variable("oscillating", proposition))
            case ir.Quantified(quantifier=quantifier, element=element):
                is_any = quantifier is ir.Quantifier.ANY
                parts = self._of_elements(element)
                return z3.Or(parts) if is_any else z3.And(parts)
            case (ir.Compare() | ir.Between() | ir.Flag()) as node:
                values = [self.signal(signal, part) for signal in ir.compared_signals(node)]
                return holds(node, values)

    def _over_time(
        self, proposition: int, node: ir.Held | ir.Since, fixed: Mapping[int, bool] | None
    ) -> z3.BoolRef:
        if self.is_free:
            return self._bool(Variable("free", proposition))
        if isinstance(node, ir.Held):
            return self.formula(node.operand, fixed)
        held, begun = self.formula(node.held, fixed), self.formula(node.begun, fixed)
        return z3.Or(begun, z3.And(held, self._bool(Variable("remembered", proposition))))

    def _of_elements(self, proposition: int) -> list[z3.BoolRef]:
        return [self.formula(proposition, part=part) for part in range(self.length)]

    def signal(self, index: int, part: int | None = None) -> z3.ArithRef:
        """A number as a term. `part` is the index of the present element."""
        if part is None and index in self._signals:
            return self._signals[index]
        term = self._term(index, part)
        if part is None:
            self._signals[index] = term
        return term

    def _term(self, index: int, part: int | None) -> z3.ArithRef:
        match self.machine.signals[index].node:
            case ir.Constant(value=value):
                return constant(value)
            case ir.Read(slot=slot):
                return self._slot(slot)
            case ir.Element(array=array):
                its_list = self.machine.arrays[array].list
                if (
                    its_list is None
                    or self.is_free
                    or not is_column(self.machine.arrays[array], "angle")
                ):
                    return self._real(Variable("element", array, part or 0))
                return angle(self._side_of(its_list), part or 0)
            case ir.Sampled(function=function, signal=signal):
                if function in _CHOSEN:
                    return self._real(Variable(_CHOSEN[function], index))
                if self.is_free:
                    return self._real(Variable("free number", index))
                at_rest = sampling_row(function).at_rest(Operand(0))
                return Formulas([self.signal(signal)], exactly).term(at_rest)
            case ir.Fold() | ir.Count() if self.is_free:
                return self._real(Variable("free number", index))
            case ir.Fold(folding=folding, element=element):
                least = folding is ir.Folding.MINIMUM
                values = [self.signal(element, each) for each in range(self.length)]
                return extreme(values, least=least)
            case ir.Count(element=element):
                parts = self._of_elements(element)
                return z3.Sum([z3.If(each, z3.RealVal(1), z3.RealVal(0)) for each in parts])
            case ir.Apply(function=function, operands=operands):
                return self._applied(index, function, operands, part)

    def _applied(
        self, index: int, function: AnyFunction, operands: tuple[int, ...], part: int | None
    ) -> z3.ArithRef:
        declared = row(function)
        is_any = isinstance(function, RegionFunction) and declared.bounds is not None
        is_easy = declared.easy is not None and not self.is_free
        if (is_any and not is_easy) or (self.is_free and rounds(function, len(operands))):
            return self._real(Variable("free number", index))
        if not self.is_free:
            of_beam = self._of_beam(function, operands, part or 0)
            if of_beam is not None:
                return of_beam
            if isinstance(function, RegionFunction) or function is Function.SEEN:
                seen, wanted = (self.signal(each, part) for each in operands[-2:])
                self._side.append(seen == wanted)  # else the result is stale
            if isinstance(function, RegionFunction):
                place = self.signal(operands[0], part), self.signal(operands[1], part)
                self._outside[index, part] = clear_of(function.region, *place)
        if function in _ANGLES:
            low, high = (math.trunc(10 * end) / 10 for end in declared.range)
            angle = self._real(Variable("angle", index))
            self._side += within(angle, (low, high))
            return angle
        values = [self.signal(operand, part) for operand in operands]
        if function is Function.SEEN:
            self._side.append(values[1] == values[2])  # a value in another frame is stale
        expression = defined(function, len(operands))
        formulas = Formulas(values, self._operate)
        if declared.easy is not None:
            case, *_ = declared.easy(tuple(map(Operand, range(len(operands)))))
            conditions = [z3.simplify(formulas.condition(each)) for each in case.conditions]
            if not any(map(z3.is_false, conditions)):  # a mounted frame may be rotated
                self._side += conditions
                expression = case.value
        return formulas.term(expression)

    def _of_beam(
        self, function: AnyFunction, operands: tuple[int, ...], part: int
    ) -> z3.ArithRef | None:
        """The term for a coordinate of a point of a scan; None for other products."""
        if function is not Function.MULTIPLY:
            return None
        its_list = list_of_share(self.machine, operands[1])
        if its_list is None:
            return None
        distance = self.signal(operands[0], part)
        return coordinate(self.machine, operands[1], distance, self._side_of(its_list), part)

    def _side_of(self, its_list: int) -> z3.ArithRef:
        variable = Variable("side", its_list)
        is_new = variable not in self.variables
        term = self._real(variable)
        if is_new:
            self._side.append(sides(term))
        return term

    def _operate(self, primitive: Primitive, values: Sequence[z3.ArithRef]) -> z3.ArithRef:
        if primitive is Primitive.DIVIDE:
            self._side.append(values[1] != 0)
        return exactly(primitive, values)

    def _slot(self, slot: int) -> z3.ArithRef:
        variable = self._element_of(self.machine.slots[slot]) or Variable("slot", slot)
        term = self._real(variable)
        self._side += kind_facts(self.machine, self.machine.slots[slot], term)
        self._side += self.calls.facts(self.machine.slots[slot], term)
        return term

    def _element_of(self, slot: ir.Slot) -> Variable | None:
        """The variable of the array element that a slot reads, if it is one of the first
        elements.
        """
        part = slot.path[-1] if slot.path else None
        part = part.place if isinstance(part, ir.Listed) else part
        for index, array in enumerate(self.machine.arrays):
            is_inside = (array.input, array.path) == (slot.input, slot.path[:-1])
            if is_inside and isinstance(part, int) and part < self.length:
                return Variable("element", index, part)
        return None

    def _real(self, variable: Variable) -> z3.ArithRef:
        if variable not in self.variables:
            term = z3.Real(f"v{len(self.variables)}")
            self.variables[variable] = term
            self._side += self._carried(variable, term, f"whole_{term}")
        return self.variables[variable]

    def _carried(self, variable: Variable, term: z3.ArithRef, name: str) -> list[z3.BoolRef]:
        """The facts about a variable whose field carries only whole numbers."""
        machine = self.machine
        source: ir.Slot | ir.Array | None = None
        if variable.kind == "element":
            source = machine.arrays[variable.index]
            if source.kind is ir.FieldKind.TEXT:
                return kind_facts(machine, source, term)
        elif variable.kind == "slot":
            source = machine.slots[variable.index]
        elif variable.kind in ("previous", "rate"):
            slot = slot_behind(machine, variable.index)
            source = None if slot is None else machine.slots[slot]
            if variable.kind == "rate" and slot is not None and machine.slots[slot].limits:
                return self._ramp(slot, term, name)
        return [] if source is None else field_facts(source, term, name, is_wide=self.is_free)

    def _ramp(self, slot: int, rate: z3.ArithRef, name: str) -> list[z3.BoolRef]:
        if self.ramp is None:
            return []
        now, step = self._slot(slot), rate * constant(self.ramp.step_s)
        return ramp_facts(self.machine.slots[slot], now, step, self.ramp.count, name)

    def _bool(self, variable: Variable) -> z3.BoolRef:
        return self._real(variable) != 0

    # --- answers -----------------------------------------------------------------------------

    def solve(
        self, wanted: Sequence[z3.BoolRef], near: Values | None = None, apart: int | None = None
    ) -> dict[Variable, float] | None:
        """Values for which all of `wanted` is true, as round as possible, and as `near` as possible
        to other values. Leaves other than `apart` keep away from their thresholds if possible. None
        if the solver finds no values.
        """
        demands = [*self._side, *wanted, *self._bounds()]
        wishes = Wishes(demands, tuple(self.variables.values()), self._patience)
        if wishes.model is None:
            return None
        for clear in self._clear(apart):
            wishes.grant(clear)
        for variable, term in self.variables.items():
            if near is not None and variable in near:
                wishes.grant(term == constant(near[variable]), term)
        return {variable: self._round(wishes, variable) for variable in self.variables}

    def is_impossible(self, wanted: Sequence[z3.BoolRef]) -> bool:
        """Say whether it is proved that no values, in real arithmetic, make all of `wanted`
        true.
        """
        return ask(self._side, *wanted).outcome is Satisfiability.IMPOSSIBLE

    def _bounds(self) -> Iterator[z3.BoolRef]:
        for variable, term in self.variables.items():
            if variable.kind in ("aged", "oscillating", "remembered"):
                yield z3.Or(term == 0, term == 1)

    def remembering(self) -> Iterator[tuple[Variable, z3.BoolRef, z3.BoolRef]]:
        """Each `since` as a variable, with the formulas of its two conditions."""
        for variable in [each for each in self.variables if each.kind == "remembered"]:
            node = self.machine.propositions[variable.index].node
            assert isinstance(node, ir.Since), "only that remembers what it was"
            yield variable, self.formula(node.held), self.formula(node.begun)

    def _clear(self, apart: int | None) -> Iterator[z3.BoolRef]:
        for _, held, begun in self.remembering():
            yield z3.Or(begun, z3.Not(held))
        yield from self._outside.values()
        for proposition in self.propositions:
            if proposition == apart:
                continue
            for edge in edges(self.machine, proposition):
                for part in self._parts(proposition):
                    value = self.signal(edge.signal, part)
                    distance = constant(edge.step * (1 if edge.is_whole else _CLEAR))
                    threshold = constant(edge.threshold)
                    yield z3.Or(value >= threshold + distance, value <= threshold - distance)

    def _parts(self, proposition: int) -> Sequence[int | None]:
        is_array = isinstance(self.machine.propositions[proposition].node, ir.Quantified)
        return list(range(self.length)) if is_array else [None]

    def _round(self, wishes: Wishes, variable: Variable) -> float:
        """A value that is as short as possible in its unit. The solver keeps this value."""
        term, unit = self.variables[variable], self.unit(variable)
        wishes.grant(term >= 0, term)
        assert wishes.model is not None, "there are values"
        exact = exact_number(wishes.model.eval(term, model_completion=True))
        shown = unit.from_si(float(exact))
        candidates = [0.0, 1.0, *(round(shown, digits) for digits in range(7)), shown]
        for candidate in candidates:
            value = unit.to_si(candidate)
            if wishes.grant(term == constant(value), term):
                return value
        value = float(exact)
        wishes.grant(term == constant(value), term)
        return value

    def unit(self, variable: Variable) -> Unit:
        """The unit of a variable: the unit of a threshold of the variable, if there is one, else
        its own.
        """
        if variable not in self.units:
            own = unit_of_field(self.machine, variable.kind, variable.index)
            found = unit_of_edge(
                self.machine, self.propositions, own, lambda edge: self._reads(edge, variable)
            )
            self.units[variable] = own if found is None else found
        return self.units[variable]

    def _reads(self, edge: ComparisonEdge, variable: Variable) -> bool:
        if variable not in self.variables:
            return False
        term = self.signal(edge.signal, variable.part if variable.kind == "element" else None)
        return any(z3.eq(each, self.variables[variable]) for each in constants_in(term))
