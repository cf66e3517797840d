"""The semantics of every number and every proposition, as C over the memory of a monitor.

The input is a layout, which gives the places in memory. The meaning comes from the machine, by the
rules of `docs/explanation/semantics.md`, and from nothing that the generator made. These
definitions are written for comparison with the rules: no tables, no state.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import reduce

from rossmarie.core import AnyFunction, SampleNumber, may_be_infinite, sampling_row
from rossmarie.ir import model as ir
from rossmarie.verification import elements, formulas, supports
from rossmarie.verification.basics import CONSTANTS, HELPERS
from rossmarie.verification.formulas import literal
from rossmarie.verification.layout import ProofLayout
from rossmarie.verification.recent import recurs


class Definitions:
    """Writes the definitions of one machine."""

    def __init__(self, layout: ProofLayout) -> None:
        self._layout = layout
        self._machine = layout.machine
        self._beside = supports.beside(layout.machine).arrays

    def text(self) -> str:
        """The text of all definitions. Each definition follows the definitions that it uses."""
        applied = supports.functions(self._machine)
        functions = [*map(formulas.definition_of_subfunction, formulas.subfunctions(applied))]
        functions += [formulas.definition(*each) for each in applied]
        functions += map(formulas.definition_of_samples, supports.samplings(self._machine))
        constants = CONSTANTS.format(name=self._layout.name)
        parts = [
            constants,
            HELPERS,
            *functions,
            *self._elements(),
            *self._signals(),
            *self._propositions(),
        ]
        return "\n".join(parts)

    def is_whole(self, proposition: int) -> bool:
        """Say whether a proposition is about the monitor, not about one element of an array."""
        return self._layout.elements.propositions[proposition] is None

    # --- numbers -----------------------------------------------------------------------------

    def number(self, signal: int) -> str:
        """The C expression for a signal where the monitor keeps it, or for a constant."""
        node = self._machine.signals[signal].node
        if isinstance(node, ir.Constant):
            return literal(node.value)
        return f"m->value[{self._layout.value_of_signal[signal]}]"

    def computed(self) -> Iterator[int]:
        """The signals that the monitor computes from numbers that it keeps."""
        for index, signal in enumerate(self._machine.signals):
            is_computed = isinstance(signal.node, ir.Apply | ir.Sampled)
            if is_computed and self._layout.elements.signals[index] is None:
                yield index

    def is_never_infinite(self, signal: int) -> bool:
        """Say whether a signal is finite or unknown even before S4 applies."""
        node = self._machine.signals[signal].node
        if not isinstance(node, ir.Apply):
            return False
        return not may_be_infinite(node.function, len(node.operands), of_infinite=True)

    def can_be_infinite(self, signal: int) -> bool:
        """Say whether a signal keeps infinities. Results from arrays do: they are ordinary numbers
        (S8).
        """
        match self._machine.signals[signal].node:
            case ir.Fold():
                return True
            case ir.Sampled(function=function, signal=sampled):
                return sampling_row(function).keeps_infinities and self.can_be_infinite(sampled)
            case ir.Constant() | ir.Read() | ir.Apply() | ir.Element() | ir.Count():
                return False

    def _signals(self) -> Iterator[str]:
        for index in self.computed():
            remark = self._machine.signals[index].text
            yield (
                f"/* {_remark(remark)} */\n"
                f"static double spec_signal_{index}(const monitor *m)\n"
                f"{{\n    return {self._signal(index)};\n}}\n"
            )

    def _signal(self, index: int) -> str:
        node = self._machine.signals[index].node
        match node:
            case ir.Apply(function=function, operands=operands):
                return applied(function, [self.number(operand) for operand in operands])
            case ir.Sampled() if not self._layout.support_of_signal(index).channels:
                return "NAN"  # such a signal is never sampled
            case ir.Sampled(function=function):
                declared = sampling_row(function)
                views = ", ".join(self._view(index, node, view) for view in declared.views)
                text = f"{formulas.name_of_samples(function)}({views})"
                return text if declared.keeps_infinities else f"spec_finite({text})"
            case ir.Constant() | ir.Read() | ir.Element() | ir.Fold() | ir.Count():
                raise AssertionError(f"{type(node).__name__} is not computed from numbers")

    def _view(self, index: int, node: ir.Sampled, view: SampleNumber) -> str:
        """The result of a search among samples. The order of samples in windows is not proved. A
        function that feeds back remembers its results (S50), so its newest sample is the number
        itself.
        """
        feeds_back = sampling_row(node.function).feeds_back
        match view:
            case SampleNumber.NEWEST:
                newest = f"m->latest[{self._last_two(index, node)}]"
                return self.number(node.signal) if feeds_back else newest
            case SampleNumber.BEFORE:
                return f"m->before[{self._last_two(index, node)}]"
            case SampleNumber.SECONDS:
                k = self._last_two(index, node)
                return f"((double)(m->latest_ns[{k}] - m->before_ns[{k}]) / 0x1.dcd65p+29)"
            case SampleNumber.LOWER | SampleNumber.UPPER:
                is_upper = int(view is SampleNumber.UPPER)
                return f"__CPROVER_uninterpreted_middle({self._window(node)}, {is_upper})"
            case SampleNumber.TOTAL:
                return f"__CPROVER_uninterpreted_total({self._window(node)})"
            case SampleNumber.COUNT:
                return f"((double)m->window_count[{self._window(node)}])"
            case SampleNumber.CONSTANT:
                return literal(float(node.window_ns) / 1e9)

    def _last_two(self, index: int, node: ir.Sampled) -> int:
        feeds_back = sampling_row(node.function).feeds_back
        return self._layout.sampled.index(index if feeds_back else node.signal)

    def _window(self, node: ir.Sampled) -> int:
        return self._layout.windows.index((node.signal, node.window_ns))

    # --- elements of arrays ------------------------------------------------------------------

    def _elements(self) -> Iterator[str]:
        """Compute the signals of one element (S22, S52), then of all elements (S23 to S25, S53)."""
        for index, array in enumerate(self._layout.elements.signals):
            if array is not None:
                head = f"static double spec_element_{index}({self._parameters(array)})"
                yield f"{head} {{ {self._unused(array)}return {self._element_signal(index)}; }}\n"
        for index, array in enumerate(self._layout.elements.propositions):
            if array is not None:
                head = f"static unsigned spec_element_is_{index}({self._parameters(array)})"
                value = self._element_proposition(index)
                yield f"{head} {{ {self._unused(array)}return {value}; }}\n"
        for index, signal in enumerate(self._machine.signals):
            match signal.node:
                case ir.Fold(folding=folding, element=element):
                    all_of = self._all_of(self._layout.elements.signals[element])
                    yield elements.folded(index, folding, element, all_of)
                case ir.Count(element=element):
                    all_of = self._all_of(self._layout.elements.propositions[element])
                    yield elements.counted(index, element, all_of)
                case (
                    ir.Constant() | ir.Read() | ir.Apply() | ir.Sampled()
                    | ir.Element()
                ):  # fmt: skip
                    pass
        for index, proposition in enumerate(self._machine.propositions):
            if isinstance(proposition.node, ir.Quantified):
                all_of = self._all_of(self._layout.elements.propositions[proposition.node.element])
                yield elements.quantified(index, proposition.node, all_of)

    def _all_of(self, array: int | None) -> elements.AllOf:
        assert array is not None, "verified: only elements are folded"
        its_list = self._machine.arrays[array].list
        most = None if its_list is None else self._machine.lists[its_list].most
        columns = supports.columns(self._machine, array)
        return elements.AllOf(columns, most, array in self._beside)

    def _parameters(self, array: int) -> str:
        columns = (f"double e{each}" for each in supports.columns(self._machine, array))
        return ", ".join([*self._memory(array, "const monitor *m"), *columns])

    def _memory(self, array: int, name: str) -> list[str]:
        """The monitor as a parameter, if numbers of the monitor are used beside the elements
        (S74).
        """
        return [name] if array in self._beside else []

    def _unused(self, array: int) -> str:
        """The casts that mark parameters as used: not every query uses every field."""
        columns = (f"e{each}" for each in supports.columns(self._machine, array))
        return "".join(f"(void){each}; " for each in (*self._memory(array, "m"), *columns))

    def _arguments(self, array: int | None) -> str:
        assert array is not None, "it is of one element"
        columns = (f"e{each}" for each in supports.columns(self._machine, array))
        return ", ".join([*self._memory(array, "m"), *columns])

    def _element_number(self, signal: int) -> str:
        array = self._layout.elements.signals[signal]
        if array is None:
            return self.number(signal)
        return f"spec_element_{signal}({self._arguments(array)})"

    def _element_signal(self, index: int) -> str:
        node = self._machine.signals[index].node
        match node:
            case ir.Element(array=array):
                declared = self._machine.arrays[array]
                return converted(f"e{array}", declared.scale, declared.offset)
            case ir.Apply(function=function, operands=operands):
                return applied(function, [self._element_number(operand) for operand in operands])
            case ir.Constant() | ir.Read() | ir.Sampled() | ir.Fold() | ir.Count():
                raise AssertionError(f"{type(node).__name__} is not of one element")

    def _element_proposition(self, index: int) -> str:
        node = self._machine.propositions[index].node
        match node:
            case ir.Literal(value=value):
                return "TRUE" if value else "FALSE"
            case ir.Not() | ir.And() | ir.Or():
                return logic(node, self._element_is)
            case ir.Compare() | ir.Between() | ir.Flag():
                return compared(node, self._element_number, "UNKNOWN")
            case (
                ir.AgeReaches() | ir.Oscillates() | ir.Quantified() | ir.Held() | ir.Since()
                | ir.Recurs()
            ):  # fmt: skip
                raise AssertionError(f"{type(node).__name__} is not of one element")

    def _element_is(self, proposition: int) -> str:
        node = self._machine.propositions[proposition].node
        if isinstance(node, ir.Literal):
            return "TRUE" if node.value else "FALSE"
        array = self._layout.elements.propositions[proposition]
        return f"spec_element_is_{proposition}({self._arguments(array)})"

    # --- propositions
    # ------------------------------------------------------------------------------

    def _propositions(self) -> Iterator[str]:
        for index, proposition in enumerate(self._machine.propositions):
            if self.is_whole(index) and not isinstance(proposition.node, ir.Oscillates):
                yield from self._unknown(index, proposition.node)
                yield (
                    f"/* {_remark(proposition.text)} */\n"
                    f"static unsigned spec_proposition_{index}(const monitor *m, int64_t t_ns)\n"
                    f"{{\n    (void)m;\n    (void)t_ns;\n"
                    f"    return {self._proposition(index)};\n}}\n"
                )
            elif self.is_whole(index):
                yield from self._unknown(index, proposition.node)

    def _proposition(self, index: int) -> str:
        node = self._machine.propositions[index].node
        unknown = f"spec_unknown_{index}(m)"
        match node:
            case ir.Literal(value=value):
                return "TRUE" if value else "FALSE"
            case ir.Not() | ir.And() | ir.Or():
                return logic(node, self.proposition)
            case ir.Held():
                return self._held(index, node)
            case ir.Since():
                return self.since_then(self._layout.sinces.index(index), "m->")
            case ir.Recurs(operand=operand):
                return recurs(self._layout, index, self.proposition(operand))
            case ir.AgeReaches(input=used, age_ns=age_ns):
                reached = f"t_ns - m->stamp_ns[{used}] >= INT64_C({age_ns}) ? TRUE : FALSE"
                return f"m->state[{used}] == NEVER_RECEIVED ? {unknown} : {reached}"
            case ir.Quantified():
                x = f"m->value[{self._layout.places.value_of_test[index]}]"
                return f"isnan({x}) ? {unknown} : {x} != 0.0 ? TRUE : FALSE"
            case ir.Compare() | ir.Between() | ir.Flag():
                return compared(node, self.number, unknown)
            case ir.Oscillates():
                raise AssertionError(f"{type(node).__name__} does not compare")

    def proposition(self, index: int) -> str:
        """A proposition where the monitor keeps it."""
        return f"m->truth_value[{self._layout.node_of_proposition[index]}]"

    def _held(self, index: int, node: ir.Held) -> str:
        """S33: whether the operand has kept its value, since `since_ns` (S34), for the duration."""
        k = self._layout.held.index(index)
        operand, start = self.proposition(node.operand), self.since(node.operand)
        matured = f"t_ns - {start} >= INT64_C({node.duration_ns}) ? TRUE : m->held_before[{k}]"
        return f"{operand} != TRUE ? {operand} : {matured}"

    def since_then(self, k: int, memory: str) -> str:
        """S44: the k-th `since`, from its value in a memory and the present values of its
        operands.
        """
        node = self._machine.propositions[self._layout.sinces[k]].node
        assert isinstance(node, ir.Since), "the layout lists them"
        held, begun = self.proposition(node.held), self.proposition(node.begun)
        before = f"spec_or({begun}, {memory}since_before[{k}])"
        return f"spec_or({begun}, spec_and({held}, {before}))"

    def since(self, proposition: int) -> str:
        """The instant since which a proposition has had its value."""
        return f"m->since_ns[{self._layout.node_of_proposition[proposition]}]"

    def _unknown(self, index: int, node: ir.PropositionNode) -> Iterator[str]:
        """S30: say whether an unknown leaf is stale or merely unknown."""
        match node:
            case (
                ir.Literal() | ir.Not() | ir.And() | ir.Or() | ir.Held() | ir.Since() | ir.Recurs()
            ):
                return
            case ir.Quantified() | ir.AgeReaches():
                whole = True
            case ir.Compare() | ir.Between() | ir.Flag() | ir.Oscillates():
                whole = False
        lacking = list(self._lacking(index))
        timed = any(
            map(self._layout.has_timeout, self._layout.support_of_proposition(index).inputs)
        )
        if timed:
            lacking.append("true" if whole else f"({self._nothing_missing(index)})")
        stale = " || ".join(lacking) or "false"
        yield (
            f"static unsigned spec_unknown_{index}(const monitor *m)\n"
            f"{{\n    (void)m;\n    return {stale} ? STALE : UNKNOWN;\n}}\n"
        )

    def _lacking(self, index: int) -> Iterator[str]:
        support = self._layout.support_of_proposition(index)
        for slot in sorted(support.slots):
            if self._layout.has_timeout(self._machine.slots[slot].input):
                yield f"isnan(m->value[{self._layout.places.value_of_slot[slot]}])"
        for fold in sorted(support.folds):
            if any(map(self._layout.has_timeout, self._layout.support_of_signal(fold).inputs)):
                yield f"isnan(m->value[{self._layout.value_of_signal[fold]}])"

    def _nothing_missing(self, index: int) -> str:
        support = self._layout.support_of_proposition(index)
        kept = [self._layout.places.value_of_slot[slot] for slot in sorted(support.slots)]
        obligations = [f"m->value[{value}] < INFINITY" for value in kept]
        for signal in sorted(support.folds | support.waiting):
            value = f"m->value[{self._layout.value_of_signal[signal]}]"
            is_of_list = supports.is_of_list(self._machine, signal)
            obligations.append(f"isfinite({value})" if is_of_list else f"{value} < INFINITY")
        return " && ".join(obligations) or "true"


# --- expressions -----------------------------------------------------------------------------


def converted(raw: str, scale: float, offset: float) -> str:
    """S7: a received number, converted to SI."""
    is_plain = scale == 1.0 and offset == 0.0
    return raw if is_plain else f"(({raw} * {literal(scale)}) + {literal(offset)})"


def applied(function: AnyFunction, operands: Sequence[str]) -> str:
    """S3 to S6: a function of numbers, unknown if the result is not finite."""
    return f"spec_finite({formulas.name(function, len(operands))}({', '.join(operands)}))"


def compared(
    node: ir.Compare | ir.Between | ir.Flag, write: Callable[[int], str], unknown: str
) -> str:
    """S27 to S29: a comparison of numbers; `unknown` if an operand is unknown."""
    match node:
        case ir.Compare(comparison=comparison, left=left, right=right):
            operands = [write(left), write(right)]
            holds = f"{operands[0]} {comparison.value} {operands[1]}"
        case ir.Between(signal=signal, low=low, high=high):
            operands = [write(signal), write(low), write(high)]
            holds = f"{operands[1]} <= {operands[0]} && {operands[0]} <= {operands[2]}"
        case ir.Flag(signal=signal):
            operands = [write(signal)]
            holds = f"{operands[0]} != 0.0"
    missing = " || ".join(f"isnan({operand})" for operand in operands)
    return f"{missing} ? {unknown} : {holds} ? TRUE : FALSE"


def logic(node: ir.Not | ir.And | ir.Or, write: Callable[[int], str]) -> str:
    """S2, for any number of operands."""
    match node:
        case ir.Not(operand=operand):
            return f"spec_not({write(operand)})"
        case ir.And(operands=operands):
            return reduce(lambda text, each: f"spec_and({text}, {each})", map(write, operands))
        case ir.Or(operands=operands):
            return reduce(lambda text, each: f"spec_or({text}, {each})", map(write, operands))


def _remark(text: str) -> str:
    return text.replace("*/", "* /").replace("/*", "/ *")
