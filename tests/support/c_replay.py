"""A program that runs traces through the generated C and prints all that can be seen of them.

It uses the public interface: a function for each channel, `step` for several at once, `advance`,
`reset`, `next_wake`, `is_active` and the callback; and then `host.c`, for a run over columns.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Sequence

from rossmarie import ir
from rossmarie.interpreter import Interpreter
from rossmarie.native import MachineColumns
from rossmarie.targets.c99 import types
from rossmarie.targets.c99.layout import lay_out
from support.machines import Advance, Observation, Reset, Step, Update

_PROGRAM = """\
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "host.c"

static void print(void *user, const NAME_event *e)
{
    (void)user;
    if (e->change == NAME_TIME_JUMP) {
        printf("jump %" PRId64 " %" PRId64 "\\n", e->from_ns, e->at_ns);
        return;
    }
    printf("verdict %d %" PRId64 " %d", e->rule, e->at_ns, e->change);
    for (int i = 0; i < NAME_rules[e->rule].term_count; i++)
        printf(" %d %" PRId64, e->truth_values[i], e->since_ns[i]);
    for (int i = 0; i < NAME_rules[e->rule].value_count; i++) {
        uint64_t bits;
        memcpy(&bits, &e->values[i], sizeof bits);
        printf(" %" PRIx64, isnan(e->values[i]) ? UINT64_C(0) - 1 : bits);
    }
    for (int i = 0; i < NAME_rules[e->rule].input_count; i++)
        printf(" %d", e->inputs[i]);
    printf("\\n");
}

static void read_into(void *to, size_t size)
{
    if (fread(to, size, 1, stdin) != 1)
        exit(3);
}

static int64_t read_integer(void)
{
    int64_t x;
    read_into(&x, sizeof x);
    return x;
}

static double read_double(void)
{
    double x;
    read_into(&x, sizeof x);
    return x;
}

/* Exactly as long as the array, so that a read beyond its end is found. */
static const double *read_array(size_t *count)
{
    double *x;
    *count = (size_t)read_integer();
    x = (double *)malloc(*count ? *count * sizeof *x : 1);
    for (size_t i = 0; i < *count; i++)
        x[i] = read_double();
    return x;
}

/* As long as the column, for the same reason. */
static void *read_column(size_t size)
{
    void *x = malloc(size ? size : 1);
    if (size)
        read_into(x, size);
    return x;
}

static void print_state(const NAME_monitor *m)
{
    printf("step %" PRId64, NAME_next_wake(m));
    for (int i = 0; i < NAME_RULES; i++)
        printf(" %d", NAME_is_active(m, i));
    printf("\\nknown %d", NAME_has_all_inputs(m));
    for (int i = 0; i < NAME_INPUTS; i++)
        printf(" %d", NAME_input_state(m, i));
    for (int i = 0; i < WATCHED_COUNT; i++)
        printf(" %d", LOOK);
    printf("\\n");
}

static void run_table(void)
{
    enum { COLUMNS = COLUMN_COUNT, ARRAYS = ARRAY_COUNT, ARRIVING = CHANNEL_COUNT };
    host *h = host_new();
    const size_t rows = (size_t)read_integer();
    int64_t *times = (int64_t *)read_column(rows * sizeof *times);
    void *columns[COLUMNS + 1] = {NULL};
    size_t widths[ARRAYS + 1] = {0};
    unsigned char *arriving, *active = (unsigned char *)malloc(rows * ACTIVE_BYTES);
    host_table table;
    for (int i = 0; i < COLUMNS; i++)
        columns[i] = read_column((size_t)read_integer());
    for (int i = 0; i < ARRAYS; i++)
        widths[i] = (size_t)read_integer();
    arriving = (unsigned char *)read_column(ARRIVING);
    table.times = times;
    table.columns = (const void *const *)columns;
    table.widths = widths;
    table.arriving = arriving;
    if (host_run(h, 0, rows, &table, active) != rows)
        exit(4);
    for (size_t i = 0; i < h->count; i++)
        print(NULL, &h->events[i]);
    print_state(&h->machine);
    for (int i = 0; i < COLUMNS; i++)
        free(columns[i]);
    free(times);
    free(arriving);
    free(active);
    host_free(h);
}

