"""Contracts that replace the parts of a call of a reactor, as C text."""

from __future__ import annotations

REPORTED = """\
enum {{
    START = {name}_START,
    STOP = {name}_STOP,
    OVERRULED = {name}_OVERRULED,
    GIVEN_UP = {name}_FAILED,
    NO_TASK_COMMAND = 99
}};

/* The task commands of a call so far, and the tasks in force when the call began. */
typedef struct {{
    unsigned char count[TASKS];
    int last[TASKS];
    bool was_in_force[TASKS];
    bool was_holding[TASKS];
}} task_commands;
task_commands nondet_task_commands(void);

static task_commands reported;

static task_commands any_task_commands(void)
{{
    task_commands found = nondet_task_commands();
    for (unsigned i = 0; i != TASKS; i++) {{
        found.was_in_force[i] = nondet_bool();
        found.was_holding[i] = nondet_bool();
    }}
    return found;
}}

/* Begin a call that has not decided on any task command. */
static void begin_call(const reactor *r)
{{
    for (unsigned i = 0; i != TASKS; i++) {{
        reported.count[i] = 0;
        reported.last[i] = NO_TASK_COMMAND;
        reported.was_holding[i] = r->state[i] == HOLDING;
        reported.was_in_force[i] = reported.was_holding[i] || r->state[i] == RUNNING;
    }}
}}

/* The contract of `decide`. */
void note_decided(reactor *r, unsigned task, unsigned command, int32_t by_rule)
{{
    __CPROVER_assert(task < TASKS, "the task of a task command exists");
    __CPROVER_assert(reported.count[task] < 2, "no task gets more than two task commands");
    if (command == OVERRULED) {{
        __CPROVER_assert(by_rule >= 0 && by_rule == spec_overruler(r, task),
            "the overruling rule owns the resource (R7, R8)");
    }} else {{
        __CPROVER_assert(by_rule == -1, "no rule overrules the task");
    }}
    if (command == START)
        __CPROVER_assert(spec_overruler(r, task) < 0, "a starting task has its resource (R7)");
    if (command == STOP) {{
        __CPROVER_assert(r->state[task] == RUNNING || r->state[task] == HOLDING,
            "only a task in force is stopped (R9)");
    }}
    if (command == GIVEN_UP)
        __CPROVER_assert(r->state[task] == FAILED || r->state[task] == OVERDUE,
            "a task that is given up has failed (R6, R15)");
    reported.count[task]++;
    reported.last[task] = (int)command;
}}
"""

