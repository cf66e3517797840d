"""The program of `c_replay` with one step more: a batch through `batch.c`, with samples."""

from __future__ import annotations

import struct

import numpy as np

from rossmarie import ir
from rossmarie.recordings.batches import Assembly, batched
from rossmarie.recordings.model import Update
from support.batches import Observed, bits_of, can_be_shown
from support.c_replay import observations, program

_RUN = """\
static void run_batch(void)
{
    enum { BATCH_SLOTS = SLOT_COUNT, BATCH_ARRAYS = ARRAY_COUNT, BATCH_CHANNELS = CHANNEL_COUNT };
    enum { BATCH_SHOWN = SHOWN_COUNT, BATCH_ROOM = 3 };
    const int shown[BATCH_SHOWN + 1] = {SHOWN_SIGNALS};
    const double *parts[BATCH_ARRAYS + 1];
    size_t counts[BATCH_ARRAYS + 1], done = 0;
    int64_t at[BATCH_ROOM];
    double values[BATCH_ROOM * BATCH_SHOWN + 1];
    void *elements[BATCH_ARRAYS + 1] = {NULL}, *ends[BATCH_ARRAYS + 1] = {NULL};
    void *known[BATCH_ARRAYS + 1] = {NULL};
    host *h = host_new();
    const size_t updates = (size_t)read_integer();
    int64_t *times = (int64_t *)read_column(updates * sizeof *times);
    unsigned char *arriving = (unsigned char *)read_column(updates * BATCH_CHANNELS);
    double *slots = (double *)read_column(updates * BATCH_SLOTS * sizeof *slots);
    const double *const *all = (const double *const *)elements;
    const int64_t *const *of_each = (const int64_t *const *)ends;
    const unsigned char *const *are_known = (const unsigned char *const *)known;
    host_batch batch = {updates, BATCH_CHANNELS, BATCH_SLOTS, BATCH_ARRAYS, times, arriving,
                        slots, all, of_each, are_known, parts, counts};
    host_samples samples = {BATCH_ROOM, 0, BATCH_SHOWN, shown, at, values};
    for (int i = 0; i < BATCH_ARRAYS; i++) {
        elements[i] = read_column((size_t)read_integer());
        ends[i] = read_column((size_t)read_integer());
        known[i] = read_column((size_t)read_integer());
    }
    for (;;) {
        done = host_take(h, done, &batch, &samples);
        for (size_t i = 0; i < samples.count; i++) {
            printf("sample %" PRId64, at[i]);
            for (int j = 0; j < BATCH_SHOWN; j++) {
                uint64_t bits;
                memcpy(&bits, &values[i * BATCH_SHOWN + (size_t)j], sizeof bits);
                printf(" %" PRIx64, bits);
            }
            printf("\\n");
        }
        if (samples.count != samples.room)
            break;
        samples.count = 0;
    }
    if (done != updates)
        exit(5);
    for (size_t i = 0; i < h->count; i++)
        print(NULL, &h->events[i]);
    print_state(&h->machine);
    for (int i = 0; i < BATCH_ARRAYS; i++) {
        free(elements[i]);
        free(ends[i]);
        free(known[i]);
    }
    free(times);
    free(arriving);
    free(slots);
    host_free(h);
}

int main(void)"""


def program_with_batch(machine: ir.Machine) -> str:
    """The text of the program."""
    shown = can_be_shown(machine)
    run = _RUN.replace("SLOT_COUNT", str(len(machine.slots)))
    run = run.replace("ARRAY_COUNT", str(len(machine.arrays)))
    run = run.replace("CHANNEL_COUNT", str(len(machine.channels)))
    run = run.replace("SHOWN_COUNT", str(len(shown)))
    run = run.replace("SHOWN_SIGNALS", ", ".join(map(str, shown)) or "0")
    text = program(machine).replace('"host.c"', '"batch.c"').replace("int main(void)", run)
    return text.replace("run_table();\n    }", "run_table();\n        run_batch();\n    }")


def batch_bytes(machine: ir.Machine, updates: list[Update]) -> bytes:
    """The input of the program after the table."""
    nothing = Assembly(machine, np.empty(0, np.int64)).batch()
    batch = next(batched(machine, updates), nothing)
    parts = [struct.pack("=q", len(updates)), batch.times_ns.tobytes(), batch.arriving.tobytes()]
    parts.append(batch.slots.tobytes())
    for column in (column for array in batch.arrays for column in array):
        parts += [struct.pack("=q", column.nbytes), column.tobytes()]
    return b"".join(parts)


def of_batch(machine: ir.Machine, output: bytes, steps: int) -> Observed:
    """The output of the program for the batch, after its output for the given number of steps."""
    events = observations(machine, output, steps + 1)[-1].events
    lines = (line.split() for line in output.decode().splitlines())
    rows = [words[1:] for words in lines if words[0] == "sample"]
    return list(events), [(int(at_ns), list(map(_bits, words))) for at_ns, *words in rows]


def _bits(word: str) -> str:
    (value,) = struct.unpack("<d", struct.pack("<Q", int(word, 16)))
    return bits_of([value])[0]
