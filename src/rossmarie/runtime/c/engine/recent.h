/* Part of ROSSMARie, the same for all rules. */

/* Recent instants: the instants of the turning points of a value, or of the edges of a condition,
 * within a window. Each list k is a ring. The lists of oscillations come first, followed by the
 * lists of counts of edges.
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

/* Returns the instant at which the n-th latest recent instant leaves the window. This recent
 * instant is the oldest in a full ring, which the next recent instant overwrites.
 */
static int64_t recent_end(const monitor *m, unsigned k)
{
    return m->recent_ns[recent_first[k] + m->recent_next[k]] + recent_windows[k];
}

/* Returns true if enough recent instants lie within the window at t_ns. */
static bool is_enough(const monitor *m, unsigned k, int64_t t_ns)
{
    return m->recent_count[k] == recent_first[k + 1] - recent_first[k] && t_ns < recent_end(m, k);
}

/* Returns the truth value of an oscillation or a count of edges. `source` is the truth value from
 * which it follows; only UNKNOWN and STALE matter. With too few instants, the result is unknown
 * until the source has been known for the length of the window.
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

/* Returns the instant at which the result changes without a message, or NEVER. */
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

/* Returns the truth value of `count(edges of operand within a time)` (S48). An edge is an
 * evaluation at which the operand is true and was false in the evaluation before.
 */
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
