"""The functions that take messages in: one for each channel, and one for several at once.

Takes a layout and the expressions of its machine; gives C text.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import groupby

from rossmarie.targets.c99 import types
from rossmarie.targets.c99.coverage import covered_values, is_seen_by_guards
from rossmarie.targets.c99.elements import Elements
from rossmarie.targets.c99.expressions import Expressions, Piece
from rossmarie.targets.c99.layout import Layout
from rossmarie.targets.c99.text import call, indented


class Messages:
    """Writes what happens when messages arrive."""

    def __init__(self, layout: Layout) -> None:
        self._layout = layout
        self._machine = layout.machine
        self.expressions = Expressions(layout)
        self._elements = Elements(layout, self.expressions)
        self._covered = covered_values(layout)
        self.fields = [
            types.fields_of(self._machine, channel) for channel in range(len(layout.channel_names))
        ]

    # --- declarations ------------------------------------------------------------------------

    def declarations(self) -> str:
        """The public functions and the struct of all values."""
        parts = []
        for channel, name in enumerate(self._layout.channel_names):
            topic = self._machine.channels[channel]
            parts.append(f"/* A message on {topic.topic} ({topic.message_type}). */")
            parts.append(f"{self._public_signature(channel, name)};\n")
        parts.append(self._values_struct())
        return "\n".join(parts)

    def _public_signature(self, channel: int, name: str) -> str:
        monitor = self._layout.name
        parameters = [f"{monitor}_monitor *m", "int64_t t_ns"]
        for field in self.fields[channel]:
            parameters += types.public_parameters(self._machine, field)
        return call(f"int {monitor}_update_{name}", parameters)

    def _values_struct(self) -> str:
        monitor = self._layout.name
        members = []
        for channel, name in enumerate(self._layout.channel_names):
            members.append(f"bool has_{name};")
            fields = [p for field in self.fields[channel] for p in types.plain_parameters(field)]
            if fields:
                inside = indented(f"{field};" for field in fields)
                members += ["struct {", *inside.splitlines(), f"}} {name};"]
        body = indented(members or ["bool has_nothing;"])
        return (
            "/* Messages on several channels at one instant, those with has_...; in it flags are\n"
            " * 0.0 or 1.0, and a scalar that the message lacks is NaN.\n */\n"
            f"typedef struct {monitor}_values {{\n{body}\n}} {monitor}_values;\n\n"
            f"int {monitor}_step({monitor}_monitor *m, int64_t t_ns, const {monitor}_values *v);\n"
        )

    # --- functions ---------------------------------------------------------------------------

    def functions(self) -> str:
        """The functions of all channels, and the one for several at once."""
        parts = []
        for channel, name in enumerate(self._layout.channel_names):
            parts += [
                self._receive(channel, name),
                self._settle(channel, name),
                self._late(channel, name),
                self._take(channel, name),
                self._update(channel, name),
            ]
        parts.append(self._step())
        return "\n".join(parts)

    def constants(self) -> list[str]:
        """What is computed from constants only, once."""
        pieces = (*self.expressions.signals(), *self.expressions.tests())
        return [line for piece in pieces if not piece.channels for line in piece.lines]

    def _head(self, kind: str, channel: int) -> str:
        """A function that takes in one message of a channel."""
        parameters = ["monitor *m", "int64_t t_ns"]
        for field in self.fields[channel]:
            parameters += types.plain_parameters(field)
        return call(kind, parameters)

    def _call(self, function: str, channel: int) -> str:
        """A call of such a function."""
        arguments = ["m", "t_ns"]
        for field in self.fields[channel]:
            arguments += types.arguments(field)
        return call(function, arguments)

    def _receive(self, channel: int, name: str) -> str:
        """Store and compute, without looking at what changes by it."""
        pieces = [*self._stamps(), *self._computed({channel: ""}, raw=self._covered)]
        lines = [line for piece in pieces if channel in piece.channels for line in piece.lines]
        return (
            f"{self._head(f'INLINE void receive_{name}', channel)}\n{{\n"
            f"    m->now_ns = t_ns;\n{indented(lines)}\n}}\n"
        )

    def _settle(self, channel: int, name: str) -> str:
        """A number left its guard, maybe others too: the first is known, so that the processor
        guesses right about the rest.
        """
        if not self._layout.guards_of(channel):
            return ""
        lines = [line for piece in self._guards() if channel in piece.channels
                 for line in piece.lines]  # fmt: skip
        return (
            f"RARE int settle_{name}(monitor *m, int64_t t_ns, unsigned first)\n{{\n"
            f"    if (!m->quiet[{channel}])\n"
            f"        arrive(m, {channel}, t_ns);\n"
            f"    if (first != GUARDS)\n"
            f"        cross(m, first, m->value[guard_value[first]], t_ns);\n"
            f"{indented(lines)}\n"
            f"    return evaluate(m, t_ns);\n}}\n"
        )

    def _late(self, channel: int, name: str) -> str:
        """A timer may be due, or time begins, or goes backwards."""
        guards = self._layout.guards_of(channel)
        settle = f"settle_{name}(m, t_ns, GUARDS)" if guards else "evaluate(m, t_ns)"
        return (
            f"{self._head(f'RARE int late_{name}', channel)}\n{{\n"
            f"    int events = catch_up(m, t_ns);\n"
            f"    if (events < 0)\n"
            f"        return events;\n"
            f"    arrive(m, {channel}, t_ns);\n"
            f"    tick(m, t_ns);\n"
            f"    {self._call(f'receive_{name}', channel)};\n"
            f"    events += {settle};\n"
            f"    set_wake(m);\n"
            f"    return events;\n}}\n"
        )

    def _take(self, channel: int, name: str) -> str:
        calm = "is_calm(m, t_ns)"
        if not is_seen_by_guards(self._layout, channel):
            calm = f"({calm} && m->quiet[{channel}])"
        checks = []
        for guard in self._layout.guards_of(channel):
            value = self.expressions.kept(guard.value)
            checks.append(f"if (UNLIKELY(!is_inside(m, {guard.name}, {value})))")
            checks.append(f"    return settle_{name}(m, t_ns, {guard.name});")
        if any(channel in piece.channels for piece in self._followed()):
            checks += ["if (is_pending(m))", "    return evaluate(m, t_ns);"]
        return (
            f"{self._head(f'INLINE int take_{name}', channel)}\n{{\n"
            f"    if (UNLIKELY(!{calm}))\n"
            f"        return {self._call(f'late_{name}', channel)};\n"
            f"    {self._call(f'receive_{name}', channel)};\n"
            f"{indented([*checks, 'return 0;'])}\n}}\n"
        )

    def _update(self, channel: int, name: str) -> str:
        return (
            f"{self._public_signature(channel, name)}\n{{\n"
            f"    return {self._call(f'take_{name}', channel)};\n}}\n"
        )

    def _step(self) -> str:
        monitor, names = self._layout.name, self._layout.channel_names
        calm = ["is_calm(m, t_ns)"] if names else ["t_ns >= m->now_ns && t_ns < m->wake_ns"]
        calm += [f"(!v->has_{name} || m->quiet[{c}])" for c, name in enumerate(names)]
        arrivals = []
        for channel, name in enumerate(names):
            arrivals += [f"if (v->has_{name})", f"    arrive(m, {channel}, t_ns);"]
        prefixes = {c: f"v->{name}." for c, name in enumerate(names)}
        pieces = [*self._stamps(), *self._computed(prefixes), *self._guards()]
        unused = [] if names else ["(void)v;"]
        separator = " && "
        return (
            f"int {monitor}_step({monitor}_monitor *m, int64_t t_ns, const {monitor}_values *v)\n"
            f"{{\n    int events = 0;\n{indented(unused)}"
            f"    const bool calm = {separator.join(calm)};\n"
            f"    if (!calm) {{\n"
            f"        events = catch_up(m, t_ns);\n"
            f"        if (events < 0)\n"
            f"            return events;\n"
            f"{indented(arrivals, 2)}\n"
            f"        tick(m, t_ns);\n"
            f"    }}\n"
            f"    m->now_ns = t_ns;\n"
            f"{indented(self._guarded(pieces))}\n"
            f"    if (is_pending(m))\n"
            f"        events += evaluate(m, t_ns);\n"
            f"    if (!calm)\n"
            f"        set_wake(m);\n"
            f"    return events;\n}}\n"
        )

    def _guarded(self, pieces: Iterable[Piece]) -> Iterator[str]:
        """The pieces, each under the condition that one of its channels has a message."""
        relevant = (piece for piece in pieces if piece.channels)
        for channels, group in groupby(relevant, key=lambda piece: piece.channels):
            names = [f"v->has_{self._layout.channel_names[c]}" for c in sorted(channels)]
            yield f"if ({' || '.join(names)}) {{"
            yield from (f"    {line}" for piece in group for line in piece.lines)
            yield "}"

    # --- pieces ------------------------------------------------------------------------------

    def _stamps(self) -> Iterator[Piece]:
        for index, used in enumerate(self._machine.inputs):
            if used.timeout_ns is not None or index in self._layout.aged_inputs():
                line = f"m->stamp_ns[{self._layout.input_names[index]}] = t_ns;"
                yield Piece(frozenset({used.channel}), (line,))

    def _computed(
        self, prefixes: dict[int, str], raw: frozenset[int] = frozenset()
    ) -> Iterator[Piece]:
        """All numbers, in order; a field of channel c is found at `prefixes[c]` plus its name.
        The values in `raw` are left as they arrive.
        """
        for channel, prefix in prefixes.items():
            for field in self.fields[channel]:
                yield Piece(frozenset({channel}), tuple(self._received(field, prefix, raw)))
        yield from self.expressions.signals()
        yield from self.expressions.tests()
        yield from self._followed()

    def _received(self, field: types.Field, prefix: str, raw: frozenset[int]) -> list[str]:
        name = f"{prefix}{field.name}"
        if field.slot is not None:
            is_raw = self._layout.value_of_slot[field.slot] in raw
            return [self.expressions.arrival(field.slot, name, is_raw=is_raw)]
        assert field.array is not None, "a field is a slot or an array"
        unused = [f"(void){name};", f"(void){name}_count;"]
        return self._elements.loop(field.array, name, f"{name}_count") or unused

    def _followed(self) -> Iterator[Piece]:
        for number, truth in enumerate(self._layout.oscillations):
            channels = self._layout.supports.truths[truth].channels
            yield Piece(channels, (f"follow(m, {number}, t_ns);",))

    def _guards(self) -> Iterator[Piece]:
        for guard in self._layout.guards:
            channels = self._layout.values[guard.value].support.channels
            value = self.expressions.kept(guard.value)
            check = f"if (!is_inside(m, {guard.name}, {value}))"
            yield Piece(channels, (check, f"    cross(m, {guard.name}, {value}, t_ns);"))
