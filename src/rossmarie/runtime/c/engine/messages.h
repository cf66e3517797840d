/* Part of ROSSMARie, the same for all rules. */

/* Processing of messages, in this order:
 * - The engine runs the timers that are due before the message.
 * - The generated file stores the numbers of the message.
 * - The engine evaluates the nodes that depend on changed propositions.
 *
 * A calm message needs only a check of its numbers: no timer is due, and all values stay inside
 * their guards.
 */

/* Results of the preparation for a message: the number of events, or one of these constants.
 * REFUSED: the instant is out of range. CALM: no preparation was necessary.
 */
enum { REFUSED = -1, CALM = -2 };

/* Returns true if a message at this instant can change nothing except through its numbers. */
INLINE bool is_calm(const monitor *m, int64_t t_ns)
{
    return t_ns >= m->now_ns && t_ns < m->wake_ns;
}

#if CHANNELS

/* Returns true if messages on several channels can change nothing except through their numbers. The
 * inputs of each of these channels must be fresh.
 */
static inline bool are_calm(const monitor *m, const bool arrived[], int64_t t_ns)
{
    for (unsigned channel = 0; channel != CHANNELS; channel++)
        if (arrived[channel] && !m->quiet[channel])
            return false;
    return is_calm(m, t_ns);
}

/* Records the arrival of a message on a channel: its inputs become fresh. */
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

/* Prepares for messages that are not calm: lets time pass up to the instant of the messages. A
 * timer may be due, the monitor may start, or time may go backwards. Returns the number of events,
 * or REFUSED.
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

/* Checks the guards of the values that a message on a channel can change. */
static void look(monitor *m, unsigned channel, int64_t t_ns)
{
    for (unsigned i = channel_guards[channel]; i != channel_guards[channel + 1]; i++) {
        const unsigned g = watching[i];
        if (!is_inside(m, g, m->value[guard_value[g]]))
            cross(m, g, m->value[guard_value[g]], t_ns);
    }
}

#endif

/* Evaluates the nodes that messages have marked. `before` is the result of the preparation. Returns
 * the number of events, including those of the preparation.
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
#if GUARDS && BESIDE
    /* expire_due has not checked the guards of the values that it forgot. */
    if (before != CALM)
        review(m, t_ns);
#endif
    (void)arrived;
    events = evaluate(m, t_ns);
    if (before == CALM)
        return events;
    set_wake(m);
    return before + events;
}
