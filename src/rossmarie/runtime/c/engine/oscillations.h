/* Part of ROSSMARie, the same for all rules. */

/* Oscillations: turning points of a number, counted within a window. */

#if OSCILLATIONS

static void forget_turns(monitor *m, unsigned k)
{
    m->extreme[k] = NAN;
    m->heading[k] = 0;
    m->turns[k] = 0;
}

/* The instant of the n-th latest turning point lies at the place that is overwritten next. */
static int64_t oldest_turn(const monitor *m, unsigned k)
{
    return m->turn_ns[turn_first[k] + m->turn_next[k]];
}

/* Whether enough turning points lie within the window. */
static unsigned char swings(monitor *m, unsigned k, int64_t t_ns)
{
    if (!isfinite(m->value[turn_value[k]])) {
        forget_turns(m, k);
        return unknown_kind(m, GUARDS + k);
    }
    if (m->turns[k] != turn_first[k + 1] - turn_first[k])
        return FALSE;
    return t_ns - oldest_turn(m, k) < turn_windows[k] ? TRUE : FALSE;
}

static void look_at_swings(monitor *m, unsigned k, int64_t t_ns)
{
    const unsigned char value = swings(m, k, t_ns);
    const bool begins_gap = value >= UNKNOWN && m->gap_end_ns[k] != NEVER;
    m->swinging[k] = value;
    if (value == TRUE)
        wake_by(m, oldest_turn(m, k) + turn_windows[k]);
    if (value != m->truth[turn_leaf[k]] || begins_gap)
        mark(m, turn_leaf[k]);
}

/* What is known of an oscillation: too few turning points tell nothing until the number has been
 * known throughout the window.
 */
static unsigned char swings_or_gap(monitor *m, unsigned k, int64_t t_ns)
{
    const unsigned char value = m->swinging[k];
    if (value >= UNKNOWN) {
        m->gap[k] = value;
        m->gap_end_ns[k] = NEVER;
        return value;
    }
    if (m->gap_end_ns[k] == NEVER)
        m->gap_end_ns[k] = t_ns;
    if (value == TRUE || t_ns - m->gap_end_ns[k] >= turn_windows[k])
        return value;
    if (m->gap[k] != FALSE)
        wake_by(m, m->gap_end_ns[k] + turn_windows[k]);
    return m->gap[k];
}

static void turn(monitor *m, unsigned k, signed char heading, double x, int64_t t_ns)
{
    const unsigned count = turn_first[k + 1] - turn_first[k];
    if (m->heading[k] != 0) {
        m->turn_ns[turn_first[k] + m->turn_next[k]] = t_ns;
        m->turn_next[k] = (index_t)((m->turn_next[k] + 1u) % count);
        if (m->turns[k] != count)
            m->turns[k]++;
    }
    m->heading[k] = heading;
    m->extreme[k] = x;
}

/* A sample of a number that may swing. */
static void follow(monitor *m, unsigned k, int64_t t_ns)
{
    const double x = m->value[turn_value[k]], swing = turn_swings[k], extreme = m->extreme[k];
    const int heading = m->heading[k];
    if (isfinite(x)) {
        if (isnan(extreme) || (heading > 0 && x > extreme) || (heading < 0 && x < extreme))
            m->extreme[k] = x;
        else if (heading <= 0 && x > extreme + swing)
            turn(m, k, 1, x, t_ns);
        else if (heading >= 0 && x < extreme - swing)
            turn(m, k, -1, x, t_ns);
    }
    look_at_swings(m, k, t_ns);
}

#endif
