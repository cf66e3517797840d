/* Part of ROSSMARie, the same for all rules. */

/* Activation and clearing of rules, and the events that report these changes (S35 to S41). */

static bool is_active(const monitor *m, unsigned rule)
{
    return (m->active[rule / 8] >> (rule % 8) & 1) != 0;
}

/* Reports a change of a rule, with the truth values, signals and input states that the rule depends
 * on.
 */
static void report(const monitor *m, unsigned rule, int32_t change, int64_t t_ns)
{
    NAMED(event) event;
    unsigned n = 0;
    memset(&event, 0, sizeof event);
    event.at_ns = t_ns;
    event.from_ns = t_ns;
    event.rule = (int32_t)rule;
    event.change = change;
    for (unsigned i = rule_terms[rule]; i != rule_terms[rule + 1]; i++, n++) {
        event.truth_values[n] = m->truth_value[terms[i]];
        event.since_ns[n] = m->since_ns[terms[i]];
    }
    n = 0;
    for (unsigned i = rule_values[rule]; i != rule_values[rule + 1]; i++, n++)
        event.values[n] = m->value[shown_values[i]];
    n = 0;
    for (unsigned i = rule_inputs[rule]; i != rule_inputs[rule + 1]; i++, n++)
        event.inputs[n] = m->state[shown_inputs[i]];
    m->on_event(m->user, &event);
}

static int change_rule(monitor *m, unsigned rule, int32_t change, int64_t t_ns)
{
    m->active[rule / 8] = (unsigned char)(m->active[rule / 8] ^ (1u << (rule % 8)));
    if (m->on_event)
        report(m, rule, change, t_ns);
    return 1;
}

/* Activates or clears a rule after an evaluation. Returns the number of changes, 0 or 1. */
static int judge(monitor *m, unsigned rule, int64_t t_ns)
{
    const unsigned char condition = m->truth_value[rule_condition[rule]];
    const bool was_active = is_active(m, rule);
    if (!was_active && condition == TRUE)
        return change_rule(m, rule, NAMED(ACTIVATED), t_ns);
    if (!was_active && condition == STALE)
        return change_rule(m, rule, NAMED(ACTIVATED_STALE), t_ns);
    if (was_active && condition == FALSE && rule_release[rule] != LATCHED &&
        m->truth_value[rule_release[rule]] == TRUE)
        return change_rule(m, rule, NAMED(CLEARED), t_ns);
    return 0;
}
