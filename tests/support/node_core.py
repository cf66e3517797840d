"""The way of a generated node through the C of its rules, without ROS: what `Guard` and `Filter` of
`runtime/ros` do with each message and each command, around the files that a package has.

It has none of the shortcuts of a guard in a process: the reactor looks each time, and each command
is bounded. Commands that rules publish are performed by tasks, which are not here.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rossmarie import ir
from rossmarie.native import build
from rossmarie.native.library import NativeLibrary
from rossmarie.native.signatures import declarations, fields_of
from rossmarie.targets.c99 import generate_loadable
from rossmarie.targets.c99.monitor import own_files

Floats = NDArray[np.float64]

_DRIVER = """
#include "host.c"
#include "NAME_reactor.h"

typedef struct node {
    host base;
    NAME_reactor reactor;
    unsigned char exempted[RULES + 1];
    bool is_open;
    bool is_reset_wanted;
} node;

static const unsigned char node_resets[] = {RESETS};

static void node_perform(void *user, int task, enum NAME_task_command command, int by_rule)
{
    (void)by_rule;
    if (command == NAME_START && node_resets[task])
        ((node *)user)->is_reset_wanted = true;
}

host *node_new(void)
{
    node *n = (node *)calloc(1, sizeof *n);
    n->base.fault = NAME_init(&n->base.machine, NULL, NULL);
    if (NAME_reactor_init(&n->reactor, node_perform, n))
        n->base.fault = "the reactor";
    return &n->base;
}

/* Guard::follow and Guard::open_when_ready */
static void node_follow(node *n, int64_t t_ns)
{
    do {
        n->is_reset_wanted = false;
        NAME_react(&n->reactor, &n->base.machine, n->exempted, t_ns);
    } while (n->is_reset_wanted && NAME_reset(&n->base.machine, t_ns, -1) >= 0);
    if (!n->is_open && NAME_has_all_inputs(&n->base.machine)) {
        n->is_open = true;
        NAME_reactor_open(&n->reactor);
    }
}

/* Guard::take */
int node_take(host *h, int64_t t_ns, const unsigned char *present, const double *slots,
              double **arrays, const size_t *counts)
{
    const int taken =
        host_step(h, t_ns, present, slots, (const double *const *)arrays, counts);
    if (taken >= 0)
        node_follow((node *)h, t_ns);
    return taken;
}

/* Guard::report */
void node_report(host *h, int64_t t_ns, int task, bool success)
{
    node *n = (node *)h;
    NAME_advance(&h->machine, t_ns);
    NAME_report(&n->reactor, &h->machine, t_ns, task, success);
    node_follow(n, t_ns);
}

/* Filter::receive and Filter::pass: all fields of a command. */
void node_pass(host *h, int64_t t_ns, int command, size_t count, double *numbers)
{
    node *n = (node *)h;
    NAME_bounds bounds[64];
    bool is_finite = true;
    const int64_t wake_ns = NAME_next_wake(&h->machine);
    const int64_t due_ns = NAME_reactor_next_wake(&n->reactor);
    if (t_ns >= (due_ns < wake_ns ? due_ns : wake_ns)) {
        NAME_advance(&h->machine, t_ns);
        node_follow(n, t_ns);
    }
    NAME_bounds_of(&n->reactor, t_ns, command, bounds);
    for (size_t i = 0; i != count; i++)
        is_finite = is_finite && isfinite(numbers[i]);
    for (size_t i = 0; i != count; i++)
        numbers[i] = NAME_bounded(bounds[i], is_finite ? numbers[i] : 0.0);
}
"""
_DECLARED = """
host *node_new(void);
int node_take(host *, int64_t, unsigned char *, double *, double **, size_t *);
void node_report(host *, int64_t, int, bool);
void node_pass(host *, int64_t, int, size_t, double *);
"""


class NodeCore:
    """The rules of a machine whose tasks publish no commands, and bound some."""

    def __init__(self, machine: ir.Machine) -> None:
        found = machine.reactions
        name = next(iter(own_files(machine))).removesuffix("_monitor.h")
        resets = [isinstance(task.effect, ir.reactions.Reset) for task in found.tasks]
        driver = _DRIVER.replace("RESETS", ", ".join(str(int(each)) for each in resets))
        driver = driver.replace("RULES", str(len(machine.rules))).replace("NAME", name)
        files = {**generate_loadable(machine), **own_files(machine), "node.c": driver}
        content = build(files, "node.c", "-O1", beside=[f"{name}_reactor.c"])
        self._machine = machine
        self._library = NativeLibrary(content, declarations(fields_of(machine)) + _DECLARED)
        self.restart()

    def restart(self) -> None:
        """A node that has just been started."""
        library = self._library
        self._host = library.owned(library.function("node_new")(), library.function("host_free"))
        assert library.text_at(library.function("host_fault")(self._host)) is None

    @property
    def active(self) -> list[bool]:
        """The rules that are active."""
        found = self._library.function("host_active")(self._host)
        return [bool(found[rule // 8] >> rule % 8 & 1) for rule in range(len(self._machine.rules))]

    def take(self, at_ns: int, wiring: ir.Wiring, observation: Floats) -> None:
        """Messages come on all topics that a wiring has, with the numbers of an observation."""
        new, channels = self._library.new, range(len(self._machine.channels))
        slots = [_first(part, observation) for part in wiring.slots]
        arrays = [new("double[]", _numbers(part, observation) or [0.0]) for part in wiring.arrays]
        present = new("unsigned char[]", [int(each in wiring.arriving) for each in channels] or 1)
        counts = new("size_t[]", [part.count for part in wiring.arrays] or 1)
        pointers = new("double *[]", arrays or 1)
        take = self._library.function("node_take")
        assert take(self._host, at_ns, present, new("double[]", slots or 1), pointers, counts) >= 0

    def report(self, at_ns: int, task: int, *, success: bool) -> None:
        """A task has ended."""
        self._library.function("node_report")(self._host, at_ns, task, success)

    def passed(self, at_ns: int, wiring: ir.Wiring, action: Floats) -> Floats:
        """An action whose numbers are fields of commands, as it passes the filters."""
        executed: Floats = action.copy()
        for index, command in enumerate(self._machine.reactions.commands):
            parts = [each for each in wiring.commands if each.command == index]
            numbers = [0.0] * len(command.fields)
            for each in parts:
                numbers[each.field] = _first(each.part, action)
            room = self._library.new("double[]", numbers)
            self._library.function("node_pass")(self._host, at_ns, index, len(numbers), room)
            for each in parts:
                if room[each.field] != numbers[each.field]:
                    part = each.part
                    is_same = part.scale == 1.0 and part.offset == 0.0
                    bounded = room[each.field]
                    back = bounded if is_same else (bounded - part.offset) / part.scale
                    executed[part.first] = back
        return executed


def _numbers(part: ir.FieldPart, numbers: Sequence[float] | Floats) -> list[float]:
    """The numbers of a part in the units of a message."""
    given = [float(numbers[place]) for place in part.places]
    if part.is_flag:
        return [float(each != 0.0) if math.isfinite(each) else math.nan for each in given]
    if part.scale == 1.0 and part.offset == 0.0:
        return given
    return [each * part.scale + part.offset for each in given]


def _first(part: ir.FieldPart, numbers: Sequence[float] | Floats) -> float:
    return next(iter(_numbers(part, numbers)), math.nan)
