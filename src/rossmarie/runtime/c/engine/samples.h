/* Part of ROSSMARie, the same for all rules. */

/* Samples of values: the last two samples, or all samples within a window. */

#if SAMPLED

static void forget_samples(monitor *m, unsigned k)
{
    m->latest[k] = NAN;
    m->before[k] = NAN;
}

/* Stores a sample of a value. A sample at the instant of the last sample replaces the last sample.
 */
static void sample(monitor *m, unsigned k, double x, int64_t t_ns)
{
    if (m->latest_ns[k] != t_ns) {
        m->before[k] = m->latest[k];
        m->before_ns[k] = m->latest_ns[k];
    }
    m->latest[k] = x;
    m->latest_ns[k] = t_ns;
}

/* Returns the time between the last two samples, in s. */
static inline double seconds_between(const monitor *m, unsigned k)
{
    return (double)(m->latest_ns[k] - m->before_ns[k]) / 1e9;
}

#endif

#if WINDOWS

/* Returns the place of sample i in the ring of a window. Sample 0 is the oldest. */
static unsigned window_place(const monitor *m, unsigned k, unsigned i)
{
    return (m->window_first[k] + i) % MOST_SAMPLES;
}

static void drop_oldest(monitor *m, unsigned k)
{
    m->window_first[k] = (index_t)window_place(m, k, 1);
    m->window_count[k]--;
}

static void forget_window(monitor *m, unsigned k) { m->window_count[k] = 0; }

/* Stores a sample in a window. A sample at the instant of the last sample replaces the last sample.
 * Samples older than the window are removed. A full window loses its oldest sample.
 */
static void sample_window(monitor *m, unsigned k, double x, int64_t t_ns)
{
    if (m->window_count[k] != 0 &&
        m->window_ns[k][window_place(m, k, m->window_count[k] - 1u)] == t_ns)
        m->window_count[k]--;
    while (m->window_count[k] != 0 &&
           t_ns - m->window_ns[k][m->window_first[k]] >= window_lengths[k])
        drop_oldest(m, k);
    if (m->window_count[k] == MOST_SAMPLES)
        drop_oldest(m, k);
    const unsigned place = window_place(m, k, m->window_count[k]);
    m->window_value[k][place] = x;
    m->window_ns[k][place] = t_ns;
    m->window_count[k]++;
}

/* Returns the middle sample by size. Of two middle samples, returns the lower, or the upper if
 * is_upper is 1. Returns NaN if the window is empty or any sample is unknown.
 */
static inline double window_middle(const monitor *m, unsigned k, unsigned is_upper)
{
    const unsigned count = m->window_count[k];
    double by_size[MOST_SAMPLES];
    for (unsigned i = 0; i != count; i++) {
        const double x = m->window_value[k][window_place(m, k, i)];
        if (isnan(x))
            return NAN;
        unsigned place = i;
        for (; place != 0 && by_size[place - 1] > x; place--)
            by_size[place] = by_size[place - 1];
        by_size[place] = x;
    }
    return count == 0 ? NAN : by_size[(count - 1 + is_upper) / 2];
}

/* Returns the sum of the samples, added from the oldest to the newest. Returns NaN if the window is
 * empty or any sample is unknown.
 */
static inline double window_total(const monitor *m, unsigned k)
{
    double total = NAN;
    for (unsigned i = 0; i != m->window_count[k]; i++) {
        const double x = m->window_value[k][window_place(m, k, i)];
        total = i == 0 ? x : total + x;
    }
    return total;
}

#endif
