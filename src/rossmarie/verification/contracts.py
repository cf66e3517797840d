"""Contracts: each replaces a part of the generated code that has its own check.

A contract asserts the preconditions of its part, forgets everything that the part may change, and
assumes the facts that the check of the part has proved. The text is the same for every machine,
except for a few numbers.
"""

from __future__ import annotations

NONDETERMINISM = """\
monitor nondet_monitor(void);
int64_t nondet_instant(void);
unsigned nondet_number(void);
int nondet_integer(void);
double nondet_double(void);

static int64_t asked_ns; /* the instant at which a function is called */
static monitor base; /* the monitor at the beginning, or after the last contract */

/* The events that the listener received: the last event of each rule, and their number. */
static {name}_event reported[{rules}], jump;
static unsigned reports[{rules}], jumps;

static void observe(void *user, const {name}_event *event)
{{
    __CPROVER_assert(user == &base, "the listener receives its own `user` pointer");
    if (event->change == {name}_TIME_JUMP) {{
        jump = *event;
        jumps++;
    }} else {{
        __CPROVER_assert(event->rule >= 0 && event->rule < {rules}, "the rule of an event exists");
        reported[event->rule] = *event;
        reports[event->rule]++;
    }}
}}

static bool is_marked(const monitor *m, unsigned node)
{{
    return ({word} >> (node % 64) & 1) != 0;
}}

static bool is_marked_up_to(const monitor *m, unsigned node)
{{
    bool found = false;
    for (unsigned n = LEAVES; n != PROPOSITIONS + RULES; n++)
        found = found | (n <= node && is_marked(m, n));
    return found;
}}

/* Arbitrary bits in memory, within the limits of C: a bool is 0 or 1, and a callback is valid. */
static monitor any(void)
{{
    monitor m = nondet_monitor();
    m.started = nondet_number() % 2 != 0;
{pending}    for (unsigned i = 0; i != sizeof m.quiet / sizeof m.quiet[0]; i++)
        m.quiet[i] = nondet_number() % 2 != 0;
    m.on_event = nondet_number() % 2 != 0 ? observe : NULL;
    m.user = &base;
    return m;
}}
"""

