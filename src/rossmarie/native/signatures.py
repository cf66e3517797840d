"""The functions of `host.c` and `batch.c`, declared for cffi.

The input is a machine. The order of fields is that of the generated code: the slots of a channel in
index order, then its arrays, then the columns of its lists.
"""

from __future__ import annotations

from dataclasses import dataclass

from rossmarie import ir

_FIXED = """
typedef struct host host;
typedef struct host_table {
    int64_t *times;
    void **columns;
    size_t *widths;
    unsigned char *arriving;
} host_table;
typedef struct host_batch {
    size_t update_count;
    size_t channel_count;
    size_t slot_count;
    size_t array_count;
    int64_t *times;
    unsigned char *arriving;
    double *slots;
    double **elements;
    int64_t **ends;
    unsigned char **known;
    double **parts;
    size_t *counts;
} host_batch;
typedef struct host_samples {
    size_t room;
    size_t count;
    size_t signal_count;
    int *signals;
    int64_t *times;
    double *values;
} host_samples;
host *host_new(void);
void host_free(host *);
char *host_fault(host *);
size_t host_event_size(void);
size_t host_event_count(host *);
void *host_events(host *);
int host_failed(host *);
void host_forget_events(host *);
unsigned char *host_active(host *);
int host_advance(host *, int64_t);
int host_reset(host *, int64_t, int);
int64_t host_next_wake(host *);
int host_step(host *, int64_t, unsigned char *, double *, double **, size_t *);
size_t host_run(host *, size_t, size_t, host_table *, unsigned char *);
size_t host_take(host *, size_t, host_batch *, host_samples *);
"""


@dataclass(frozen=True)
class Fields:
    """The fields that the messages of one channel carry, as indexes of the machine. `counted` are
    the `arrays` that are followed by their number of elements: arrays outside of lists, and the
    last column of each list. `lists` are the lists of the channel.
    """

    slots: tuple[int, ...]
    arrays: tuple[int, ...]
    counted: frozenset[int]
    lists: tuple[int, ...]


def fields_of(machine: ir.Machine) -> tuple[Fields, ...]:
    """The fields of every channel."""
    return tuple(_fields(machine, channel) for channel in range(len(machine.channels)))


def _fields(machine: ir.Machine, channel: int) -> Fields:
    arrays = ir.arrays_of(machine, channel)
    lists = tuple(i for i, each in enumerate(machine.lists) if _is_on(machine, each, channel))
    last = {ir.columns_of(machine, each)[-1] for each in lists}
    alone = {index for index in arrays if machine.arrays[index].list is None}
    return Fields(_slots(machine, channel), arrays, frozenset(alone | last), lists)


def _is_on(machine: ir.Machine, each: ir.List, channel: int) -> bool:
    return machine.inputs[each.input].channel == channel


def _slots(machine: ir.Machine, channel: int) -> tuple[int, ...]:
    inputs = machine.inputs
    return tuple(i for i, slot in enumerate(machine.slots) if inputs[slot.input].channel == channel)


def declarations(fields: tuple[Fields, ...]) -> str:
    """All functions of the library."""
    lines = [_FIXED]
    for channel, carried in enumerate(fields):
        parameters = ["host *", "int64_t"]
        parameters += ["double"] * len(carried.slots)
        for array in carried.arrays:
            parameters += ["double *", "size_t"] if array in carried.counted else ["double *"]
        lines.append(f"int host_update_{channel}({', '.join(parameters)});")
    return "\n".join(lines)
