/* The slope over the last two samples, per second. */
static double rate_of(const monitor *m, unsigned k)
{
    const double seconds = (double)(m->latest_ns[k] - m->before_ns[k]) / 1e9;
    return known((m->latest[k] - m->before[k]) / seconds);
}
