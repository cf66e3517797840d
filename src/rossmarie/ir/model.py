"""The monitor machine, on one screen: every target compiles it, and the interpreter executes it.

A machine reads **slots** (scalar numbers in messages), computes **signals** (numbers) and
**propositions** (three-valued), and runs **rules** on them. Tuples refer to each other by index,
and every operand comes before its user, so evaluation is one pass from left to right.

All numbers are IEEE 754 binary64 in SI units (angles in radians, time in seconds); NaN is
"unknown". Flags are 0.0 or 1.0; a text is the index of its literal in `Machine.texts`, or -1.0 for
any other text. Instants and durations are integers in nanoseconds. `docs/explanation/semantics.md`
defines the meaning of every node.
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


class FieldKind(enum.Enum):
    """The kind of message field behind a slot or array."""

    REAL = "real"
    FLAG = "flag"
    TEXT = "text"


FLAG_LIMITS = (0.0, 1.0)


@dataclass(frozen=True)
class Input:
    """A named input; `timeout_ns` is the age at which it is stale; None if it never becomes
    stale.
    """

    name: str
    channel: int
    timeout_ns: int | None
    span: Span


@dataclass(frozen=True)
class Slot:
    """A scalar that a message carries: `value = raw * scale + offset` is in SI.

    `path` leads from the message to the field, `unit` is the unit that users see. `limits` are the
    least and the greatest raw number of a field of whole numbers; no monitor relies on them.
    """

    input: int
    path: Path
    kind: FieldKind
    scale: float
    offset: float
    unit: str
    limits: tuple[float, float] | None = None


@dataclass(frozen=True)
class List:
    """A list of messages inside a message. A list with more than `most` elements counts as stale,
    like a list that has not come (S51).
    """

    input: int
    path: Path
    most: int


@dataclass(frozen=True)
class Array:
    """A numeric array of any length inside a message. It exists only while it arrives. `limits` are
    like those of a slot; flags are whole numbers within `FLAG_LIMITS`.

    With a `list`, the array is one field of all elements of that list, as a column. `path`
    continues the path of the list with `EACH`. All columns of a list have one length. Only columns
    hold texts.
    """

    input: int
    path: Path
    scale: float
    offset: float
    unit: str
    limits: tuple[float, float] | None = None
    kind: FieldKind = FieldKind.REAL
    list: int | None = None


# --- signals: numbers ------------------------------------------------------------------------


@dataclass(frozen=True)
class Constant:
    """A number that is known at compile time."""

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
    """A function of the last samples of a signal. `window_ns` is the length of its window, or its
    time constant; 0 if it has neither.
    """

    function: Sampling
    signal: int
    window_ns: int = 0


@dataclass(frozen=True)
class Element:
    """The current element of an array. Signals and propositions over it exist only inside a
    fold.
    """

    array: int


class Folding(enum.Enum):
    """The operations that turn the elements of an array into one number."""

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
    """The number of elements for which an elementwise proposition is true."""

    element: int


SignalNode = Constant | Read | Apply | Sampled | Element | Fold | Count


@dataclass(frozen=True)
class Signal:
    """A number, its origin, and its display (`value * scale + offset` in `unit`)."""

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
    """`left OP right`; unknown if either operand is unknown."""

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
    """The last message of an input is at least `age_ns` old; unknown before the first message."""

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
    """A quantifier over the elements of an array."""

    ANY = "any"
    ALL = "all"


@dataclass(frozen=True)
class Quantified:
    """An elementwise proposition holds for some or for every element."""

    quantifier: Quantifier
    element: int


@dataclass(frozen=True)
class Not:
    """The Kleene negation."""

    operand: int


@dataclass(frozen=True)
class And:
    """The Kleene conjunction of two or more operands."""

    operands: tuple[int, ...]


@dataclass(frozen=True)
class Or:
    """The Kleene disjunction of two or more operands."""

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
    """`begun` was true at some instant, and `held` has been true ever since."""

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
    """A condition. `name` is `entity.condition` if the user gave it a name."""

    node: PropositionNode
    name: str | None
    text: str
    span: Span


# --- rules -----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Rule:
    """A rule is active from the instant at which `condition` is true (or unknown because an input
    with a timeout is missing) until `condition` is false and `release` is true. A latched rule
    (`release` is None) waits for a reset while `condition` is false.

    `head` is the place for findings: the rule's name, or else its condition. `contract` describes
    in words how the rule is cleared. A verdict contains the states of `terms` (propositions) and
    `signals` (signals that are not constant). `inputs` are the inputs that the rule depends on,
    `hazards` the hazards that it mitigates. Monitors ignore `categories`, `feedback`, and
    `exempts`, the exemption that the rule stands for. A rule that is `always` applied has no
    exemptions, and an operator cannot grant any.
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
        """The propositions that decide about the rule: its condition, and its release."""
        return (self.condition,) if self.release is None else (self.condition, self.release)


@dataclass(frozen=True)
class Machine:
    """A whole rules file. `watches` are the propositions that confirmations in `reactions` use.
    `left_out` are the rules outside a selection; None without a selection. `readings` are the
    signals that memories of poses use. `calls` are the calls of skills that queries distinguish;
    empty if unknown.
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
