"""The monitor machine, on one screen: what every target compiles and the interpreter executes.

A machine reads **slots** (scalar numbers that arrive with messages), computes **signals** (numbers)
and **propositions** (three-valued), and runs **rules** on them. Tuples refer to each other by
index, and every operand stands before its user, so evaluation is one pass from left to right.

All numbers are IEEE 754 binary64 in SI units (angles in radians, time in seconds); NaN is
"unknown". Flags are 0.0 or 1.0; a text is the index of its literal in `Machine.texts`, or -1.0
for any other text. Instants and durations are integers in nanoseconds.
The meaning of every node is written down in `docs/explanation/semantics.md`.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass

from dslkit.source import Span
from rossmarie.core import AnyFunction, Function, Sampling
from rossmarie.ir.calls import SkillCall
from rossmarie.ir.channels import Channel
from rossmarie.ir.feedback import NO_FEEDBACK, Feedback
from rossmarie.ir.filing import Category, Exemption, Hazard, LeftOut
from rossmarie.ir.path import Path
from rossmarie.ir.reactions import NO_REACTIONS, Reactions
from rossmarie.ir.signs import Comparison


class Kind(enum.Enum):
    """The kind of message field behind a slot or array."""

    REAL = "real"
    FLAG = "flag"
    TEXT = "text"


FLAG_LIMITS = (0.0, 1.0)


@dataclass(frozen=True)
class Input:
    """A named input; `timeout_ns` is the age at which it is stale, None if it never is."""

    name: str
    channel: int
    timeout_ns: int | None
    span: Span


@dataclass(frozen=True)
class Slot:
    """A scalar that a message carries: `value = raw * scale + offset` is in SI.

    `path` leads from the message to the field, `unit` is the unit that users see. `limits` are the
    least and the greatest raw number of a field that holds whole numbers; no monitor relies on it.
    """

    input: int
    path: Path
    kind: Kind
    scale: float
    offset: float
    unit: str
    limits: tuple[float, float] | None = None


@dataclass(frozen=True)
class List:
    """A list of messages that a message carries. One of more than `most` elements counts as stale,
    as if it had not come (S51).
    """

    input: int
    path: Path
    most: int


@dataclass(frozen=True)
class Array:
    """A numeric array of any length that a message carries; it exists only while it arrives.
    `limits` are those of a slot; flags are the whole numbers within `FLAG_LIMITS`.

    With a `list` it is one field of all elements of that list, as a column: `path` goes on behind
    that of the list with `EACH`. All columns of a list have one length. Only they hold texts.
    """

    input: int
    path: Path
    scale: float
    offset: float
    unit: str
    limits: tuple[float, float] | None = None
    kind: Kind = Kind.REAL
    list: int | None = None


# --- signals: numbers ------------------------------------------------------------------------


@dataclass(frozen=True)
class Constant:
    """A number known when compiling."""

    value: float


@dataclass(frozen=True)
class Read:
    """The present value of a slot."""

    slot: int


@dataclass(frozen=True)
class Apply:
    """A function of other signals."""

    function: AnyFunction
    operands: tuple[int, ...]


@dataclass(frozen=True)
class Sampled:
    """A function of the last samples of a signal; `window_ns` is the time that it takes: the length
    of its window, or its time constant. It is 0 if it takes none.
    """

    function: Sampling
    signal: int
    window_ns: int = 0


@dataclass(frozen=True)
class Element:
    """The element at hand of an array; signals and propositions over it exist only inside a
    fold.
    """

    array: int


class Folding(enum.Enum):
    """The ways in which the elements of an array become one number."""

    MINIMUM = "minimum"
    MAXIMUM = "maximum"

    @property
    def function(self) -> Function:
        """The function of two numbers that is applied from the first element to the last (S23)."""
        return Function(self.value)


@dataclass(frozen=True)
class Fold:
    """The least or greatest value of an elementwise signal."""

    folding: Folding
    element: int


@dataclass(frozen=True)
class Count:
    """For how many elements an elementwise proposition is true."""

    element: int


SignalNode = Constant | Read | Apply | Sampled | Element | Fold | Count


@dataclass(frozen=True)
class Signal:
    """A number, where it comes from, and how it is shown (`value * scale + offset` in `unit`)."""

    node: SignalNode
    text: str
    unit: str
    scale: float
    offset: float
    span: Span


# --- propositions: true, false, unknown
# ------------------------------------------------------------


@dataclass(frozen=True)
class Literal:
    """Always true or always false."""

    value: bool


@dataclass(frozen=True)
class Compare:
    """`left OP right`; unknown if either side is."""

    comparison: Comparison
    left: int
    right: int


@dataclass(frozen=True)
class Between:
    """`signal in [low, high]`, both ends included."""

    signal: int
    low: int
    high: int


@dataclass(frozen=True)
class Flag:
    """A signal that is 0.0 (false) or 1.0 (true)."""

    signal: int


@dataclass(frozen=True)
class AgeReaches:
    """The last message of an input is at least `age_ns` old; unknown before the first."""

    input: int
    age_ns: int


@dataclass(frozen=True)
class Oscillates:
    """`count` turning points of a signal, each after a swing of more than `swing`, lie within
    the last `window_ns`.
    """

    signal: int
    count: int
    window_ns: int
    swing: float


class Quantifier(enum.Enum):
    """Over the elements of an array."""

    ANY = "any"
    ALL = "all"


@dataclass(frozen=True)
class Quantified:
    """An elementwise proposition holds for some or for every element."""

    quantifier: Quantifier
    element: int


@dataclass(frozen=True)
class Not:
    """Kleene negation."""

    operand: int


@dataclass(frozen=True)
class And:
    """Kleene conjunction of two or more."""

    operands: tuple[int, ...]


@dataclass(frozen=True)
class Or:
    """Kleene disjunction of two or more."""

    operands: tuple[int, ...]


@dataclass(frozen=True)
class Held:
    """The operand has been true throughout the last `duration_ns`; if `initially`, it counts as
    true before the start of a trace.
    """

    operand: int
    duration_ns: int
    initially: bool = False


@dataclass(frozen=True)
class Since:
    """`begun` has been true, and `held` ever since."""

    held: int
    begun: int


@dataclass(frozen=True)
class Recurs:
    """The operand has become true `count` times within the last `window_ns`."""

    operand: int
    count: int
    window_ns: int


PropositionNode = (
    Literal | Compare | Between | Flag | AgeReaches | Oscillates | Quantified | Not | And | Or
    | Held | Since | Recurs
)  # fmt: skip


@dataclass(frozen=True)
class Proposition:
    """A condition; `name` is `entity.condition` where the user gave it one."""

    node: PropositionNode
    name: str | None
    text: str
    span: Span


# --- rules -----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Rule:
    """Active from when `condition` is true (or unknown for lack of an input with a timeout) until
    `condition` is false and `release` is true. A latched rule (`release` is None) waits for a
    reset while `condition` is false.

    `head` is where it is pointed at, its name or else its condition. `contract` says in words what
    clears it. `terms` are the propositions, and `signals` the signals that are not constant, whose
    state a verdict carries; `inputs` are the inputs it rests on, `hazards` those it mitigates.
    `categories` are what it is filed under; no monitor heeds them, nor `feedback`. One that holds
    `always` has no exemptions, and an operator can grant none. `exempts` is the exemption that it
    stands for; no monitor heeds that either.
    """

    name: str
    condition: int
    release: int | None
    actions: tuple[str, ...]
    contract: str
    documentation: str | None
    terms: tuple[int, ...]
    signals: tuple[int, ...]
    inputs: tuple[int, ...]
    span: Span
    head: Span
    hazards: tuple[int, ...] = ()
    feedback: Feedback = NO_FEEDBACK
    categories: tuple[Category, ...] = ()
    always: bool = False
    exempts: Exemption | None = None

    @property
    def roots(self) -> tuple[int, ...]:
        """The propositions that decide about it: its condition, and what clears it."""
        return (self.condition,) if self.release is None else (self.condition, self.release)


@dataclass(frozen=True)
class Machine:
    """A whole rules file. `watches` are the propositions that the confirmations in `reactions` ask.
    `left_out` are the rules that a selection does not hold, None if nobody selected.
    `readings` are the signals that memories of poses ask. `calls` are the calls of skills that the
    queries to skills tell apart, none if that is not known.
    """

    name: str
    channels: tuple[Channel, ...]
    inputs: tuple[Input, ...]
    slots: tuple[Slot, ...]
    arrays: tuple[Array, ...]
    texts: tuple[str, ...]
    signals: tuple[Signal, ...]
    propositions: tuple[Proposition, ...]
    rules: tuple[Rule, ...]
    watches: tuple[int, ...] = ()
    reactions: Reactions = NO_REACTIONS
    hazards: tuple[Hazard, ...] = ()
    lists: tuple[List, ...] = ()
    left_out: LeftOut | None = None
    readings: tuple[int, ...] = ()
    calls: tuple[SkillCall, ...] = ()
