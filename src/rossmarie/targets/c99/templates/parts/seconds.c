/* The time between the last two samples. */
static double seconds_between(const monitor *m, unsigned k)
{
    return (double)(m->latest_ns[k] - m->before_ns[k]) / 1e9;
}