CONTRACTS = """\
/* Arbitrary memory and task commands, except for members that no part of a call changes. */
static void anything(reactor *r)
{{
    const reactor old = *r;
    const task_commands was = reported;
    *r = any_reactor();
    r->now_ns = old.now_ns;
    r->opened = old.opened;
    reported = any_task_commands();
    for (unsigned i = 0; i != TASKS; i++) {{
        reported.was_in_force[i] = was.was_in_force[i];
        reported.was_holding[i] = was.was_holding[i];
    }}
}}

bool contract_set_clock(reactor *r, int64_t t_ns)
{{
    const reactor old = *r;
    if (t_ns <= EARLIEST || t_ns >= LATEST)
        return false;
    for (unsigned i = 0; i != TASKS; i++) {{
        const int64_t since_ns = nondet_instant();
        __CPROVER_assume((since_ns == NEVER) == (old.since_ns[i] == NEVER));
        __CPROVER_assume(t_ns < old.now_ns || since_ns == old.since_ns[i]);
        r->since_ns[i] = since_ns;
    }}
    r->now_ns = t_ns;
    suppose_clock(r);
    return true;
}}

/* The clock is set before the releases. Each release keeps the obligation true. */
bool set_clock_within(reactor *r, int64_t t_ns)
{{
    const bool is_set = contract_set_clock(r, t_ns);
    if (is_set)
        must_be_within(r);
    return is_set;
}}

static void stop(reactor *r, unsigned task)
{{
    reported.count[task] = 1;
    reported.last[task] = STOP;
    r->since_ns[task] = r->now_ns;
}}

/* R9: release a rule, task by task. */
static void spec_release(reactor *r, unsigned rule)
{{
{releases}
    r->started_count[rule] = 0;
    r->engaged[rule] = false;
}}

void contract_release(reactor *r, unsigned rule)
{{
    must_be_unreported(r);
    must_be_releasable(r, rule);
    spec_release(r, rule);
}}

/* Copy the lists of started tasks from another memory. */
static void copy_started(reactor *r, const reactor *other)
{{
    for (unsigned i = 0; i != RULES; i++)
        r->started_count[i] = other->started_count[i];
    for (unsigned i = 0; i != TASKS; i++)
        r->started[i] = other->started[i];
}}

void contract_append_started(reactor *r, unsigned task)
{{
    const reactor old = *r;
    const reactor other = nondet_reactor();
    __CPROVER_assert(task < TASKS, "the task exists");
    must_be_started(r);
    must_be_notable(r, task);
    copy_started(r, &other);
    suppose_noted(r, &old, task);
}}

void contract_escalate(reactor *r)
{{
    const reactor old = *r;
    const task_commands was = reported;
    must_be_within(r);
    must_be_listed(r);
    anything(r);
    suppose_within(r);
    suppose_kept(r, &old, &was);
    suppose_escalated(r, &old, &was);
    __CPROVER_assume(r->failed_count == 0);
}}

/* An arbitrary memory of a call before the stages of rules start. */
static void anything_started(reactor *r)
{{
    const reactor old = *r;
    const task_commands was = reported;
    anything(r);
    suppose_within(r);
    suppose_owned(r);
    suppose_kept(r, &old, &was);
    __CPROVER_assume(r->failed_count == 0);
}}

static void must_be_ready(const reactor *r, unsigned rule)
{{
    must_be_within(r);
    must_be_owned(r);
    must_be_startable(r, rule);
    __CPROVER_assert(r->failed_count == 0, "no failure is listed yet");
}}

/* The reactor when the call, or a part of it, began; and the rule of the check. */
static reactor before;
static unsigned looked_at;
static bool is_awaited; /* true if that rule has to start */

static bool is_fresh(const reactor *r, unsigned rule)
{{
    return r->engaged[rule] && !before.engaged[rule];
}}

/* --- of `react` --- */

void end_at_pass_on(reactor *r)
{{
    must_be_within(r);
    must_be_unreported(r);
    __CPROVER_assert(r->failed_count == 0, "no failure is listed yet");
    for (unsigned rule = 0; rule != RULES; rule++) {{
        if (is_fresh(r, rule)) {{
            __CPROVER_assert(r->stage[rule] == 0, "a rule begins with its first stage (R3)");
            must_be_unbegun(r, rule);
        }}
    }}
    __CPROVER_assume(false);
}}

void any_pass_on(reactor *r)
{{
    anything_started(r);
    if (is_fresh(r, looked_at)) {{
        __CPROVER_assume(r->stage[looked_at] == 0);
        suppose_unbegun(r, looked_at);
    }}
}}

/* The starts of other rules do not change the rule. */
void start_looked_at(reactor *r, unsigned rule)
{{
    if (rule != looked_at)
        return;
    must_be_ready(r, rule);
    __CPROVER_assert(is_fresh(r, rule), "only a newly engaged rule starts (R3)");
    __CPROVER_assume(false);
}}

void end_at_settle(reactor *r, const {name}_monitor *m)
{{
    (void)m;
    must_be_within(r);
    must_be_listed(r);
    must_be_owned(r);
    __CPROVER_assert(!is_awaited || !is_fresh(r, looked_at), "each engaged rule has started (R3)");
    __CPROVER_assume(false);
}}

/* --- of `report` --- */

static int reported_of;
static bool is_success;

void end_at_judging(reactor *r, const {name}_monitor *m)
{{
    for (int i = 0; i != TASKS; i++) {{
        const bool runs = i == reported_of && before.state[i] == RUNNING;
        const unsigned state = runs && !is_success ? FAILED : before.state[i];
        __CPROVER_assert(r->state[i] == state, "a reported failure counts, others go on (R6)");
        __CPROVER_assert(r->reported[i] == (before.reported[i] || (runs && is_success)),
            "a reported success is kept until the ends are evaluated (R4)");
    }}
    end_at_settle(r, m);
}}

/* --- of `settle` --- */

void end_at_escalate(reactor *r)
{{
    must_be_within(r);
    must_be_listed(r);
    must_be_owned(r);
    must_be_in_time(r);
    must_be_ended(r, &before);
    __CPROVER_assume(false);
}}

/* A task at its timeout has ended before. A task that begins has time left. */
void any_escalate(reactor *r)
{{
    anything_started(r);
    suppose_in_time(r);
}}

bool is_over(const reactor *r, unsigned rule)
{{
    return rule == looked_at && spec_is_over(r, rule);
}}

bool is_over_or_not(const reactor *r, unsigned rule)
{{
    return r->stage[rule] < spec_stages[rule] && nondet_bool();
}}

void start_and_end(reactor *r, unsigned rule)
{{
    must_be_ready(r, rule);
    __CPROVER_assume(false);
}}

void end_at_give_task_commands(reactor *r)
{{
    must_be_within(r);
    must_be_owned(r);
    must_be_in_time(r);
    __CPROVER_assert(r->failed_count == 0, "all escalations have started (R6)");
    __CPROVER_assert(!spec_is_over(r, looked_at), "a rule leaves a stage that is over (R5)");
    __CPROVER_assume(false);
}}

void ignore_reactor(reactor *r) {{ (void)r; }}
"""

PERFORM = """\
static reactor performing;
static unsigned performed;

static void perform_next(void *user, int task, enum {name}_task_command command, int by_rule)
{{
    (void)user;
    const {name}_decision *const made = &performing.decisions[performed];
    __CPROVER_assert(performed < performing.decided, "each given task command was decided");
    __CPROVER_assert(task == made->task && (unsigned)command == made->command
        && by_rule == made->by_rule, "the task command is given as decided");
    performed++;
}}
"""
