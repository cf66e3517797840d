"""The functions that process messages: one for each channel, and one for several channels at once.

The input is a layout and the expressions of its machine; the result is C text.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import groupby

from rossmarie import ir
from rossmarie.targets import comments
from rossmarie.targets.c99 import types
from rossmarie.targets.c99.coverage import covered_values, is_seen_by_guards
from rossmarie.targets.c99.elements import ElementLoops
from rossmarie.targets.c99.expressions import ChannelStatements, Expressions
from rossmarie.targets.c99.layout import CLayout
from rossmarie.targets.c99.text import block, boolean, call, indented


class Messages:
    """Writes the processing of messages."""

    def __init__(self, layout: CLayout) -> None:
        self._layout = layout
        self._machine = layout.machine
        self.expressions = Expressions(layout)
        self._elements = ElementLoops(layout, self.expressions)
        self._covered = covered_values(layout)
        self._beside = ir.beside(self._machine)
        self.fields = [
            types.fields_of(self._machine, channel) for channel in range(len(layout.channel_names))
        ]

    # --- declarations ------------------------------------------------------------------------

    def declarations(self) -> str:
        """The public functions and the struct of all values."""
        parts = []
        for channel, name in enumerate(self._layout.channel_names):
            topic = self._machine.channels[channel]
            parts.append(f"/* Processes a message on {topic.topic} ({topic.message_type}). */")
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
            "/* Messages on several channels at one instant. A channel has a message if has_...\n"
            " * is true. A flag is 0.0 or 1.0. A scalar that a message does not contain is NaN.\n"
            " */\n"
            f"typedef struct {monitor}_values {{\n{body}\n}} {monitor}_values;\n\n"
            "/* Processes messages on several channels at one instant. */\n"
            f"int {monitor}_step({monitor}_monitor *m, int64_t t_ns, const {monitor}_values *v);\n"
        )

    # --- functions ---------------------------------------------------------------------------

    def functions(self) -> str:
        """The functions of all channels, and the function for several channels at once."""
        parts = [self._constants(), *self._prepare(), self._compute()]
        for channel, name in enumerate(self._layout.channel_names):
            parts += [
                self._receive(channel, name),
                *self._fold(channel, name),
                self._take(channel, name),
                self._update(channel, name),
            ]
        parts.append(self._step())
        return "\n".join(parts)

    def _constants(self) -> str:
        """Compute, once, the signals that depend only on constants, or on a parameter with its
        default.
        """
        made = self.expressions
        pieces = (*made.prepared(), *made.signals(), *made.tests())
        given = {each.channel for each in ir.settings_of(self._layout.machine)}
        lines = [
            line
            for piece in pieces
            if not piece.channels or piece.channels & given
            for line in piece.lines
        ]
        if not lines:
            return "static void set_constants(monitor *m) { (void)m; }\n"
        return f"static void set_constants(monitor *m)\n{{\n{indented(lines)}\n}}\n"

    def _prepare(self) -> Iterator[str]:
        """Compute the numbers beside elements, if there are any. This happens after all numbers of
        messages are stored and before any result over elements.
        """
        lines = list(self._guarded(self.expressions.prepared()))
        if lines:
            yield (
                "/* Computes the numbers that are used beside the elements of arrays (S74). */\n"
                "INLINE void prepare(monitor *m, const bool arrived[])\n"
                f"{{\n{block(lines)}}}\n"
            )

    def _compute(self) -> str:
        """Compute the signals that depend on the numbers of messages. This happens after all
        messages are stored.
        """
        lines = list(self._guarded(self._computed()))
        unused = [] if lines else ["    (void)arrived;\n"]
        return (
            "/* Computes the values that depend on the messages that arrived. */\n"
            "INLINE void compute(monitor *m, const bool arrived[], int64_t t_ns)\n{\n"
            f"    m->now_ns = t_ns;\n{''.join(unused)}{block(lines)}}}\n"
        )

    def _head(self, kind: str, channel: int) -> str:
        """A function that processes one message of a channel."""
        parameters = ["monitor *m", "int64_t t_ns"]
        for field in self.fields[channel]:
            parameters += types.plain_parameters(field)
        return call(kind, parameters)

    def _call(self, function: str, channel: int, prefix: str = "") -> str:
        """The call of the function that processes one message of a channel."""
        arguments = ["m", "t_ns"]
        for field in self.fields[channel]:
            arguments += types.arguments(field, prefix)
        return call(function, arguments)

    def _receive(self, channel: int, name: str) -> str:
        """Store the content of a message."""
        lines = [*self._stamps(channel)]
        for field in self.fields[channel]:
            lines += self._received(field, channel)
        unused = [] if any("t_ns" in line for line in lines) else ["(void)t_ns;"]
        unused += [] if any("m->" in line for line in lines) else ["(void)m;"]
        topic = self._machine.channels[channel]
        place = comments.in_c(f"{topic.topic} ({topic.message_type})")
        remark = f"/* Stores a message on {place}. */"
        return (
            f"{remark}\n{self._head(f'INLINE void receive_{name}', channel)}\n{{\n"
            f"{indented([*lines, *unused])}\n}}\n"
        )

    def _fold(self, channel: int, name: str) -> Iterator[str]:
        """Compute the results over elements that also depend on numbers beside them."""
        lines = [
            line
            for field in self.fields[channel]
            if self._is_beside_numbers(field)
            for line in self._loop(field, channel)
        ]
        if lines:
            yield f"{self._fold_head(channel, name)}\n{{\n{indented(lines)}\n}}\n"

    def _folded(self, channel: int) -> list[types.StructField]:
        """The arrays of a channel whose elements are compared with numbers beside them."""
        return [field for field in self.fields[channel] if self._is_beside_numbers(field)]

    def _fold_head(self, channel: int, name: str) -> str:
        parameters = ["monitor *m"]
        for field in self._folded(channel):
            parameters += types.plain_parameters(field)
        return call(f"INLINE void fold_{name}", parameters)

    def _folds(self, channel: int, name: str, prefix: str = "") -> Iterator[str]:
        """The call of the function that `_fold` writes, if there is one."""
        if not self._folded(channel):
            return
        arguments = ["m"]
        for field in self._folded(channel):
            arguments += types.arguments(field, prefix)
        yield f"{call(f'fold_{name}', arguments)};"

    def _preparing(self) -> Iterator[str]:
        if any(True for _ in self.expressions.prepared()):
            yield "prepare(m, arrived);"

    def _take(self, channel: int, name: str) -> str:
        calm = "is_calm(m, t_ns)"
        if not is_seen_by_guards(self._layout, channel):
            calm += f" && m->quiet[{channel}]"
        arrived = ", ".join(boolean(each == channel) for each in range(len(self.fields)))
        unchanged = ["before == CALM"]
        for guard in self._layout.guards_of(channel):
            value = self.expressions.kept(guard.value)
            unchanged.append(f"is_inside(m, {guard.name}, {value})")
        if any(channel in piece.channels for piece in self._followed()):
            unchanged.append("!is_pending(m)")
        lines = [
            f"static const bool arrived[CHANNELS] = {{{arrived}}};",
            f"const int before = UNLIKELY(!({calm})) ? begin(m, arrived, t_ns) : (int)CALM;",
            "if (UNLIKELY(before == REFUSED))",
            "    return REFUSED;",
            f"{self._call(f'receive_{name}', channel)};",
            *self._preparing(),
            *self._folds(channel, name),
            "compute(m, arrived, t_ns);",
            f"if ({' && '.join(unchanged)})",
            "    return 0;",
            "return settle(m, arrived, t_ns, before);",
        ]
        return f"{self._head(f'INLINE int take_{name}', channel)}\n{{\n{indented(lines)}\n}}\n"

    def _update(self, channel: int, name: str) -> str:
        return (
            f"{self._public_signature(channel, name)}\n{{\n"
            f"    return {self._call(f'take_{name}', channel)};\n}}\n"
        )

    def _step(self) -> str:
        monitor, names = self._layout.name, self._layout.channel_names
        arrived = ", ".join(f"v->has_{name}" for name in names) or "v->has_nothing"
        received, folded = list[str](), list[str]()
        for channel, name in enumerate(names):
            arrives = f"if (v->has_{name})"
            received += [arrives, f"    {self._call(f'receive_{name}', channel, f'v->{name}.')};"]
            for folds in self._folds(channel, name, f"v->{name}."):
                folded += [arrives, f"    {folds}"]
        lines = [
            f"const bool arrived[] = {{{arrived}}};",
            "const int before = are_calm(m, arrived, t_ns) ? (int)CALM : begin(m, arrived, t_ns);",
            "if (before == REFUSED)",
            "    return REFUSED;",
            *received,
            *self._preparing(),
            *folded,
            "compute(m, arrived, t_ns);",
            f"if ({' && '.join(self._unchanged())})",
            "    return 0;",
            "return settle(m, arrived, t_ns, before);",
        ]
        return (
            f"int {monitor}_step({monitor}_monitor *m, int64_t t_ns, const {monitor}_values *v)\n"
            f"{{\n{indented(lines)}\n}}\n"
        )

    def _unchanged(self) -> Iterator[str]:
        """The conditions on which messages on several channels change no proposition."""
        yield "before == CALM"
        if self._layout.oscillations:
            yield "!is_pending(m)"
        for guard in self._layout.guards:
            channels = sorted(self._layout.values[guard.value].support.channels)
            if not channels:
                continue  # a comparison with a constant
            arrived = " || ".join(f"arrived[{channel}]" for channel in channels)
            inside = f"is_inside(m, {guard.name}, {self.expressions.kept(guard.value)})"
            yield f"(!({arrived}) || {inside})"

    def _guarded(self, pieces: Iterable[ChannelStatements]) -> Iterator[str]:
        """The pieces, each under the condition that one of its channels has a message."""
        relevant = (piece for piece in pieces if piece.channels)
        for channels, group in groupby(relevant, key=lambda piece: piece.channels):
            names = [f"arrived[{channel}]" for channel in sorted(channels)]
            yield f"if ({' || '.join(names)}) {{"
            yield from (f"    {line}" for piece in group for line in piece.lines)
            yield "}"

    # --- pieces ------------------------------------------------------------------------------

    def _stamps(self, channel: int) -> Iterator[str]:
        for index, used in enumerate(self._machine.inputs):
            is_timed = used.timeout_ns is not None or index in self._layout.aged_inputs()
            if is_timed and used.channel == channel:
                yield f"m->stamp_ns[{self._layout.input_names[index]}] = t_ns;"

    def _received(self, field: types.StructField, channel: int) -> list[str]:
        """The assignment of a field in the memory of the monitor. Numbers with guards are stored as
        received.
        """
        if field.slot is not None:
            is_raw = self._layout.value_of_slot[field.slot] in self._covered
            return [self.expressions.arrival(field.slot, field.name, is_raw=is_raw)]
        if self._is_beside_numbers(field):
            return [f"(void){name};" for name in types.arguments(field)]
        return self._loop(field, channel)

    def _is_beside_numbers(self, field: types.StructField) -> bool:
        return field.array is not None and self._first(field.array) in self._beside

    def _first(self, array: int) -> int:
        """The first column of an array's list; the array itself if it belongs to no list."""
        its_list = self._machine.arrays[array].list
        return array if its_list is None else ir.columns_of(self._machine, its_list)[0]

    def _loop(self, field: types.StructField, channel: int) -> list[str]:
        """The loop over the elements of an array; for a list, at its last column."""
        assert field.array is not None, "a field is a slot or an array"
        if field.count is None:
            return []
        columns = {
            each.array: each.name
            for each in self.fields[channel]
            if each.array is not None and self._is_beside(each.array, field.array)
        }
        lines = self._elements.loop(columns, field.count)
        used = set(re.findall(r"\w+", " ".join(lines)))
        unused = (name for name in (*columns.values(), field.count) if name not in used)
        return [*lines, *(f"(void){name};" for name in unused)]

    def _is_beside(self, array: int, other: int) -> bool:
        """Say whether two arrays are the same, or columns of one list."""
        its_list = self._machine.arrays[array].list
        return array == other or (
            its_list is not None and its_list == self._machine.arrays[other].list
        )

    def _computed(self) -> Iterator[ChannelStatements]:
        yield from self.expressions.signals()
        yield from self.expressions.tests()
        yield from self._followed()

    def _followed(self) -> Iterator[ChannelStatements]:
        for number, proposition in enumerate(self._layout.oscillations):
            channels = self._layout.supports.propositions[proposition].channels
            yield ChannelStatements(channels, (f"follow(m, {number}, t_ns);",))
