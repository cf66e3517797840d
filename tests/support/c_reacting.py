"""A program that runs events through a generated reactor and prints all that can be seen of it.

The monitor is not there: the program itself says which rules are active and what is watched.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator, Sequence

from rossmarie import ir
from rossmarie.interpreter import Reactor
from rossmarie.ir import TaskCommandKind
from support.growing import TICK
from support.reacting import ReactingCase, look

LATER = (0, 1, TICK // 3, 3 * TICK, -TICK)
"""The times at which bounds are queried, counted from an event."""

EVER = {"INT64_MIN": -(2**63), "INT64_MAX": 2**63 - 1, "(INT64_C(1) << 62) - 1": 2**62 - 1}
"""And at these instants, whenever the event was."""

PROGRAM = """\
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "NAME_reactor.c"

static unsigned char active[NAME_RULES];
static unsigned char exempted[NAME_RULES];
static unsigned char watched[WATCHED_COUNT + 1];
static double readings[READING_COUNT + 1];

bool NAME_is_active(const NAME_monitor *m, int rule) { (void)m; return active[rule] != 0; }

WATCH

READING

static void read_into(void *to, size_t size)
{
    if (size != 0 && fread(to, size, 1, stdin) != 1)
        exit(3);
}

static int64_t read_integer(void)
{
    int64_t x;
    read_into(&x, sizeof x);
    return x;
}

static void print_bits(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    printf(" %" PRIx64, bits);
}

PRINT_TASK_COMMAND

BOUNDS

int main(void)
{
    NAME_reactor *r = (NAME_reactor *)malloc(sizeof *r);
    NAME_monitor *m = NULL;
    if (NAME_reactor_init(r, print_task_command, r))
        return EXIT_FAILURE;
    for (int64_t left = read_integer(); left > 0; left--) {
        const int64_t opens = read_integer(), t_ns = read_integer(), task = read_integer();
        const bool success = read_integer() != 0;
        read_into(active, sizeof active);
        read_into(exempted, sizeof exempted);
        read_into(watched, WATCHED_COUNT);
        read_into(readings, READING_COUNT * sizeof *readings);
        if (opens)
            NAME_reactor_open(r);
        /* Out of range: nothing happens. */
        NAME_react(r, m, NULL, INT64_MIN);
        NAME_report(r, m, INT64_C(1) << 62, 0, false);
        NAME_report(r, m, t_ns, NAME_TASKS, false);
        if (task < 0)
            NAME_react(r, m, exempted, t_ns);
        else
            NAME_report(r, m, t_ns, (int)task, success);
        printf("wake %" PRId64 "\\n", NAME_reactor_next_wake(r));
        printf("states");
        for (int i = 0; i < NAME_TASKS; i++)
            printf(" %d", NAME_task_state(r, i));
        printf("\\n");
        PRINT_BOUNDS
    }
    free(r);
    return 0;
}
"""

_WATCH = """\
enum NAME_truth_value NAME_watch(const NAME_monitor *m, int watch)
{
    (void)m;
    return (enum NAME_truth_value)watched[watch];
}
"""

_READING = """\
double NAME_reading(const NAME_monitor *m, int reading)
{
    (void)m;
    return readings[reading];
}
"""

_TASK_COMMAND = """\
static void print_task_command(void *user, int task, enum NAME_task_command command, int by_rule)
{
    (void)user;
    printf("command %d %d %d", (int)command, task, by_rule);
    POSE
    printf("\\n");
}
"""

_POSE = """\
if (command == NAME_RETRACE) {
        double pose[7];
        const int numbers = NAME_retraced((const NAME_reactor *)user, task, pose);
        for (int i = 0; i < numbers; i++)
            print_bits(pose[i]);
    }