static void run_trace(void)
{
    NAME_monitor *m = (NAME_monitor *)malloc(sizeof *m);
    (void)read_array; /* not every machine has arrays */
    if (NAME_init(m, print, NULL))
        abort();
    for (int64_t left = read_integer(); left > 0; left--)
        NAME_latch(m, (int)read_integer());
    print_state(m);
    for (int64_t left = read_integer(); left > 0; left--) {
        const int64_t kind = read_integer(), t_ns = read_integer();
        if (kind == 1) {
            NAME_advance(m, t_ns);
        } else if (kind == 2) {
            NAME_reset(m, t_ns, (int)read_integer());
        } else {
            NAME_values v;
            size_t elements = 0;
            (void)elements;
            memset(&v, 0, sizeof v);
READ
TAKE
FREE
        }
        NAME_latch(m, 0); /* too late: no effect */
        print_state(m);
    }
    free(m);
}

int main(void)
{
    for (int next = getchar(); next != EOF; next = getchar()) {
        ungetc(next, stdin);
        run_trace();
        run_table();
    }
    return 0;
}
"""


def program(machine: ir.Machine) -> str:
    """The text of the program for a machine."""
    layout = lay_out(machine)
    read, release, take = [], [], []
    for channel, name in enumerate(layout.channel_names):
        read.append(f"            v.has_{name} = read_integer() != 0;")
        read.append(f"            if (v.has_{name}) {{")
        for field in types.fields_of(machine, channel):
            member = f"v.{name}.{field.name}"
            if field.slot is not None:
                read.append(f"                {member} = read_double();")
            elif _is_column(machine, field):
                read.append(f"                {member} = read_array(&elements);")
                if field.count is not None:
                    count = f"v.{name}.{field.count}"
                    read.append(f"                {count} = (size_t)read_integer();")
                release.append(f"            free((void *)(uintptr_t){member});")
            else:
                read.append(f"                {member} = read_array(&v.{name}.{field.count});")
                release.append(f"            free((void *)(uintptr_t){member});")
        read.append("            }")
        others = [f"v.has_{other}" for other in layout.channel_names if other != name]
        # The parameters of flags and strings have no unknown value.
        lacking = [
            f"isnan(v.{name}.{field.name})"
            for field in types.fields_of(machine, channel)
            if field.slot is not None and machine.slots[field.slot].kind is not ir.FieldKind.REAL
        ]
        alone = " && ".join([f"v.has_{name}", *(f"!{other}" for other in [*others, *lacking])])
        arguments = ["m", "t_ns", *_arguments(machine, channel, f"v.{name}.")]
        call = f"{layout.name}_update_{name}({', '.join(arguments)});"
        take += [f"            if ({alone})", f"                {call}", "            else"]
    take.append("                NAME_step(m, t_ns, &v);")
    text = _PROGRAM.replace("READ", "\n".join(read)).replace("FREE", "\n".join(release))
    text = text.replace("TAKE", "\n".join(take))
    text = text.replace("LOOK", "(int)NAME_watch(m, i)" if machine.watches else "0")
    text = text.replace("WATCHED_COUNT", str(len(machine.watches)))
    text = text.replace("COLUMN_COUNT", str(len(machine.slots) + len(machine.arrays)))
    text = text.replace("ARRAY_COUNT", str(len(machine.arrays)))
    text = text.replace("CHANNEL_COUNT", str(max(1, len(machine.channels))))
    text = text.replace("ACTIVE_BYTES", str((len(machine.rules) + 7) // 8))
    return text.replace("NAME", layout.name)


def _is_column(machine: ir.Machine, field: types.StructField) -> bool:
    return field.array is not None and machine.arrays[field.array].list is not None


def _arguments(machine: ir.Machine, channel: int, prefix: str) -> list[str]:
    """The fields of a message as the public function of its channel takes them."""
    casts = {ir.FieldKind.REAL: "", ir.FieldKind.FLAG: "(bool)", ir.FieldKind.TEXT: "(int32_t)"}
    arguments = []
    for field in types.fields_of(machine, channel):
        cast = "" if field.slot is None else casts[machine.slots[field.slot].kind]
        arguments += [f"{cast}{name}" for name in types.arguments(field, prefix)]
    return arguments


# --- in --------------------------------------------------------------------------------------


def trace_bytes(machine: ir.Machine, trace: Sequence[Step], latched: Sequence[int] = ()) -> bytes:
    """The input of the program: the rules to latch, then the steps."""
    parts = [struct.pack(f"={len(latched) + 1}q", len(latched), *latched)]
    parts.append(struct.pack("=q", len(trace)))
    fields = [types.fields_of(machine, channel) for channel in range(len(machine.channels))]
    for step in trace:
        match step:
            case Update(at_ns, messages):
                parts.append(struct.pack("=2q", 0, at_ns))
                for channel, carried in enumerate(fields):
                    values = messages.get(channel)
                    parts.append(struct.pack("=q", values is not None))
                    if values is not None:
                        parts.append(_message(machine, carried, values))
            case Advance(at_ns):
                parts.append(struct.pack("=2q", 1, at_ns))
            case Reset(at_ns, rule):
                parts.append(struct.pack("=3q", 2, at_ns, -1 if rule is None else rule))
    return b"".join(parts)


def table_bytes(columns: MachineColumns) -> bytes:
    """The input of the program after the trace."""
    fields = [column.tobytes() for column in (*columns.slots, *columns.arrays)]
    return b"".join(
        [
            struct.pack("=q", len(columns.times_ns)),
            columns.times_ns.tobytes(),
            *(struct.pack("=q", len(values)) + values for values in fields),
            *(struct.pack("=q", array.shape[1]) for array in columns.arrays),
            columns.arriving.tobytes(),
        ]
    )


def _message(
    machine: ir.Machine, fields: Sequence[types.StructField], values: ir.ChannelValues
) -> bytes:
    parts = []
    for field in fields:
        if field.slot is not None:
            parts.append(struct.pack("=d", values.slots.get(field.slot, math.nan)))
        elif field.array is not None:
            elements = values.arrays.get(field.array, ())
            parts.append(struct.pack(f"=q{len(elements)}d", len(elements), *elements))
            its_list = machine.arrays[field.array].list
            if its_list is not None and field.count is not None:
                columns, most = ir.columns_of(machine, its_list), machine.lists[its_list].most
                count = ir.known_count(values, columns, most)
                parts.append(struct.pack("=q", -1 if count is None else count))
    return b"".join(parts)


# --- out -------------------------------------------------------------------------------------


def observations(machine: ir.Machine, output: bytes, steps: int) -> list[Observation]:
    """The observations in the output of the program, in the form of `observe`: before all steps,
    after each step, at the end.
    """
    found: list[Observation] = []
    events: list[object] = []
    for line in output.decode().splitlines():
        kind, *words = line.split()
        if kind == "jump":
            events.append(ir.TimeJump(int(words[0]), int(words[1])))
        elif kind == "verdict":
            events.append(_verdict(machine, words))
        elif kind == "step":
            wake = None if int(words[0]) == 2**63 - 1 else int(words[0])
            active = tuple(word == "1" for word in words[1:])
            found.append(Observation(tuple(events), wake, active))
            events = []
    assert len(found) == steps, "the program stopped early"
    return found


def knowledge(output: bytes) -> list[str]:
    """The states of inputs and watches in the output of the program, in the form of `known`."""
    lines = output.decode().splitlines()
    return [line for line in lines if line.startswith("known ")]


def known(machine: ir.Machine, monitor: Interpreter) -> str:
    """Say whether all inputs have arrived once, and give their states and the truth values of the
    watches.
    """
    states = monitor.input_states
    lacking = [
        used.timeout_ns is not None and state is ir.InputState.NEVER
        for used, state in zip(machine.inputs, states, strict=True)
    ]
    numbers = (not any(lacking), *states, *monitor.watches)
    return " ".join(["known", *(str(int(number)) for number in numbers)])


def _verdict(machine: ir.Machine, words: list[str]) -> object:
    index, at_ns, change = int(words[0]), int(words[1]), int(words[2])
    rule = machine.rules[index]
    values_at = 3 + 2 * len(rule.terms)
    inputs_at = values_at + len(rule.signals)
    propositions = tuple(ir.TruthValue(int(word)) for word in words[3:values_at:2])
    since_ns = tuple(int(word) for word in words[4:values_at:2])
    values = tuple(_bits(word) for word in words[values_at:inputs_at])
    inputs = tuple(ir.InputState(int(word)) for word in words[inputs_at:])
    return (index, at_ns, ir.Change(change), propositions, since_ns, values, inputs)


def _bits(word: str) -> str:
    bits = int(word, 16)
    return "nan" if bits == 2**64 - 1 else struct.pack("<Q", bits).hex()
