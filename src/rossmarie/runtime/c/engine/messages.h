/* Part of ROSSMARie, the same for all rules. */

/* Messages: time passes up to a message, its numbers are stored by the rules' own part of a
 * monitor, and what they change is evaluated. A calm message costs only a check of its numbers: no
 * timer is due, and all numbers stay inside their guards.
 */

/* Before a message: that it is calm, or how many events there were. */
enum { REFUSED = -1, CALM = -2 };

/* True if a message at this instant can change nothing but by its numbers. */
INLINE bool is_calm(const monitor *m, int64_t t_ns)
{
    return t_ns >= m->now_ns && t_ns < m->wake_ns;
}

#if CHANNELS

/* The same of messages on several channels, which have to be known to be fresh. */
static inline bool are_calm(const monitor *m, const bool arrived[], int64_t t_ns)
{
    for (unsigned channel = 0; channel != CHANNELS; channel++)
        if (arrived[channel] && !m->quiet[channel])
            return false;
    return is_calm(m, t_ns);
}

/* A message arrived on a channel. */
static void arrive(monitor *m, unsigned channel, int64_t t_ns)
{
    m->quiet[channel] = true;
    for (unsigned i = 0; i != INPUTS; i++) {
        if (input_channel[i] != channel)
            continue;
        m->state[i] = FRESH;
        m->stamp_ns[i] = t_ns;
        if (input_timeouts[i] != 0 && t_ns + input_timeouts[i] < m->wake_ns)
            m->wake_ns = t_ns + input_timeouts[i];
    }
}

#else

static inline bool are_calm(const monitor *m, const bool arrived[], int64_t t_ns)
{
    (void)arrived;
    return is_calm(m, t_ns);
}

#endif

/* Let time pass up to messages, which may be late: a timer may be due, or time begins, or goes
 * back.
 */
RARE int begin(monitor *m, const bool arrived[], int64_t t_ns)
{
    const int events = catch_up(m, t_ns);
    if (events < 0)
        return REFUSED;
#if CHANNELS
    for (unsigned channel = 0; channel != CHANNELS; channel++)
        if (arrived[channel])
            arrive(m, channel, t_ns);
#endif
    (void)arrived;
    tick(m, t_ns);
    return events;
}

#if GUARDS && CHANNELS

/* Check the numbers that a message on a channel may have changed. */
static void look(monitor *m, unsigned channel, int64_t t_ns)
{
    for (unsigned i = channel_guards[channel]; i != channel_guards[channel + 1]; i++) {
        const unsigned g = watching[i];
        if (!is_inside(m, g, m->value[guard_value[g]]))
            cross(m, g, m->value[guard_value[g]], t_ns);
    }
}

#endif

/* Evaluate the nodes that messages have marked. Returns the number of events, including those
 * before the messages.
 */
RARE int settle(monitor *m, const bool arrived[], int64_t t_ns, int before)
{
    int events;
#if CHANNELS
    for (unsigned channel = 0; channel != CHANNELS; channel++)
        if (arrived[channel] && !m->quiet[channel])
            arrive(m, channel, t_ns);
#endif
#if GUARDS && CHANNELS
    for (unsigned channel = 0; channel != CHANNELS; channel++)
        if (arrived[channel])
            look(m, channel, t_ns);
#endif
    (void)arrived;
    events = evaluate(m, t_ns);
    if (before == CALM)
        return events;
    set_wake(m);
    return before + events;
}
