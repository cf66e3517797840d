/* Part of ROSSMARie, the same for all rules. */

/* Propositions that can change without a message: durations and ages. */

static inline int64_t earlier(int64_t a, int64_t b) { return a < b ? a : b; }

/* Records a new timer. `wake_ns` is the instant of the earliest timer or an earlier instant. */
static inline void wake_by(monitor *m, int64_t due_ns)
{
    if (due_ns < m->wake_ns)
        m->wake_ns = due_ns;
}

#if HELD

/* Returns the truth value of `operand for duration` (S33): TRUE once the operand has been true for
 * the duration; until then, the truth value that the operand had before. The code has few branches,
 * because a processor predicts changes of the operand badly.
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

/* Updates the proposition about the age of the last message of an input (S31). */
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