"""

_BOUNDS = """\
static void print_bounds(const NAME_reactor *r, int64_t t_ns)
{
    static const int fields[] = {FIELDS};
    NAME_bounds bounds[MOST_FIELDS];
    for (int command = 0; command < NAME_COMMANDS; command++) {
        NAME_bounds_of(r, t_ns, command, bounds);
        for (int i = 0; i < fields[command]; i++) {
            printf("bounds");
            print_bits(bounds[i].factor);
            print_bits(bounds[i].low);
            print_bits(bounds[i].high);
            print_bits(NAME_bounded(bounds[i], 0.3));
            print_bits(NAME_bounded(bounds[i], -1e300));
            print_bits(NAME_bounded(bounds[i], INFINITY));
            printf("\\n");
        }
    }
}
"""


def program(machine: ir.Machine) -> str:
    """The program for one machine."""
    found = machine.reactions
    fields = ", ".join(str(len(command.fields)) for command in found.commands)
    asked = [*(f"t_ns + INT64_C({later})" for later in LATER), *EVER]
    calls = "\n".join(f"        print_bounds(r, {instant});" for instant in asked)
    text = PROGRAM.replace("PRINT_BOUNDS", calls.strip() if found.commands else "(void)print_bits;")
    most = max((len(command.fields) for command in found.commands), default=0)
    bounds = _BOUNDS.replace("MOST_FIELDS", str(most)).replace("FIELDS", fields)
    text = text.replace("BOUNDS", bounds if found.commands else "")
    pose = _POSE.strip() if found.memories else ""
    text = text.replace("PRINT_TASK_COMMAND", _TASK_COMMAND.replace("POSE", pose))
    text = text.replace("READING_COUNT", str(len(machine.readings)))
    text = text.replace("READING", _READING if found.memories else "", 1)
    text = text.replace("WATCHED_COUNT", str(len(machine.watches)))
    text = text.replace("WATCH", _WATCH if machine.watches else "", 1)
    return text.replace("NAME", machine.name)


def event_bytes(case: ReactingCase) -> bytes:
    """The events as the program reads them. Rules that are not engaged are exempted or inactive."""
    parts = [struct.pack("<q", len(case.events))]
    for number, event in enumerate(case.events):
        task, success = (-1, False) if event.report is None else event.report
        opens = number == case.opens_before
        parts.append(struct.pack("<qqqq", opens, event.at_ns, task, success))
        is_exempted = [not is_engaged and number % 2 == 0 for is_engaged in event.engaged]
        pairs = zip(event.engaged, is_exempted, strict=True)
        parts.append(bytes(one or other for one, other in pairs))
        parts.append(bytes(is_exempted))
        parts.append(bytes(event.watches))
        parts.append(struct.pack(f"<{len(event.readings)}d", *event.readings))
    return b"".join(parts)


def wanted(case: ReactingCase) -> list[str]:
    """The expected output of the program, from the interpreter."""
    reactor = Reactor(case.machine.reactions)
    lines = []
    for number, event in enumerate(case.events):
        if number == case.opens_before:
            reactor.open()
        lines += [_task_command(command) for command in look(reactor, event)]
        wake_ns = reactor.next_wake()
        lines.append(f"wake {2**63 - 1 if wake_ns is None else wake_ns}")
        lines.append(" ".join(["states", *(str(int(state)) for state in reactor.states)]))
        for at_ns in (*(event.at_ns + later for later in LATER), *EVER.values()):
            lines += _bounds(case.machine.reactions, reactor, at_ns)
    return lines


def _task_command(command: ir.TaskCommand) -> str:
    by = -1 if command.by is None else command.by
    words = f"command {_KINDS.index(command.kind)} {command.task} {by}"
    return _bits(words, command.pose)


_KINDS = tuple(TaskCommandKind)


def _bounds(found: ir.Reactions, reactor: Reactor, at_ns: int) -> Iterator[str]:
    for command in range(len(found.commands)):
        for field in reactor.bounds(at_ns, command):
            bounded = (field.of(0.3), field.of(-1e300), field.of(float("inf")))
            yield _bits("bounds", (field.factor, field.low, field.high, *bounded))


def _bits(word: str, numbers: Sequence[float]) -> str:
    bits = (struct.unpack("<Q", struct.pack("<d", number))[0] for number in numbers)
    return " ".join([word, *(f"{each:x}" for each in bits)])
