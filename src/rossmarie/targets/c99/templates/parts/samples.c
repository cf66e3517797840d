static void forget_samples(monitor *m, unsigned k)
{
    m->latest[k] = NAN;
    m->before[k] = NAN;
}

/* A sample of a number; at an equal instant it replaces the last one. */
static void sample(monitor *m, unsigned k, double x, int64_t t_ns)
{
    if (m->latest_ns[k] != t_ns) {
        m->before[k] = m->latest[k];
        m->before_ns[k] = m->latest_ns[k];
    }
    m->latest[k] = x;
    m->latest_ns[k] = t_ns;
}
