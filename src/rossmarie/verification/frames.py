"""Frames: the members that a function leaves unchanged, and the changes of inputs by a message.

The input is a layout; the result is C that compares a monitor with its expected state, member by
member.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping

from rossmarie.ir import model as ir
from rossmarie.verification.definitions import Definitions
from rossmarie.verification.invariants import remark_of
from rossmarie.verification.layout import ProofLayout
from rossmarie.verification.program import obligation
from rossmarie.verification.recent import first_recent, recent
from rossmarie.verification.turning_points import followed_on, forgotten

_MEMBER = re.compile(r"(?P<kind>.*?) ?\*?(?P<name>\w+)(\[(?P<count>\d+)\])?(\[\d+\])?;")

_SAMPLES = ("latest", "before", "latest_ns", "before_ns")
_TURNS = ("extreme", "heading", "recent_count", "recent_next")
_GUARDS = ("low", "high", "place")
_MARKS = ("dirty", "pending")


class FrameChecks:
    """Writes these comparisons for one machine."""

    def __init__(self, layout: ProofLayout, definitions: Definitions) -> None:
        self._layout = layout
        self._definitions = definitions
        self._machine = layout.machine
        self._covered = layout.places.kept_raw
        self._doubles: set[str] = set()
        self._places: dict[str, list[str]] = {}
        for member in layout.places.members:
            found = _MEMBER.fullmatch(member)
            assert found is not None, f"{member} is no member"
            name, count = found["name"], found["count"]
            if name.startswith("window_"):
                continue  # only `window_middle` reads these; nothing about them is proved
            places = [f"{name}[{place}]" for place in range(int(count))] if count else [name]
            self._places[name] = places
            if found["kind"] == "double":
                self._doubles.add(name)

    def text(self) -> str:
        """The functions that compare."""
        return f"{self._same()}\n{self._reported()}"

    def _same(self) -> str:
        lines = []
        for name, places in self._places.items():
            for place in places:
                pair = f"m->{place}", f"other->{place}"
                is_double = name in self._doubles
                same = f"spec_same({pair[0]}, {pair[1]})" if is_double else " == ".join(pair)
                lines.append(obligation(same, f"`{name}` has its expected value"))
        body = "\n".join(lines)
        return f"static void must_be_same(const monitor *m, const monitor *other)\n{{\n{body}\n}}\n"

    # --- messages ----------------------------------------------------------------------------

    def _reported(self) -> str:
        """S7, S9: a message makes its inputs fresh and changes no other input."""
        lines = []
        for index, used in enumerate(self._machine.inputs):
            is_reported = f"is_reported[{used.channel}]"
            stamp = f"m->stamp_ns[{index}] == ({is_reported} ? asked_ns : old->stamp_ns[{index}])"
            if self._is_stamped(index):
                lines.append(
                    obligation(stamp, f"the stamp of {used.name} is the stamp of its last message")
                )
            state = f"m->state[{index}] == ({is_reported} ? FRESH : old->state[{index}])"
            lines.append(
                obligation(state, f"a message makes {used.name} fresh; nothing else changes it")
            )
        for index, value in enumerate(self._layout.values):
            reported = [f"is_reported[{channel}]" for channel in sorted(value.support.channels)]
            same = f"spec_same({self._seen(index, 'm->')}, {self._seen(index, 'old->')})"
            about = f"no other message changes `{remark_of(value)}`"
            lines.append(obligation(" || ".join([*reported, same]), about))
        lines += [
            obligation(f"m->{place} == old->{place}", "no rule changes")
            for place in self._places["active"]
        ]
        channels = max(1, len(self._machine.channels))
        return _REPORTED.format(channels=channels, lines="\n".join(lines))

    def _is_stamped(self, index: int) -> bool:
        """Say whether a timeout or a proposition uses the age of an input."""
        has_timeout = self._machine.inputs[index].timeout_ns is not None
        return has_timeout or index in self._layout.aged_inputs()

    # --- functions ---------------------------------------------------------------------------

    def kept(self, lines: Iterable[str] = ()) -> str:
        """The obligation that nothing has changed since `old`, except as the lines change
        `expected`.
        """
        inside = ["monitor expected = old;", *lines, "must_be_same(m, &expected);"]
        return "\n".join(["    {", *(f"        {line}" for line in inside), "    }"])

    def any_marks(self) -> Iterator[str]:
        """Take over any marks into `expected`."""
        yield from self._any(*_MARKS)

    def _any(self, *names: str) -> Iterator[str]:
        """Take over any values of these members, if the members exist, into `expected`."""
        for name in names:
            yield from (f"expected.{place} = m->{place};" for place in self._places.get(name, ()))

    def _some(self, name: str, places: Iterable[int]) -> Iterator[str]:
        yield from (f"expected.{name}[{place}] = m->{name}[{place}];" for place in places)

    def _propositions(self, nodes: Iterable[int]) -> Iterator[str]:
        """Take over any values of propositions; `since_ns` changes with the value."""
        for node in nodes:
            yield f"if (m->truth_value[{node}] != old.truth_value[{node}])"
            yield f"    expected.since_ns[{node}] = t_ns;"
            yield f"expected.truth_value[{node}] = m->truth_value[{node}];"

    def _values(self, changed: Iterable[tuple[int, str]]) -> Iterator[str]:
        """Take over numbers that may change under some conditions."""
        for value, where in changed:
            yield f"if (({where}) || spec_same({self._seen(value, 'old.')}, m->value[{value}]))"
            yield f"    expected.value[{value}] = m->value[{value}];"

    def _seen(self, value: int, memory: str) -> str:
        """A number as a reader gets it: the monitor stores some numbers as received until they are
        read (S4).
        """
        kept = f"{memory}value[{value}]"
        return f"spec_finite({kept})" if value in self._covered else kept

    def evaluated(self) -> str:
        """The frame of `evaluate`, with calls of `visit` that only mark."""
        return self.kept(["expected.now_ns = t_ns;", *self.any_marks()])

    def visited(self, node: int) -> str:
        """The frame of `visit`. The changes of rules have a separate proof."""
        held = [
            k
            for k, t in enumerate(self._layout.held)
            if self._layout.node_of_proposition[t] == node
        ]
        sinces, recent = (
            [
                k
                for k, proposition in enumerate(each)
                if self._layout.node_of_proposition[proposition] == node
            ]
            for each in (self._layout.sinces, self._layout.recent)
        )
        lines = [
            *self.any_marks(),
            *self._any("wake_ns", "active"),
            *self._propositions([node] if node < self._layout.proposition_count else []),
            *(line for name in ("held_due_ns", "held_before") for line in self._some(name, held)),
            *self._some("since_before", sinces),
            *(line for name in ("gap", "gap_end_ns") for line in self._some(name, recent)),
            *(line for k in recent for line in self._edge(k)),
        ]
        return self.kept(lines)

    def _edge(self, k: int) -> Iterator[str]:
        """S48: an edge is kept if a condition is now true and was false."""
        node, first = recent(self._layout, k), first_recent(self._layout, k)
        if not isinstance(node, ir.Recurs):
            return
        place = k - len(self._layout.oscillations)
        operand, following = self._definitions.proposition(node.operand), f"old.recent_next[{k}]"
        yield f"expected.edge_before[{place}] = {operand};"
        yield f"if ({operand} == TRUE && old.edge_before[{place}] == FALSE) {{"
        for each in range(node.count):
            yield f"    if ({following} == {each})"
            yield f"        expected.recent_ns[{first + each}] = t_ns;"
        yield f"    expected.recent_next[{k}] = ({following} + 1u) % {node.count}u;"
        yield f"    expected.recent_count[{k}] += old.recent_count[{k}] < {node.count};"
        yield "}"

    def ticked(self) -> str:
        """The frame of `tick`: expired inputs are forgotten (S9)."""
        expired: dict[int, str] = {}
        lines: list[str] = []
        for index, used in enumerate(self._machine.inputs):
            if used.timeout_ns is not None:
                over = f"t_ns - old.stamp_ns[{index}] >= INT64_C({used.timeout_ns})"
                expired[index] = f"(old.state[{index}] == FRESH && {over})"
                lines += [f"if ({expired[index]})", f"    expected.state[{index}] = EXPIRED;"]
        stale = [
            (value, " || ".join([expired[i] for i in sorted(found.support.inputs) if i in expired]))
            for value, found in enumerate(self._layout.values)
        ]
        lines += [
            *self._values((value, where or "false") for value, where in stale),
            *self._propositions(range(self._layout.leaf_count)),
            *self.any_marks(),
            *self._any("wake_ns", "quiet", "swinging", *_GUARDS, *_SAMPLES),
            *forgotten(self._layout, self._definitions),
        ]
        return "\n".join([*self._forgotten(expired), self.kept(lines)])

    def _forgotten(self, expired: Mapping[int, str]) -> Iterator[str]:
        """S74: a result over elements is forgotten together with the numbers that it uses beside
        them. The invariants state the same for all other inputs.
        """
        for value, found in enumerate(self._layout.values):
            for used in sorted(found.support.inputs - found.support.needed):
                if used in expired:
                    about = (
                        f"`{remark_of(found)}` becomes unknown with a number beside elements (S74)"
                    )
                    yield obligation(f"!({expired[used]}) || isnan(m->value[{value}])", about)

    def restarted(self) -> str:
        """The frame of `restart`: inputs keep their ages; samples, durations and edges are
        forgotten (S17).
        """
        lines: list[str] = []
        for index in range(len(self._machine.inputs)):
            age = f"old.now_ns - old.stamp_ns[{index}]"
            longest = f"{age} < LONGEST ? {age} : LONGEST"
            lines.append(f"expected.stamp_ns[{index}] = t_ns - ({longest});")
        for name in ("gap", "edge_before"):
            was = "old.started ? UNKNOWN : FALSE"
            lines += [f"expected.{place} = {was};" for place in self._places.get(name, ())]
        for k, proposition in enumerate(self._layout.held):
            node = self._machine.propositions[proposition].node
            at_start = "TRUE" if isinstance(node, ir.Held) and node.initially else "FALSE"
            lines.append(f"expected.held_before[{k}] = old.started ? UNKNOWN : {at_start};")
        rates = [v for v, found in enumerate(self._layout.values) if self._is_sampled(v)]
        others = [v for v in range(len(self._layout.values)) if v not in rates]
        lines += [
            *(f"expected.value[{value}] = NAN;" for value in rates),
            *self._values((value, "false") for value in others),
            *self._any("now_ns", "wake_ns", "started", "quiet", "truth_value", "since_ns"),
            *self._any("held_due_ns", "gap_end_ns", "swinging"),
            *self.any_marks(),
            *self._any(*_GUARDS, *_SAMPLES),
            *(f"expected.extreme[{k}] = NAN;" for k in range(len(self._layout.oscillations))),
            *(
                f"expected.{place} = 0;"
                for name in ("heading", "recent_count")
                for place in self._places.get(name, ())
            ),
        ]
        return self.kept(lines)

    def _is_sampled(self, value: int) -> bool:
        """Say whether a number depends on earlier samples."""
        return bool(self._layout.values[value].support.sampled)

    def received(self, channel: int) -> str:
        """The frame of `receive_X`: the numbers of a message, and the values computed from them."""
        stamped = [
            index
            for index, used in enumerate(self._machine.inputs)
            if used.channel == channel and self._is_stamped(index)
        ]
        values = [
            value
            for value, found in enumerate(self._layout.values)
            if channel in found.support.channels
        ]
        return self.kept(
            [
                "expected.now_ns = t_ns;",
                *(f"expected.stamp_ns[{index}] = t_ns;" for index in stamped),
                *self._some("value", values),
                *self.any_marks(),
                *self._any("wake_ns", "swinging", *_SAMPLES),
                *self._turning_points(followed_on(self._layout, channel)),
            ]
        )

    def _turning_points(self, oscillations: Iterable[int]) -> Iterator[str]:
        """Take over any changes of turning points, which have a separate proof."""
        for k in oscillations:
            first = first_recent(self._layout, k)
            instants = range(first, first + recent(self._layout, k).count)
            yield from self._some("recent_ns", instants)
            for name in _TURNS:
                yield from self._some(name, [k])

    def woken(self) -> str:
        """The frame of `set_wake`."""
        return self.kept(self._any("wake_ns"))

    # --- rules that are latched --------------------------------------------------------------

    def latched(self, which: str, becomes: str) -> str:
        """The frame of latching or resetting rules. `which` is -1 for all rules, or the number of
        one rule. `becomes` gives the new state of a rule from its old state `was` and its
        `condition`.
        """
        lines = []
        for index, rule in enumerate(self._machine.rules):
            was, now = (
                f"(({m}active[{index // 8}] >> {index % 8} & 1) != 0)" for m in ("old.", "m->")
            )
            node = self._layout.node_of_proposition[rule.condition]
            expected = was
            if rule.release is None:
                then = becomes.format(was=was, condition=f"m->truth_value[{node}]", index=index)
                expected = f"({which.format(index=index)} ? {then} : {was})"
            about = f"rule {rule.name} is active according to S38"
            lines.append(obligation(f"{now} == {expected}", about))
        return "\n".join([*lines, self.kept(self._any("active"))])


_REPORTED = """\
static bool is_reported[{channels}];

static void must_be_reported(const monitor *m, const monitor *old)
{{
{lines}
}}
"""
