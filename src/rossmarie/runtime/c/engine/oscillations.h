/* Part of ROSSMARie, the same for all rules. */

/* Oscillations: turning points of a number, counted within a window. */

#if OSCILLATIONS

static void forget_turns(monitor *m, unsigned k)
{
    m->extreme[k] = NAN;
    m->heading[k] = 0;
    forget_recent(m, k);
}

/* True if enough turning points lie within the window. */
static unsigned char swings(monitor *m, unsigned k, int64_t t_ns)
{
    if (!isfinite(m->value[turn_value[k]])) {
        forget_turns(m, k);
        return unknown_kind(m, GUARDS + k);
    }
    return is_enough(m, k, t_ns) ? TRUE : FALSE;
}

static void look_at_swings(monitor *m, unsigned k, int64_t t_ns)
{
    const unsigned char value = swings(m, k, t_ns);
    const bool begins_gap = value >= UNKNOWN && m->gap_end_ns[k] != NEVER;
    m->swinging[k] = value;
    if (value == TRUE)
        wake_by(m, recent_end(m, k));
    if (value != m->truth_value[recent_proposition[k]] || begins_gap)
        mark(m, recent_proposition[k]);
}

static unsigned char swings_or_gap(monitor *m, unsigned k, int64_t t_ns)
{
    return enough_or_gap(m, k, m->swinging[k], m->swinging[k] == TRUE, t_ns);
}

static void turn(monitor *m, unsigned k, signed char heading, double x, int64_t t_ns)
{
    if (m->heading[k] != 0)
        add_recent(m, k, t_ns);
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
