"""The placeholders of `host.c.j2`: the conversion of columns and packed values to calls of a
monitor.
"""

from __future__ import annotations

from rossmarie import ir
from rossmarie.targets.c99 import types
from rossmarie.targets.c99.layout import CLayout
from rossmarie.targets.c99.messages import Messages
from rossmarie.targets.c99.text import call, indented, table


def blanks(layout: CLayout, messages: Messages) -> dict[str, object]:
    """The values for the placeholders of the template."""
    return {
        "value_of_signal": _value_of_signal(layout),
        "updates": "\n".join(_update(layout, messages, c) for c in _channels(layout)),
        "packed": indented(_packed(layout, messages)),
        "step": indented(_step(layout, messages)),
        "flag_values": _flag_values(layout.machine),
        "columns": indented(_columns(layout, messages)),
        "row": indented(_row(layout, messages), 2),
        "active_bytes": (max(1, len(layout.machine.rules)) + 7) // 8,
    }


def _value_of_signal(layout: CLayout) -> str:
    places = (layout.value_index(signal) for signal in range(len(layout.machine.signals)))
    listed = [-1 if place is None else place for place in places]
    return table("int", "value_of_signal", listed)


def _channels(layout: CLayout) -> range:
    return range(len(layout.channel_names))


def _update(layout: CLayout, messages: Messages, channel: int) -> str:
    """One message, with every scalar as a double."""
    fields = messages.fields[channel]
    parameters = ["host *h", "int64_t t_ns"]
    arguments = ["&h->machine", "t_ns"]
    for field in fields:
        parameters += types.plain_parameters(field)
        arguments += types.arguments(field)
    call = f"take_{layout.channel_names[channel]}({', '.join(arguments)})"
    return f"int host_update_{channel}({', '.join(parameters)})\n{{\n    return {call};\n}}\n"


def _packed(layout: CLayout, messages: Messages) -> list[str]:
    """A case for every channel without arrays."""
    lines = []
    for channel, name in enumerate(layout.channel_names):
        fields = messages.fields[channel]
        if all(field.array is None for field in fields):
            slots = [f"slots[{place}]" for place in range(len(fields))]
            arguments = ", ".join(["&h->machine", "t_ns", *slots])
            lines += [f"case {channel}:", f"    return take_{name}({arguments});"]
    return lines


def _step(layout: CLayout, messages: Messages) -> list[str]:
    lines = [] if layout.channel_names else ["(void)present;", "v.has_nothing = true;"]
    for channel, name in enumerate(layout.channel_names):
        lines.append(f"v.has_{name} = present[{channel}] != 0;")
        for field in messages.fields[channel]:
            if field.slot is not None:
                lines.append(f"v.{name}.{field.name} = slots[{field.slot}];")
            else:
                lines.append(f"v.{name}.{field.name} = arrays[{field.array}];")
            if field.count is not None:
                lines.append(f"v.{name}.{field.count} = counts[{field.array}];")
    return lines


# --- columns ---------------------------------------------------------------------------------


def _flag_values(machine: ir.Machine) -> str:
    """The third value is for a missing flag: NaN, which is unknown."""
    if not any(slot.kind is ir.FieldKind.FLAG for slot in machine.slots):
        return ""
    return "\nstatic const double flag_values[] = {0.0, 1.0, NAN};\n"


def _columns(layout: CLayout, messages: Messages) -> list[str]:
    machine = layout.machine
    kinds = [
        "unsigned char" if slot.kind is ir.FieldKind.FLAG else "double" for slot in machine.slots
    ]
    lines = [_column(f"column_{index}", kind, index) for index, kind in enumerate(kinds)]
    for index in range(len(machine.arrays)):
        lines.append(_column(f"array_{index}", "double", len(kinds) + index))
        lines.append(f"const size_t width_{index} = table->widths[{index}];")
    if not _is_single(layout, messages):
        lines.append(f"{layout.name}_values v;")
        lines += [] if layout.channel_names else ["v.has_nothing = true;"]
        for channel, name in enumerate(layout.channel_names):
            arrives = "true" if messages.fields[channel] else f"table->arriving[{channel}] != 0"
            lines.append(f"v.has_{name} = {arrives};")
    return lines


def _column(name: str, kind: str, place: int) -> str:
    return f"const {kind} *{name} = (const {kind} *)table->columns[{place}];"


def _is_single(layout: CLayout, messages: Messages) -> bool:
    """Say whether every row is one message on the only channel."""
    return len(layout.channel_names) == 1 and bool(messages.fields[0])


def _cell(machine: ir.Machine, field: types.StructField) -> list[str]:
    """One field of row i, as plain arguments."""
    if field.slot is None:
        row = f"array_{field.array} + i * width_{field.array}"
        return [row] if field.count is None else [row, f"width_{field.array}"]
    cell = f"column_{field.slot}[i]"
    is_flag = machine.slots[field.slot].kind is ir.FieldKind.FLAG
    return [f"flag_values[{cell}]" if is_flag else cell]


def _row(layout: CLayout, messages: Messages) -> list[str]:
    if _is_single(layout, messages):
        cells = [cell for field in messages.fields[0] for cell in _cell(layout.machine, field)]
        take = call(f"take_{layout.channel_names[0]}", ["&h->machine", "times[i]", *cells])
        return [f"if ({take} < 0)", "    return i;"]
    lines = []
    for channel, name in enumerate(layout.channel_names):
        for field in messages.fields[channel]:
            members = types.arguments(field, f"v.{name}.")
            cells = _cell(layout.machine, field)
            lines += [f"{member} = {cell};" for member, cell in zip(members, cells, strict=True)]
    step = f"{layout.name}_step(&h->machine, times[i], &v)"
    return [*lines, f"if ({step} < 0)", "    return i;"]
