/* Part of ROSSMARie, the same for all rules. */

/* Propositions that time alone can change: durations and ages. */

static inline int64_t earlier(int64_t a, int64_t b) { return a < b ? a : b; }

/* Record a new timer. `wake_ns` is never later than the earliest timer; it may be earlier. */
static inline void wake_by(monitor *m, int64_t due_ns)
{
    if (due_ns < m->wake_ns)
        m->wake_ns = due_ns;
}

#if HELD

/* `operand for duration`: true once the operand has been true that long; until then the earlier
 * value of the operand. (Next to no branches: whether an operand rose or fell is badly
 * predictable.)
 */
static unsigned char held(monitor *m, unsigned k, unsigned node, int64_t t_ns)
{
    const unsigned char operand = m->truth_value[node];
    const int64_t due_ns = m->since_ns[node] + held_durations[k];
    m->held_due_ns[k] = operand == TRUE ? due_ns : NEVER;
    m->held_before[k] = operand == TRUE ? m->held_before[k] : operand;
    wake_by(m, m->held_due_ns[k]);
    return operand == TRUE && t_ns >= due_ns ? (unsigned char)TRUE : m->held_before[k];
}

#endif

#if AGES

/* The age of the last message of an input. */
static void look_at_age(monitor *m, unsigned k, int64_t t_ns)
{
    const unsigned input = age_input[k];
    const bool is_known = m->state[input] != NEVER_RECEIVED;
    const int64_t due_ns = m->stamp_ns[input] + age_limits[k];
    unsigned char value = age_unknown[k];
    if (is_known)
        value = t_ns >= due_ns ? TRUE : FALSE;
    if (value == TRUE)
        m->quiet[input_channel[input]] = false;
    if (value == FALSE)
        wake_by(m, due_ns);
    set_truth_value(m, age_leaf[k], value, t_ns);
}

#endif
