/* Part of ROSSMARie, the same for all rules. */

/* Evaluation: the engine evaluates the marked nodes in order, at the instants of timers and of
 * messages.
 */

/* Returns the truth value of a marked proposition. The generated file defines this function. */
static unsigned char derive(monitor *m, unsigned node, int64_t t_ns);

/* Evaluates one marked node: computes the truth value of a proposition, or changes a rule. Returns
 * the number of events.
 */
static int visit(monitor *m, unsigned node, int64_t t_ns)
{
    if (node >= PROPOSITIONS)
        return judge(m, node - PROPOSITIONS, t_ns);
    set_truth_value(m, node, derive(m, node, t_ns), t_ns);
    return 0;
}

/* Evaluates all marked nodes in ascending order. This order is sufficient because each node follows
 * its operands. Returns the number of events.
 */
static int evaluate(monitor *m, int64_t t_ns)
{
    int events = 0;
    m->now_ns = t_ns;
#if NODES <= 64
    while (m->dirty != 0) {
        const unsigned node = lowest(m->dirty);
        m->dirty &= m->dirty - 1;
        events += visit(m, node, t_ns);
    }
#else
    for (unsigned word = 0; word != WORDS; word++) {
        while (m->dirty[word] != 0) {
            const unsigned node = 64 * word + lowest(m->dirty[word]);
            m->dirty[word] &= m->dirty[word] - 1;
            events += visit(m, node, t_ns);
        }
    }
    m->pending = false;
#endif
    return events;
}

/* Returns the earliest instant at which something can change without a message (S15), or NEVER. */
static int64_t earliest_timer(const monitor *m)
{
    int64_t wake_ns = NEVER;
#if TIMEOUTS
    for (unsigned i = 0; i != INPUTS; i++)
        if (m->state[i] == FRESH && input_timeouts[i] != 0)
            wake_ns = earlier(wake_ns, m->stamp_ns[i] + input_timeouts[i]);
#endif
#if AGES
    for (unsigned k = 0; k != AGES; k++)
        if (m->truth_value[age_leaf[k]] == FALSE)
            wake_ns = earlier(wake_ns, m->stamp_ns[age_input[k]] + age_limits[k]);
#endif
#if RECENT
    for (unsigned k = 0; k != RECENT; k++)
        wake_ns = earlier(wake_ns, recent_due(m, k));
#endif
#if HELD
    for (unsigned k = 0; k != HELD; k++)
        if (m->held_due_ns[k] > m->now_ns && m->truth_value[held_nodes[k]] != TRUE)
            wake_ns = earlier(wake_ns, m->held_due_ns[k]);
#endif
    (void)m;
    return wake_ns;
}

#if TIMEOUTS

/* Expires an input that has reached its timeout: forgets its values and the samples that depend on
 * the input.
 */
static void expire(monitor *m, unsigned input)
{
    m->state[input] = EXPIRED;
    m->quiet[input_channel[input]] = false;
    for (unsigned i = input_values[input]; i != input_values[input + 1]; i++)
        m->value[stale_values[i]] = NAN;
#if SAMPLED
    for (unsigned i = input_samples[input]; i != input_samples[input + 1]; i++)
        forget_samples(m, stale_samples[i]);
#endif
#if WINDOWS
    for (unsigned i = input_windows[input]; i != input_windows[input + 1]; i++)
        forget_window(m, stale_windows[i]);
#endif
}

/* Expires all inputs that have reached their timeouts at an instant. If these rules compare
 * elements with values beside them (S74), the caller checks the guards: a message at this instant
 * can make such a comparison known again, and then the truth value has not changed.
 */
static void expire_due(monitor *m, int64_t t_ns)
{
    bool has_expired = false;
    for (unsigned i = 0; i != INPUTS; i++) {
        if (m->state[i] == FRESH && input_timeouts[i] != 0 &&
            t_ns - m->stamp_ns[i] >= input_timeouts[i]) {
            expire(m, i);
            has_expired = true;
        }
    }
#if GUARDS && !BESIDE
    if (has_expired)
        review(m, t_ns);
#else
    (void)has_expired;
#endif
}

#endif

/* Updates the ages and the expired inputs at an instant, and marks the nodes that are due. */
static void tick(monitor *m, int64_t t_ns)
{
#if TIMEOUTS
    expire_due(m, t_ns);
#endif
#if AGES
    for (unsigned k = 0; k != AGES; k++)
        look_at_age(m, k, t_ns);
#endif
#if OSCILLATIONS
    for (unsigned k = 0; k != OSCILLATIONS; k++)
        look_at_swings(m, k, t_ns);
#endif
#if EDGES
    for (unsigned k = OSCILLATIONS; k != RECENT; k++)
        if (recent_due(m, k) <= t_ns)
            mark(m, recent_proposition[k]);
#endif
#if HELD
    for (unsigned k = 0; k != HELD; k++)
        if (m->held_due_ns[k] <= t_ns && m->truth_value[held_nodes[k]] != TRUE)
            mark(m, held_nodes[k]);
#endif
    (void)m;
    (void)t_ns;
}

