"""Random rules with scopes and exemptions, random robots that tell of skills, and what S59 to S62
of docs/explanation/semantics.md say of them: by a model that knows neither machines nor how rules
are made of exemptions.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from random import Random

from rossmarie import ir
from rossmarie.interpreter import Interpreter
from rossmarie.ir.skills import SkillContext, answer
from support.compiled import machine_of
from support.rule_skills import DIGEST, FILE, content, running
from support.skill_worlds import Query, World

TICK = 10**8
CONTEXT_NS = 10 * TICK
FORCE_NS = 7 * TICK
LIMIT, OTHER_LIMIT = 5.0, 8.0
MOST_EVENTS = 24

F, T, U, L = range(4)  # S1

QUERIES = (
    Query("Move"),
    Query("Drive", (("Target", "skiros.Shelf"),)),
    Query("Push"),
    Query("Push", (("Object", "skiros.Fragile"),)),
    Query("Push", (("Object", "skiros.Box"),)),
    Query("Insert", (("Object", "skiros.Product"),)),
)
RUNNING = (
    running("Move"),
    running("Drive", Target="skiros.Location"),
    running("Drive", Target="skiros.Shelf"),
    running("Push", Object="skiros.Glass"),
    running("Push", Object="skiros.Box"),
    running("Push"),
    running("Insert", Object="skiros.Fragile"),
)
WORLD = World(content())


@dataclass(frozen=True)
class Exemption:
    """`unless doing ...`, and what holds instead: nothing, an action, or another condition."""

    query: Query
    instead: str


@dataclass(frozen=True)
class Program:
    """One rule about a force, and whether its input has a timeout."""

    scope: tuple[Query, ...]
    exemptions: tuple[Exemption, ...]
    is_latched: bool
    has_timeout: bool

    def text(self) -> str:
        scope = f" while {', '.join(map(words, self.scope))}" if self.scope else ""
        exempted = "".join(
            f" unless {words(each.query)}{INSTEAD[each.instead]}" for each in self.exemptions
        )
        return f"""
        skills "{FILE}" timeout 1 sec;
        action stop;
        action slow;
        input force = topic /force : std_msgs/Float32 in N{" timeout 0.7 sec" * self.has_timeout};
        rule it: if force > {LIMIT} N{scope} then {{ stop; }}{exempted}
            {"latched until reset" * self.is_latched};
        """

    def actions(self) -> Iterator[tuple[str, ...]]:
        """The actions of each rule; a rule that only tells of an exemption has none."""
        yield ("stop",)
        for each in self.exemptions:
            if each.instead != "action":
                yield ()
            if each.instead != "nothing":
                yield ("slow",)


INSTEAD = {
    "nothing": "",
    "action": " then { slow; }",
    "condition": f" then if force > {OTHER_LIMIT} N then {{ slow; }}",
}


def words(query: Query) -> str:
    limits = ", ".join(f"{name}: {kind}" for name, kind in query.limits)
    return f"doing {query.skill}({limits})" if limits else f"doing {query.skill}"


@dataclass(frozen=True)
class Event:
    """A message about the force, one about skills, or silence, after some ticks."""

    ticks: int
    reported: float | SkillContext | None


def random_program(random: Random) -> Program:
    """A rule with any scopes and exemptions."""
    exempted = random.sample(QUERIES, random.randrange(4))
    exemptions = [Exemption(each, random.choice(sorted(INSTEAD))) for each in exempted]
    scope = random.sample(QUERIES, random.choice((0, 0, 1, 2)))
    is_latched, has_timeout = random.random() < 0.25, random.random() < 0.5
    return Program(tuple(scope), tuple(exemptions), is_latched, has_timeout)


def random_events(random: Random) -> list[Event]:
    """Messages in any order, with silence between them, and those of another export."""
    return [
        Event(random.choice((0, 1, 1, 2, 4, 8, 12)), _random_reported(random))
        for _ in range(random.randrange(MOST_EVENTS))
    ]


def _random_reported(random: Random) -> float | SkillContext | None:
    match random.randrange(5):
        case 0 | 1:
            digest = DIGEST if random.random() < 0.8 else "00" * 32
            return SkillContext(digest, tuple(random.choices(RUNNING, k=random.randrange(3))))
        case 2 | 3:
            return random.choice((1.0, 6.0, 9.0, 9.0, math.nan))
        case _:  # open: one of five
            return None


# --- what the semantics say ----------------------------------------------------------------------


def both(values: Sequence[int]) -> int:
    return F if F in values else max(values)


def either(values: Sequence[int]) -> int:
    return T if T in values else max(values)


def opposite(value: int) -> int:
    return {F: T, T: F}.get(value, value)


@dataclass
class Model:
    """The last messages of a robot, and the rules that are active, in the order of the rules."""

    program: Program
    force: float = math.nan
    force_ns: int | None = None
    context: SkillContext | None = None
    context_ns: int | None = None
    active: list[bool] = field(default_factory=list)

    def happens(self, at_ns: int, event: Event) -> None:
        """Time passes, with the instants at which something is stale, and then it is reported."""
        for due_ns in sorted(self._due(at_ns)):
            self._evaluate(due_ns)
        match event.reported:
            case SkillContext() as reported:
                self.context, self.context_ns = reported, at_ns
            case float(force):
                self.force, self.force_ns = force, at_ns
            case None:
                pass
        self._evaluate(at_ns)

    def _due(self, at_ns: int) -> Iterator[int]:
        for since_ns, timeout_ns in ((self.force_ns, FORCE_NS), (self.context_ns, CONTEXT_NS)):
            if since_ns is not None and since_ns + timeout_ns < at_ns:
                yield since_ns + timeout_ns

    def _evaluate(self, at_ns: int) -> None:
        values = list(self._conditions(at_ns))
        before = self.active or [False] * len(values)
        self.active = [
            value in (T, L) or (was and (value == U or (number == 0 and self.program.is_latched)))
            for number, (value, was) in enumerate(zip(values, before, strict=True))
        ]

    def _conditions(self, at_ns: int) -> Iterator[int]:
        program = self.program
        scope = [either([self._asked(each, at_ns) for each in program.scope] or [T])]
        exempted = [self._asked(each.query, at_ns) for each in program.exemptions]
        yield both([self._above(LIMIT, at_ns), *scope, *map(opposite, exempted)])
        for each in program.exemptions:
            kept = [*scope, self._kept(each.query, at_ns)]
            yield both([self._above(LIMIT, at_ns), *kept])
            if each.instead == "condition":
                yield both([self._above(OTHER_LIMIT, at_ns), *kept])

    def _above(self, limit: float, at_ns: int) -> int:
        is_late = self.force_ns is not None and at_ns - self.force_ns >= FORCE_NS
        if math.isnan(self.force) or (self.program.has_timeout and is_late):
            return L if self.program.has_timeout else U
        return int(self.force > limit)

    def _asked(self, query: Query, at_ns: int) -> int:
        """D(S) of S59."""
        return L if self._is_late(at_ns) in (T, U) or (flag := self._flag(query)) == U else flag

    def _kept(self, query: Query, at_ns: int) -> int:
        """K(S) of S59."""
        return both([self._flag(query), opposite(self._is_late(at_ns))])

    def _is_late(self, at_ns: int) -> int:
        return U if self.context_ns is None else int(at_ns - self.context_ns >= CONTEXT_NS)

    def _flag(self, query: Query) -> int:
        found = math.nan if self.context is None else WORLD.answer(query, self.context)
        return U if math.isnan(found) else int(found)


# --- and what the interpreter does ---------------------------------------------------------------


def _sent(machine: ir.Machine, event: Event) -> dict[int, ir.ChannelValues]:
    topics = [channel.topic for channel in machine.channels]
    match event.reported:
        case SkillContext() as reported:
            answers = {
                index: answer(slot.path[0], reported)
                for index, slot in enumerate(machine.slots)
                if isinstance(slot.path[0], ir.Doing)
            }
            has_skills = "/skill_context" in topics
            answered = ir.ChannelValues(answers, {})
            return {topics.index("/skill_context"): answered} if has_skills else {}
        case float(force):
            index = next(i for i, slot in enumerate(machine.slots) if slot.path == ("data",))
            return {topics.index("/force"): ir.ChannelValues({index: force}, {})}
        case None:
            return {}


def differences(program: Program, events: Sequence[Event]) -> Iterator[str]:
    """The differences between the active rules of the interpreter and of the model."""
    machine = machine_of(program.text())
    if [rule.actions for rule in machine.rules] != list(program.actions()):
        yield f"{[rule.actions for rule in machine.rules]}"
    monitor, model = Interpreter(machine), Model(program)
    at_ns = 0
    for event in events:
        at_ns += event.ticks * TICK + 1  # one more, so that no timeout ends where something happens
        sent = _sent(machine, event)
        if sent:
            monitor.update(at_ns, sent)
        else:
            monitor.advance(at_ns)
        model.happens(at_ns, event)
        if list(monitor.active) != model.active:
            yield f"at {at_ns} ns {monitor.active}, and not {model.active}: {event}"
