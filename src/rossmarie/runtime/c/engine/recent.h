/* Part of ROSSMARie, the same for all rules. */

/* Recent instants: turning points of a number, or edges of a condition, counted within a window.
 * First come those of the oscillations, then those of the counts of edges.
 */

#if RECENT

static void forget_recent(monitor *m, unsigned k) { m->recent_count[k] = 0; }

static void add_recent(monitor *m, unsigned k, int64_t t_ns)
{
    const unsigned count = recent_first[k + 1] - recent_first[k];
    m->recent_ns[recent_first[k] + m->recent_next[k]] = t_ns;
    m->recent_next[k] = (index_t)((m->recent_next[k] + 1u) % count);
    if (m->recent_count[k] != count)
        m->recent_count[k]++;
}

/* The end of the window of the n-th latest, which lies at the place that is overwritten next. */
static int64_t recent_end(const monitor *m, unsigned k)
{
    return m->recent_ns[recent_first[k] + m->recent_next[k]] + recent_windows[k];
}

/* True if enough of them lie within the window. */
static bool is_enough(const monitor *m, unsigned k, int64_t t_ns)
{
    return m->recent_count[k] == recent_first[k + 1] - recent_first[k] && t_ns < recent_end(m, k);
}

/* The result, given the source, which matters only if it is unknown or stale: too few instants give
 * no answer until the source has been known throughout the window.
 */
static unsigned char enough_or_gap(monitor *m, unsigned k, unsigned char source, bool is_enough,
                                   int64_t t_ns)
{
    if (source >= UNKNOWN) {
        m->gap[k] = source;
        m->gap_end_ns[k] = NEVER;
    } else if (m->gap_end_ns[k] == NEVER) {
        m->gap_end_ns[k] = t_ns;
    }
    if (is_enough)
        return TRUE;
    if (m->gap_end_ns[k] == NEVER)
        return m->gap[k];
    if (t_ns - m->gap_end_ns[k] >= recent_windows[k])
        return FALSE;
    if (m->gap[k] != FALSE)
        wake_by(m, m->gap_end_ns[k] + recent_windows[k]);
    return m->gap[k];
}

/* The instant at which the result changes by itself. */
static int64_t recent_due(const monitor *m, unsigned k)
{
    const unsigned char value = m->truth_value[recent_proposition[k]];
    if (value == TRUE)
        return recent_end(m, k);
    if (value != FALSE && m->gap_end_ns[k] != NEVER)
        return m->gap_end_ns[k] + recent_windows[k];
    return NEVER;
}

#endif

#if EDGES

/* `count(edges of operand within a time)`: an edge is where the operand is true and was false. */
static unsigned char recurs(monitor *m, unsigned k, unsigned node, int64_t t_ns)
{
    const unsigned char operand = m->truth_value[node], before = m->edge_before[k];
    const unsigned place = OSCILLATIONS + k;
    m->edge_before[k] = operand;
    if (operand == TRUE && before == FALSE)
        add_recent(m, place, t_ns);
    const bool is_true = is_enough(m, place, t_ns);
    if (is_true)
        wake_by(m, recent_end(m, place));
    return enough_or_gap(m, place, operand, is_true, t_ns);
}

#endif
