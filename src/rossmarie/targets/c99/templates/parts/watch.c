
enum {{ name }}_truth {{ name }}_watch(const monitor *m, int watch)
{
    if (!m->started || watch < 0 || watch >= WATCHES)
        return {{ name }}_UNKNOWN;
    return (enum {{ name }}_truth)m->truth[watched_truths[watch]];
}