CONTRACTS = """\
/* Replace a monitor with an arbitrary monitor that has the same listener. */
static void forget(monitor *m, const monitor *old)
{{
    *m = any();
    m->on_event = old->on_event;
    m->user = old->user;
}}

/* The number of changes that the parts of a function have reported. */
static int changes;

static int any_count(int most)
{{
    const int count = nondet_integer();
    __CPROVER_assume(count >= 0 && count <= most);
    changes += count;
    return count;
}}

/* Contracts of the choice of a path. One assumes that the short path is allowed and takes it; the
 * other always takes the long path.
 */
bool assume_calm(const monitor *m, int64_t t_ns)
{{
    __CPROVER_assume(t_ns >= m->now_ns && t_ns < m->wake_ns);
    return true;
}}

bool never_calm(const monitor *m, int64_t t_ns)
{{
    (void)m;
    (void)t_ns;
    return false;
}}

/* The long path begins here. It has its own checks. */
int never_catch_up(monitor *m, int64_t t_ns)
{{
    (void)m;
    (void)t_ns;
    __CPROVER_assume(false);
    return 0;
}}

/* The marks when a function began, or after its last visit to a node. */
static monitor due;

static void must_be_due(const monitor *m, unsigned node)
{{
    for (unsigned n = LEAVES; n != PROPOSITIONS + RULES; n++)
        __CPROVER_assert(is_marked(&due, n) == (n == node || is_marked(m, n)),
            "each marked node is visited exactly once, and no other node is visited");
}}

int contract_visit(monitor *m, unsigned node, int64_t t_ns)
{{
    __CPROVER_assert(t_ns == asked_ns, "the monitor evaluates the node at the requested instant");
{pending}    must_be_due(m, node);
    __CPROVER_assert(node >= LEAVES && node < PROPOSITIONS + RULES, "the evaluated node exists");
    __CPROVER_assert(!is_marked_up_to(m, node), "the evaluated node is the first marked node");
    for (unsigned n = LEAVES; n != PROPOSITIONS + RULES; n++)
        if (n > node && nondet_number() % 2 != 0)
            mark(m, n);
    due = *m;
    return any_count(1);
}}

/* The inputs after a tick. An input that arrived at this very instant keeps its state. */
static void suppose_ticked(const monitor *m, const monitor *old, int64_t t_ns)
{{
    for (unsigned i = 0; i != INPUTS; i++) {{
        const bool is_here = old->stamp_ns[i] == t_ns;
        __CPROVER_assume(m->stamp_ns[i] == old->stamp_ns[i]);
        __CPROVER_assume((m->state[i] == NEVER_RECEIVED) == (old->state[i] == NEVER_RECEIVED));
        __CPROVER_assume(!is_here || m->state[i] == old->state[i]);
    }}
    __CPROVER_assume(m->now_ns == old->now_ns);
    suppose_looked(m, t_ns);
}}

/* The monitor after a restart. Every call gives the same monitor, so that joined paths agree. */
static monitor anew;

void suppose_anew(const monitor *m, int64_t t_ns)
{{
    forget(&anew, m);
    suppose_restarted(&anew, t_ns);
    suppose_unlooked(&anew, t_ns);
}}

void contract_restart(monitor *m, int64_t t_ns)
{{
    __CPROVER_assert(!m->started || t_ns < m->now_ns,
        "the monitor has not started, or time goes backwards");
    __CPROVER_assert(t_ns == anew.now_ns, "the monitor restarts at the requested instant");
    *m = anew;
}}

/* The earlier of two instants, compared only with two instants that are chosen beforehand. The
 * order of many instants is hard for a solver; the order of each and a chosen one is easy.
 */
static int64_t before_ns, after_ns;

int64_t contract_earlier(int64_t a, int64_t b)
{{
    const int64_t found_ns = nondet_instant();
    __CPROVER_assume((found_ns < before_ns) == (a < before_ns || b < before_ns));
    __CPROVER_assume((found_ns > after_ns) == (a > after_ns && b > after_ns));
    return found_ns;
}}

int64_t any_timer(const monitor *m)
{{
    (void)m;
    return nondet_instant();
}}

int64_t never_timer(const monitor *m)
{{
    (void)m;
    __CPROVER_assert(false, "the function searches for no timer");
    __CPROVER_assume(false);
    return 0;
}}

/* An instant after the clock, with no timer before it. */
int64_t contract_earliest_timer(const monitor *m)
{{
    const int64_t wake_ns = nondet_instant();
    must_be_at_rest(m, m->now_ns);
    __CPROVER_assume(wake_ns > m->now_ns);
    suppose_ahead(m, wake_ns);
    return wake_ns;
}}

/* The checks of a function that takes an instant have three stages. Each stage has only the facts
 * that it needs. The first stage ends when timers are handled. The second stage ends when
 * propositions are evaluated or the next timer is set. The third stage is the rest.
 */
static bool is_late = false;

int caught_up(monitor *m, int64_t t_ns)
{{
    const monitor old = *m;
    forget(m, &old);
    __CPROVER_assume(m->now_ns <= t_ns);
    suppose_unlooked(m, t_ns);
    base = *m;
    return 0;
}}

int caught_up_somehow(monitor *m, int64_t t_ns)
{{
    const monitor old = *m;
    forget(m, &old);
    __CPROVER_assume(m->now_ns <= t_ns);
    return 0;
}}

void end_at_tick(monitor *m, int64_t t_ns)
{{
    must_be_reported(m, &base);
    must_be_unlooked(m, t_ns);
    __CPROVER_assume(false);
}}

void tick_and_end(monitor *m, int64_t t_ns)
{{
    __CPROVER_assert(t_ns > m->now_ns, "time goes forward");
    end_at_tick(m, t_ns);
}}

void never_tick(monitor *m, int64_t t_ns)
{{
    (void)m;
    (void)t_ns;
    __CPROVER_assume(false);
}}

void ticked(monitor *m, int64_t t_ns)
{{
    const monitor old = *m;
    forget(m, &old);
    suppose_ticked(m, &old, t_ns);
    base = *m;
}}

void never_restart(monitor *m, int64_t t_ns)
{{
    (void)m;
    (void)t_ns;
    __CPROVER_assert(false, "the monitor does not restart");
    __CPROVER_assume(false);
}}

void ticked_somehow(monitor *m, int64_t t_ns)
{{
    const monitor old = *m;
    (void)t_ns;
    forget(m, &old);
}}

void tick_once(monitor *m, int64_t t_ns)
{{
    __CPROVER_assume(!is_late);
    ticked_somehow(m, t_ns);
}}

bool maybe_pending(const monitor *m)
{{
    (void)m;
    return nondet_number() % 2 != 0;
}}

int end_at_evaluate(monitor *m, int64_t t_ns)
{{
    must_be_looked(m, t_ns);
    must_be_reported(m, &base);
    __CPROVER_assume(false);
    return 0;
}}

/* The evaluation, for checks that need only one fact: nothing changes after it. */
int evaluated_somehow(monitor *m, int64_t t_ns)
{{
    const monitor old = *m;
    forget(m, &old);
    __CPROVER_assume(m->now_ns == t_ns);
    base = *m;
    is_late = true;
    return any_count(RULES);
}}

/* The next pass begins with the monitor that this pass leaves. */
int64_t timer_of_a_pass(const monitor *m)
{{
    if (is_late)
        must_be_same(m, &base);
    return nondet_instant();
}}

/* Contracts for checks of the number of changes only. */
int count_caught_up(monitor *m, int64_t t_ns)
{{
    (void)m;
    return t_ns <= EARLIEST || t_ns >= LATEST ? -1 : any_count({most_events});
}}

int count_evaluated(monitor *m, int64_t t_ns)
{{
    (void)m;
    (void)t_ns;
    return any_count(RULES);
}}

int change_nothing(monitor *m, int64_t t_ns)
{{
    (void)m;
    (void)t_ns;
    return 0;
}}

void ignore_tick(monitor *m, int64_t t_ns)
{{
    (void)m;
    (void)t_ns;
}}

void ignore_arrive(monitor *m, unsigned channel, int64_t t_ns)
{{
    (void)m;
    (void)channel;
    (void)t_ns;
}}

void ignore_follow(monitor *m, unsigned k, int64_t t_ns)
{{
    (void)m;
    (void)k;
    (void)t_ns;
}}

void end_at_set_wake(monitor *m)
{{
    __CPROVER_assert(m->now_ns == asked_ns, "the clock is set");
    must_be_at_rest(m, asked_ns);
    must_be_reported(m, &base);
    __CPROVER_assume(false);
}}

void set_wake_somehow(monitor *m)
{{
    const monitor old = *m;
    if (is_late) {{
        __CPROVER_assert(m->now_ns == asked_ns, "the clock is set");
        must_be_same(m, &base);
    }}
    forget(m, &old);
    __CPROVER_assume(m->now_ns == asked_ns);
    base = *m;
    is_late = true;
}}

void ignore_wake(monitor *m) {{ (void)m; }}

int contract_advance(monitor *m, int64_t t_ns)
{{
    const monitor old = *m;
    if (t_ns <= EARLIEST || t_ns >= LATEST)
        return -1;
    forget(m, &old);
    __CPROVER_assume(m->now_ns == t_ns);
    suppose_at_rest(m, t_ns);
    base = *m;
    return any_count({most_events});
}}
"""
