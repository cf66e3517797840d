/* Part of ROSSMARie, the same for all rules. */

/* Oscillations (S32): the engine counts the turning points of a value within a window. */

#if OSCILLATIONS

static void forget_turns(monitor *m, unsigned k)
{
    m->extreme[k] = NAN;
    m->heading[k] = 0;
    forget_recent(m, k);
}

/* Returns TRUE if enough turning points lie within the window, else FALSE. Returns UNKNOWN or
 * STALE, and forgets the turning points, if the value is not finite.
 */
static unsigned char swings(monitor *m, unsigned k, int64_t t_ns)
{
    if (!isfinite(m->value[turn_value[k]])) {
        forget_turns(m, k);
        return unknown_kind(m, GUARDS + k);
    }
    return is_enough(m, k, t_ns) ? TRUE : FALSE;
}

/* Marks an oscillation if its proposition can change at an instant. */
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

/* Returns the truth value of an oscillation, which is unknown after a gap (S32). */
static unsigned char swings_or_gap(monitor *m, unsigned k, int64_t t_ns)
{
    return enough_or_gap(m, k, m->swinging[k], m->swinging[k] == TRUE, t_ns);
}

/* Sets a new direction. A change of the direction is a turning point; the first direction is not.
 */
static void turn(monitor *m, unsigned k, signed char heading, double x, int64_t t_ns)
{
    if (m->heading[k] != 0)
        add_recent(m, k, t_ns);
    m->heading[k] = heading;
    m->extreme[k] = x;
}

/* Processes a new sample of a value. */
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