/* Forgets all durations, samples and edges, because the clock has jumped or the monitor starts. */
static void forget_times(monitor *m, int64_t t_ns)
{
#if HELD
    for (unsigned k = 0; k != HELD; k++) {
        m->held_due_ns[k] = NEVER;
#if HELD_INITIALLY
        m->held_before[k] = m->started ? (unsigned char)UNKNOWN : held_initially[k];
#else
        m->held_before[k] = m->started ? UNKNOWN : FALSE;
#endif
    }
#endif
#if SAMPLED
    for (unsigned k = 0; k != SAMPLED; k++)
        forget_samples(m, k);
#endif
#if WINDOWS
    for (unsigned k = 0; k != WINDOWS; k++)
        forget_window(m, k);
#endif
#if SAMPLED || WINDOWS
    for (unsigned i = 0; i != SAMPLED_VALUES; i++)
        m->value[sampled_values[i]] = NAN;
#endif
#if OSCILLATIONS
    for (unsigned k = 0; k != OSCILLATIONS; k++)
        forget_turns(m, k);
#endif
#if EDGES
    for (unsigned k = 0; k != EDGES; k++)
        m->edge_before[k] = m->started ? UNKNOWN : FALSE;
#endif
#if RECENT
    for (unsigned k = 0; k != RECENT; k++) {
        forget_recent(m, k);
        m->gap[k] = m->started ? UNKNOWN : FALSE;
        m->gap_end_ns[k] = t_ns;
    }
#endif
    (void)m;
    (void)t_ns;
}

/* Starts the monitor, or restarts it after time went backwards. A restart keeps the ages of the
 * inputs, each at most LONGEST.
 */
static void restart(monitor *m, int64_t t_ns)
{
    for (unsigned node = 0; node != PROPOSITIONS; node++)
        m->truth_value[node] = UNSET;
    for (unsigned node = LEAVES; node != NODES; node++)
        mark(m, node);
#if INPUTS
    for (unsigned i = 0; i != INPUTS; i++) {
        const int64_t age_ns = m->now_ns - m->stamp_ns[i];
        m->stamp_ns[i] = t_ns - (age_ns < LONGEST ? age_ns : LONGEST);
    }
    for (unsigned i = 0; i != CHANNELS; i++)
        m->quiet[i] = false;
#endif
    forget_times(m, t_ns);
#if LITERALS
    for (unsigned i = 0; i != LITERALS; i++)
        set_truth_value(m, literals[i], literal_values[i], t_ns);
#endif
#if GUARDS
    for (unsigned g = 0; g != GUARDS; g++) {
        m->place[g] = -(int)UNSET;
        m->low[g] = INFINITY;
        m->high[g] = -INFINITY;
    }
    review(m, t_ns);
#endif
    m->started = true;
    m->now_ns = t_ns;
    m->wake_ns = t_ns;
}

static void report_jump(const monitor *m, int64_t t_ns)
{
    NAMED(event) event;
    memset(&event, 0, sizeof event);
    event.at_ns = t_ns;
    event.from_ns = m->now_ns;
    event.change = NAMED(TIME_JUMP);
    m->on_event(m->user, &event);
}

/* Stores the instant of the earliest timer, at most LATEST. */
static void set_wake(monitor *m)
{
    const int64_t wake_ns = earliest_timer(m);
    m->wake_ns = wake_ns < LATEST ? wake_ns : LATEST;
}

/* Runs the timers that are due before an instant, in the order of their instants. Returns the
 * number of events, or -1 if the instant is out of range.
 */
static int catch_up(monitor *m, int64_t t_ns)
{
    int events = 0;
    if (t_ns <= EARLIEST || t_ns >= LATEST)
        return -1;
    if (!m->started) {
        restart(m, t_ns);
        return 0;
    }
    if (t_ns < m->now_ns) {
        if (m->on_event)
            report_jump(m, t_ns);
        restart(m, t_ns);
        return 1;
    }
    for (;;) {
        const int64_t wake_ns = earliest_timer(m);
        if (wake_ns >= t_ns)
            break;
        tick(m, wake_ns);
#if GUARDS && BESIDE
        review(m, wake_ns);
#endif
        events += evaluate(m, wake_ns);
    }
    return events;
}
