/* Whole batches for a monitor: updates that follow each other, with samples of signals.
 *
 * Compiled together with host.c.
 */
#ifndef ROSSMARIE_BATCH
#define ROSSMARIE_BATCH

#include "host.c"

/* `arriving` has a byte for each channel of each update, `slots` a number for each slot of each
 * update. An array of all updates lies in `elements`, and `ends` says where those of each update
 * end; where `known` is 0 nothing is known of the list of which it is a column. `parts` and
 * `counts` are room for the arrays of one update.
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

/* Memory for samples of some signals: an instant and a row of values for each. */
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

/* Process the updates from `first` on, with a sample after each, and before it if a timer was due.
 * Returns how far it came: not to the end if the memory for samples is full, or if the instant of
 * an update is out of range.
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
