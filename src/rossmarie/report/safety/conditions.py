"""The propositions of a machine in words, from their nodes alone, never from the user's text.

The input is a machine that `ir.verify` has accepted. A negation is pushed down to the leaves, where
it becomes the opposite word: by S2 this changes no value, including unknown and stale. A
proposition with more than `MOST_PARTS` operands gets a name, and is described in full in a place of
its own.
"""

from __future__ import annotations

from rossmarie import ir
from rossmarie.ir.duration_text import duration_text
from rossmarie.ir.support import is_leaf, proposition_operands
from rossmarie.report.safety.numbers import MOST_PARTS, NumberWords, number, sizes
from rossmarie.report.safety.phrase import Phrase

_MOST_SIDE_BY_SIDE = 3
"""The most leaves that are joined in one sentence. More leaves become a list."""

_WORDS = {
    ir.Comparison.EQUAL: "equal to",
    ir.Comparison.NOT_EQUAL: "other than",
    ir.Comparison.LESS: "below",
    ir.Comparison.LESS_OR_EQUAL: "at most",
    ir.Comparison.GREATER: "above",
    ir.Comparison.GREATER_OR_EQUAL: "at least",
}


class ConditionWords:
    """The words for each proposition of one machine."""

    def __init__(self, machine: ir.Machine) -> None:
        self._machine = machine
        self.numbers = NumberWords(machine, self.inline)
        self._sizes = sizes(
            proposition_operands(proposition.node) for proposition in machine.propositions
        )
        self.apart: dict[int, None] = {}
        """The named propositions, which are described in full elsewhere."""

    # --- sentences ---------------------------------------------------------------------------

    def phrase(self, index: int, is_so: bool = True) -> Phrase:
        """A proposition or, if `is_so` is False, its opposite."""
        if self._sizes[index] > MOST_PARTS:
            return self._by_name(index, is_so)
        return self.in_full(index, is_so)

    def in_full(self, index: int, is_so: bool = True) -> Phrase:
        """A proposition in terms of its operands."""
        proposition = self._machine.propositions[index]
        whole = ir.defined(self._machine, index)
        if whole is not None:
            return self._defined(proposition, whole, is_so)
        match proposition.node:
            case ir.Not(operand=operand):
                found = self.phrase(operand, not is_so)
                name = _named(proposition, is_so) or found.name
                return Phrase(found.text, found.parts, proposition.span, name, found.refers_to)
            case ir.Literal(value=value):
                always = value is is_so
                return Phrase(
                    "always" if always else "never",
                    (),
                    proposition.span,
                    _named(proposition, is_so),
                )
            case ir.And(operands=operands):
                return self._junction(proposition, operands, is_so, all_of=is_so)
            case ir.Or(operands=operands):
                return self._junction(proposition, operands, is_so, all_of=not is_so)
            case ir.Held(operand=operand, duration_ns=duration_ns):
                return self._held(proposition, operand, duration_ns, is_so)
            case ir.Since(held=held, begun=begun):
                head = "the first of these is so, or it was and the second has been so ever since:"
                return self._over_time(proposition, head, (begun, held), is_so)
            case ir.Recurs() as node:
                head = f"this {_often(node, is_so)}:"
                parts = (self.phrase(node.operand),)
                return Phrase(head, parts, proposition.span, _named(proposition, is_so))
            case (
                ir.Compare() | ir.Between() | ir.Flag() | ir.AgeReaches() | ir.Oscillates()
                | ir.Quantified()
            ) as node:  # fmt: skip
                return Phrase(
                    self._leaf(node, is_so), (), proposition.span, _named(proposition, is_so)
                )

    def name(self, index: int) -> str:
        """The name of a proposition: the user's, or a number."""
        return self._machine.propositions[index].name or f"condition {index}"

    def _by_name(self, index: int, is_so: bool) -> Phrase:
        self.apart.setdefault(index)
        proposition = self._machine.propositions[index]
        text = f"{self.name(index)} is {'true' if is_so else 'false'}"
        return Phrase(text, (), proposition.span, None, f"condition-{index}")

    def _junction(
        self, proposition: ir.Proposition, operands: tuple[int, ...], is_so: bool, *, all_of: bool
    ) -> Phrase:
        parts = tuple(self.phrase(operand, is_so) for operand in operands)
        if _fit_side_by_side(parts):
            text = (" and " if all_of else " or ").join(part.text for part in parts)
            return Phrase(text, (), proposition.span, _named(proposition, is_so))
        head = "all of these hold:" if all_of else "at least one of these holds:"
        return Phrase(head, parts, proposition.span, _named(proposition, is_so))

    def _held(
        self, proposition: ir.Proposition, operand: int, duration_ns: int, is_so: bool
    ) -> Phrase:
        """S33: a `for`, which is true if the condition was true throughout a time."""
        duration = f"throughout the last {duration_text(duration_ns)}"
        node, inner_is_so = self._stripped(operand)
        if is_leaf(node) and self._machine.propositions[operand].name is None:
            held = f"{self._leaf(node, inner_is_so, 'has been')} {duration}"
            text = held if is_so else f"it is not so that {held}"
            return Phrase(text, (), proposition.span, _named(proposition, is_so))
        head = f"{'this has' if is_so else 'it is not so that this has'} held {duration}:"
        return Phrase(head, (self.phrase(operand),), proposition.span, _named(proposition, is_so))

    def _defined(
        self, proposition: ir.Proposition, whole: ir.Once | ir.Response, is_so: bool
    ) -> Phrase:
        """S45 and S46: `once` and `after`."""
        duration = duration_text(whole.duration_ns)
        match whole:
            case ir.Once():
                head = f"this has been so at least once within the last {duration}:"
            case ir.Response():
                head = (
                    f"within {duration} after each instant at which the first of these is so, "
                    "the second is:"
                )
        return self._over_time(proposition, head, whole.operands, is_so)

    def _over_time(
        self, proposition: ir.Proposition, head: str, operands: tuple[int, ...], is_so: bool
    ) -> Phrase:
        parts = tuple(self.phrase(operand) for operand in operands)
        return Phrase(_negated(head, is_so), parts, proposition.span, _named(proposition, is_so))

    def _stripped(self, index: int) -> tuple[ir.PropositionNode, bool]:
        """The operand of an unnamed chain of negations. The flag is True if the chain affirms the
        operand.
        """
        node, is_so = self._machine.propositions[index].node, True
        while isinstance(node, ir.Not):
            node, is_so = self._machine.propositions[node.operand].node, not is_so
        return node, is_so

    # --- one line ----------------------------------------------------------------------------

    def inline(self, index: int, is_so: bool = True) -> str:
        """A proposition on one line, with brackets around its groups."""
        proposition = self._machine.propositions[index]
        if self._sizes[index] > MOST_PARTS:
            return self._by_name(index, is_so).text
        whole = ir.defined(self._machine, index)
        if whole is not None:
            return _whether(self._inline_defined(whole), is_so)
        match proposition.node:
            case ir.Not(operand=operand):
                return self.inline(operand, not is_so)
            case ir.And(operands=operands) | ir.Or(operands=operands):
                all_of = isinstance(proposition.node, ir.And) is is_so
                parts = (f"({self.inline(operand, is_so)})" for operand in operands)
                return (" and " if all_of else " or ").join(parts)
            case ir.Literal(value=value):
                return "always" if value is is_so else "never"
            case ir.Held(operand=operand, duration_ns=duration_ns):
                held = f"({self.inline(operand)}) throughout the last {duration_text(duration_ns)}"
                return _whether(held, is_so)
            case ir.Since(held=operand, begun=begun):
                before = f"it was and ({self.inline(operand)}) ever since"
                return _whether(f"({self.inline(begun)}), or {before}", is_so)
            case ir.Recurs() as node:
                return f"({self.inline(node.operand)}) {_often(node, is_so)}"
            case (
                ir.Compare() | ir.Between() | ir.Flag() | ir.AgeReaches() | ir.Oscillates()
                | ir.Quantified()
            ) as node:  # fmt: skip
                return self._leaf(node, is_so)

    def _inline_defined(self, whole: ir.Once | ir.Response) -> str:
        duration = duration_text(whole.duration_ns)
        match whole:
            case ir.Once(condition=condition):
                return f"({self.inline(condition)}) at least once within the last {duration}"
            case ir.Response(cause=cause, answer=answer):
                each = f"after each instant at which ({self.inline(cause)})"
                return f"within {duration} {each}, ({self.inline(answer)})"

    # --- leaves ------------------------------------------------------------------------------

    def _leaf(self, node: ir.PropositionNode, is_so: bool, verb: str = "is") -> str:
        """A leaf or its opposite: `SUBJECT is WORDS`; the verb may be `has been`."""
        words = self.numbers.words
        match node:
            case ir.Compare():
                return self._compare(node, is_so, verb)
            case ir.Between(signal=signal, low=low, high=high):
                side = "from" if is_so else "outside of"
                return f"{words(signal)} {verb} {side} {self.numbers.range(low, high)}"
            case ir.Flag(signal=signal):
                return f"{words(signal)} {verb} {'true' if is_so else 'false'}"
            case ir.AgeReaches():
                return f"the last message of {self._age(node, is_so, verb)}"
            case ir.Oscillates():
                return self._oscillates(node, is_so, verb)
            case ir.Quantified():
                return self._quantified(node, is_so, verb)
            case (
                ir.Literal() | ir.Not() | ir.And() | ir.Or() | ir.Held() | ir.Since() | ir.Recurs()
            ):
                raise AssertionError(f"{type(node).__name__} is no leaf")

    def _compare(self, node: ir.Compare, is_so: bool, verb: str) -> str:
        comparison, left, right = node.comparison, node.left, node.right
        if self._is_constant(left) and not self._is_constant(right):
            comparison, left, right = comparison.mirrored, right, left
        comparison = comparison if is_so else comparison.opposite
        subject = self.numbers.words(left)
        text = self._text(left, right)
        if text is not None:
            sign = "" if comparison is ir.Comparison.EQUAL else "other than "
            return f"{subject} {verb} {sign}{text}"
        return f"{subject} {verb} {_WORDS[comparison]} {self.numbers.words(right)}"

    def _is_constant(self, signal: int) -> bool:
        return isinstance(self._machine.signals[signal].node, ir.Constant)

    def _text(self, left: int, right: int) -> str | None:
        """The literal that a text field is compared with."""
        read, literal = self._machine.signals[left].node, self._machine.signals[right].node
        source: ir.Slot | ir.Array | None = None
        if isinstance(read, ir.Read):
            source = self._machine.slots[read.slot]
        elif isinstance(read, ir.Element):
            source = self._machine.arrays[read.array]
        is_text = source is not None and source.kind is ir.FieldKind.TEXT
        if not is_text or not isinstance(literal, ir.Constant):
            return None
        return f'"{self._machine.texts[int(literal.value)]}"'

    def _age(self, node: ir.AgeReaches, is_so: bool, verb: str) -> str:
        """The age of an input. Ages are whole nanoseconds: at least d + 1 ns is more than d."""
        is_strict = node.age_ns % 1000 == 1
        age = duration_text(node.age_ns - is_strict)
        if is_so:
            sign = "more than" if is_strict else "at least"
        else:
            sign = "at most" if is_strict else "less than"
        return f"{self._machine.inputs[node.input].name} {verb} {sign} {age} old"

    def _oscillates(self, node: ir.Oscillates, is_so: bool, verb: str) -> str:
        signal = self._machine.signals[node.signal]
        swing = f"{number(node.swing * signal.scale)} {signal.unit}".rstrip()
        negation = "" if is_so else " not"
        return (
            f"{self.numbers.words(node.signal)} {verb}{negation} oscillating (at least "
            f"{node.count} turning points within {duration_text(node.window_ns)}, each after a "
            f"swing of more than {swing})"
        )

    def _quantified(self, node: ir.Quantified, is_so: bool, verb: str) -> str:
        """A quantifier or its opposite: not any is all not, and not all is any not (S25)."""
        any_of = (node.quantifier is ir.Quantifier.ANY) is is_so
        which = "at least one" if any_of else "every"
        array = self.numbers.array_of(node.element)
        element, element_is_so = self._stripped(node.element)
        said = element_is_so is is_so
        if is_leaf(element):
            words = self._leaf(element, said, verb)
            if words.startswith("the element "):
                return f"{which} element of {array} {words.removeprefix('the element ')}"
            return f"for {which} element of {array}, {words}"
        return f"{which} element of {array} {verb} such that ({self.inline(node.element, is_so)})"


def _named(proposition: ir.Proposition, is_so: bool) -> str | None:
    """The user's name of a proposition or, if it is negated, of its opposite."""
    return proposition.name if proposition.name is None or is_so else f"not {proposition.name}"


def _negated(head: str, is_so: bool) -> str:
    return head if is_so else f"it is not so that {head}"


def _whether(text: str, is_so: bool) -> str:
    return text if is_so else f"not ({text})"


def _fit_side_by_side(parts: tuple[Phrase, ...]) -> bool:
    """Say whether a few simple words without names of their own can be joined unambiguously."""
    return len(parts) <= _MOST_SIDE_BY_SIDE and not any(
        part.parts or part.name or " and " in part.text or " or " in part.text for part in parts
    )


def _often(node: ir.Recurs, is_so: bool) -> str:
    """S48: the number of times that a condition has become true."""
    times = "once" if node.count == 1 else f"{node.count} times"
    often = f"become true at least {times} within the last {duration_text(node.window_ns)}"
    return f"has {often}" if is_so else f"has not {often}"
