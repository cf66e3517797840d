/* Whether a message at this instant can change nothing but by its numbers. */
INLINE bool is_calm(const monitor *m, int64_t t_ns)
{
    return t_ns >= m->now_ns && t_ns < m->wake_ns;
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
