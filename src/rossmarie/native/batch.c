/* Batches for a monitor: a sequence of updates in one call, with samples of signals.
 *
 * This file is compiled together with host.c.
 */
#ifndef ROSSMARIE_BATCH
#define ROSSMARIE_BATCH

#include "host.c"

/* A batch of updates.
 * - times: the instant of each update, in ns.
 * - arriving: a byte for each channel of each update, not 0 if a message arrives.
 * - slots: a number for each slot of each update.
 * - elements: for each array, the elements of all updates.
 * - ends: for each array, the index in `elements` at which the elements of each update end.
 * - known: for each array, a byte for each update; 0 if the list to which the array belongs is
 *   unknown.
 * - parts, counts: room for the arrays of one update.
 */
typedef struct host_batch {
    size_t update_count;
    size_t channel_count;
    size_t slot_count;
    size_t array_count;
    const int64_t *times;
    const unsigned char *arriving;
    const double *slots;
    const double *const *elements;
    const int64_t *const *ends;
    const unsigned char *const *known;
    const double **parts;
    size_t *counts;
} host_batch;

/* Memory for samples of signals. A sample is an instant in ns and a row of values. */
typedef struct host_samples {
    size_t room;
    size_t count;
    size_t signal_count;
    const int *signals;
    int64_t *times;
    double *values;
} host_samples;

static void take_sample(const host *h, int64_t t_ns, host_samples *samples)
{
    double *row = samples->values + samples->count * samples->signal_count;
    for (size_t i = 0; i != samples->signal_count; i++)
        row[i] = host_signal(h, samples->signals[i]);
    samples->times[samples->count++] = t_ns;
}

static int take_update(host *h, const host_batch *batch, size_t i)
{
    for (size_t array = 0; array != batch->array_count; array++) {
        const int64_t *ends = batch->ends[array];
        const size_t start = i ? (size_t)ends[i - 1] : 0;
        batch->parts[array] = batch->elements[array] + start;
        batch->counts[array] = batch->known[array][i] ? (size_t)ends[i] - start : SIZE_MAX;
    }
    return host_step(h, batch->times[i], batch->arriving + i * batch->channel_count,
                     batch->slots + i * batch->slot_count, batch->parts, batch->counts);
}

/* Processes the updates from `first` on. Takes a sample after each update, and after each timer
 * that is due before it. Returns the number of processed updates, counted from the start of the
 * batch. The result is less than update_count if the memory for samples is full, or if the instant
 * of the next update is out of range.
 */
size_t host_take(host *h, size_t first, const host_batch *batch, host_samples *samples)
{
    for (size_t i = first; i != batch->update_count; i++) {
        for (;;) {
            const int64_t wake_ns = host_next_wake(h);
            if (samples->count == samples->room)
                return i;
            if (wake_ns >= batch->times[i])
                break;
            host_advance(h, wake_ns);
            take_sample(h, wake_ns, samples);
        }
        if (take_update(h, batch, i) < 0)
            return i;
        take_sample(h, batch->times[i], samples);
    }
    return batch->update_count;
}

#endif
