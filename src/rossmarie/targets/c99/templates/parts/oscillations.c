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
    m->swinging[k] = value;
    if (value == TRUE)
        wake_by(m, oldest_turn(m, k) + turn_windows[k]);
    if (value != m->truth[turn_leaf[k]])
        mark(m, turn_leaf[k]);
}
