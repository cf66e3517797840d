/* Part of ROSSMARie, the same for all rules. */

/* The engine of a reactor. It turns the activity of rules into task commands that start and stop
 * tasks. Before NAME_reactor.c includes this file, it defines the tables of tasks and escalations,
 * in the types of plans.h. Numbers such as R2 refer to the rules of the semantics of reactions.
 */
#ifdef ROSSMARIE_REACTOR
#error "include the engine of only one reactor in a file"
#endif
#define ROSSMARIE_REACTOR

/* --- task commands ------------------------------------------------------------------------- */

/* Stores a task command of this call. No task gets more than two in one call. */
static void decide(reactor *r, unsigned task, unsigned command, int32_t by_rule)
{
    r->decisions[r->decided].task = (index_t)task;
    r->decisions[r->decided].command = (index_t)command;
    r->decisions[r->decided].by_rule = by_rule;
    r->decided++;
}

/* Passes the stored task commands to the callback. */
static void give_task_commands(reactor *r)
{
    for (unsigned i = 0; i != r->decided; i++) {
        const NAMED(decision) *made = &r->decisions[i];
        r->perform(r->user, made->task, (enum NAMED(task_command))made->command, made->by_rule);
    }
    r->decided = 0;
}

#include "retraces.h"

/* --- time ---------------------------------------------------------------------------------- */

/* Sets the clock. If time goes backwards, all ages stay the same. Returns false if the instant is
 * out of range.
 */
static bool set_clock(reactor *r, int64_t t_ns)
{
    if (t_ns <= EARLIEST || t_ns >= LATEST)
        return false;
    for (unsigned task = 0; task != TASKS && t_ns < r->now_ns; task++) {
        if (r->since_ns[task] != NEVER) {
            const int64_t age_ns = r->now_ns - r->since_ns[task];
            r->since_ns[task] = t_ns - (age_ns < LONGEST ? age_ns : LONGEST);
        }
    }
#if RETRACES
    if (t_ns < r->now_ns)
        pose_set_back(r, t_ns);
#endif
    r->now_ns = t_ns;
    return true;
}

/* Returns the instant at which a RUNNING or WAITING task times out, else NEVER. */
static int64_t due(const reactor *r, unsigned task)
{
    const bool is_open = r->state[task] == RUNNING || r->state[task] == WAITING;
    return is_open && tasks[task].timeout_ns != 0 ? r->since_ns[task] + tasks[task].timeout_ns
                                                  : NEVER;
}

/* --- tasks --------------------------------------------------------------------------------- */

static bool is_in_force(const reactor *r, unsigned task)
{
    return r->state[task] == RUNNING || r->state[task] == HOLDING;
}

/* Returns the other rule that owns the resource of a task (R2), -1 if there is none. Publications
 * of the same message share their topic. Every other kind of deed has a timeout.
 */
static int32_t overruler(const reactor *r, unsigned task)
{
    const unsigned resource = tasks[task].resource;
    if (resource == NONE)
        return -1;
    for (unsigned i = resource_rules[resource]; i != resource_rules[resource + 1]; i++) {
        const unsigned rule = claiming_rules[i];
        const bool is_same = tasks[task].deed != NONE && claiming_deed[i] == tasks[task].deed;
        if (r->engaged[rule]) {
            const bool is_shared = is_same && tasks[task].timeout_ns == 0;
            return rule == tasks[task].rule || is_shared ? -1 : (int32_t)rule;
        }
    }
    return -1;
}

/* Records a task as the last started task of its rule. */
static void append_started(reactor *r, unsigned task)
{
    const unsigned rule = tasks[task].rule;
    const unsigned first = rule_tasks[rule];
    unsigned count = 0;
    for (unsigned i = 0; i != r->started_count[rule]; i++)
        if (r->started[first + i] != task)
            r->started[first + count++] = r->started[first + i];
    r->started[first + count] = (index_t)task;
    r->started_count[rule] = (index_t)(count + 1);
}

static void begin(reactor *r, unsigned task)
{
    append_started(r, task);
    if (tasks[task].timeout_ns != 0)
        r->state[task] = RUNNING;
    else
        r->state[task] = tasks[task].end;
    r->since_ns[task] = r->now_ns;
    r->reported[task] = false;
#if RETRACES
    pose_begin(r, task);
#endif
    decide(r, task, NAMED(START), -1);
}

static void fail(reactor *r, unsigned task, unsigned char state)
{
    r->state[task] = state;
    r->failed[r->failed_count] = (index_t)task;
    r->failed_count++;
}

/* Lets a task wait because another rule owns its resource. A running task keeps its time limit. */
static void give_way(reactor *r, unsigned task)
{
    if (r->state[task] != RUNNING)
        r->since_ns[task] = r->now_ns;
    r->state[task] = WAITING;
    if (tasks[task].fails_at_once)
        fail(r, task, OVERDUE);
}

/* Starts the tasks that are IDLE. A task whose resource another rule owns waits or fails (R7). */
static void start(reactor *r, const index_t *first, const index_t *end)
{
    for (const index_t *task = first; task != end; task++) {
        const int32_t by_rule = overruler(r, *task);
        if (r->state[*task] != IDLE)
            continue;
        if (by_rule < 0) {
            begin(r, *task);
            continue;
        }
        decide(r, *task, NAMED(OVERRULED), by_rule);
        if (tasks[*task].waits)
            give_way(r, *task);
        else
            fail(r, *task, FAILED);
    }
}

/* Starts the escalations of failed tasks, including the escalations of failed escalations (R6). */
static void escalate(reactor *r)
{
    for (unsigned i = 0; i != r->failed_count; i++) {
        const unsigned task = r->failed[i];
        decide(r, task, NAMED(FAILED), -1);
#if ESCALATIONS
        start(r, &escalations[task_escalations[task]], &escalations[task_escalations[task + 1]]);
#endif
    }
    r->failed_count = 0;
}

/* --- rules --------------------------------------------------------------------------------- */

/* Releases a rule (R9): stops its tasks in force, the last started task first; forgets its plan. */
static void release(reactor *r, unsigned rule)
{
    for (unsigned i = r->started_count[rule]; i != 0; i--) {
        const unsigned task = r->started[rule_tasks[rule] + i - 1];
        if (is_in_force(r, task)) {
            decide(r, task, NAMED(STOP), -1);
            r->since_ns[task] = r->now_ns;
        }
    }
    for (unsigned i = rule_tasks[rule]; i != rule_tasks[rule + 1]; i++)
        r->state[planned_tasks[i]] = IDLE;
    r->started_count[rule] = 0;
    r->engaged[rule] = false;
}

static void give_up(reactor *r, unsigned task)
{
    if (tasks[task].waits)
        give_way(r, task);
    else if (r->state[task] == RUNNING)
        fail(r, task, FAILED);
    else
        r->state[task] = DONE;
}

/* Applies changes of owners (R8): gives up resources, escalates, then starts waiting tasks. */
static void pass_resources_on(reactor *r)
{
    for (unsigned task = 0; task != TASKS; task++) {
        const int32_t by_rule = is_in_force(r, task) ? overruler(r, task) : -1;
        if (by_rule >= 0) {
            decide(r, task, NAMED(OVERRULED), by_rule);
            give_up(r, task);
        }
    }
    escalate(r);
    for (unsigned task = 0; task != TASKS; task++)
        if ((r->state[task] == WAITING || r->state[task] == OVERDUE) && overruler(r, task) < 0)
            begin(r, task);
}

/* Starts the current stage of a rule, unless its plan is finished. */
static void start_stage(reactor *r, unsigned rule)
{
    const unsigned stage = rule_stages[rule] + r->stage[rule];
    if (stage != rule_stages[rule + 1]) {
        start(r, &staged_tasks[stage_tasks[stage]], &staged_tasks[stage_tasks[stage + 1]]);
        escalate(r);
    }
}

static bool is_stage_over(const reactor *r, unsigned rule)
{
    const unsigned stage = rule_stages[rule] + r->stage[rule];
    if (!r->engaged[rule] || stage == rule_stages[rule + 1])
        return false;
    for (unsigned i = stage_tasks[stage]; i != stage_tasks[stage + 1]; i++) {
        const unsigned state = r->state[staged_tasks[i]];
        if (state != HOLDING && state != WAITING && state != OVERDUE && state != DONE)
            return false;
    }
    return true;
}

/* Returns true if the end of a task is confirmed, or needs no confirmation. */
static bool is_confirmed(const NAMED(monitor) * m, unsigned task)
{
#if CONFIRMED
    if (tasks[task].watch != NONE)
        return NAMED(watch)(m, tasks[task].watch) == NAMED(TRUE);
#endif
    (void)m;
    (void)task;
    return true;
}

/* Returns true if a confirmation or the owner substitutes for a waiting task (R15). */
static bool is_answered(const reactor *r, const NAMED(monitor) * m, unsigned task)
{
    const int32_t owner = overruler(r, task);
    if (tasks[task].watch != NONE)
        return is_confirmed(m, task);
    if (owner < 0 || tasks[task].deed == NONE)
        return false;
    for (unsigned i = rule_tasks[owner]; i != rule_tasks[owner + 1]; i++) {
        const unsigned other = planned_tasks[i];
        if (r->state[other] == HOLDING && tasks[other].answer == tasks[task].deed)
            return true;
    }
    return false;
}

/* Fails the waiting tasks that are late and have no substitute (R15). */
static void settle_waits(reactor *r, const NAMED(monitor) * m)
{
    for (unsigned task = 0; task != TASKS; task++) {
        const bool is_late = r->state[task] == WAITING && r->now_ns >= due(r, task);
        if (is_late && !is_answered(r, m, task))
            fail(r, task, OVERDUE);
    }
}

/* Handles the ends of tasks (R4), then starts the stages that follow (R5). */
static void settle(reactor *r, const NAMED(monitor) * m)
{
    for (unsigned task = 0; task != TASKS; task++) {
        const int64_t due_ns = due(r, task);
        if (r->state[task] != RUNNING)
            continue;
        if (r->now_ns <= due_ns && r->reported[task] && is_confirmed(m, task))
            r->state[task] = tasks[task].end;
        else if (r->now_ns >= due_ns)
            fail(r, task, FAILED);
    }
    settle_waits(r, m);
    escalate(r);
    for (unsigned i = 0; i != RULES; i++) {
        while (is_stage_over(r, rule_order[i])) {
            r->stage[rule_order[i]]++;
            start_stage(r, rule_order[i]);
        }
    }
#if RETRACES
    pose_send(r);
#endif
    give_task_commands(r);
}

#include "commands.h"

/* --- the rest of the interface ------------------------------------------------------------- */

const char *NAMED(reactor_init)(reactor *r, NAMED(perform) perform, void *user)
{
    memset(r, 0, sizeof *r);
    for (unsigned task = 0; task != TASKS; task++)
        r->since_ns[task] = NEVER;
#if RETRACES
    pose_forget(r);
#endif
    r->now_ns = EARLIEST;
    r->perform = perform;
    r->user = user;
#if COMMANDS || RETRACES
    return arithmetic_fault();
#else
    return NULL;
#endif
}

void NAMED(reactor_open)(reactor *r) { r->opened = true; }

/* Returns true if a rule is active and not exempted. */
static bool engages(const NAMED(monitor) * m, const unsigned char *exempted, unsigned rule)
{
    return NAMED(is_active)(m, (int)rule) && !(exempted && exempted[rule]);
}

/* Returns true if a rule behind `unless` suspends this rule. */
static bool yields(const NAMED(monitor) * m, const unsigned char *exempted, unsigned rule)
{
#if YIELDING
    for (unsigned i = rule_unless[rule]; i != rule_unless[rule + 1]; i++)
        if (engages(m, exempted, others[i]))
            return true;
#endif
    (void)m;
    (void)exempted;
    (void)rule;
    return false;
}

void NAMED(react)(reactor *r, const NAMED(monitor) * m, const unsigned char *exempted, int64_t t_ns)
{
    bool starts[RULES];
    if (!set_clock(r, t_ns))
        return;
    for (unsigned rule = 0; rule != RULES; rule++) {
        const bool goes_on = engages(m, exempted, rule) && !yields(m, exempted, rule);
        starts[rule] = goes_on && !r->engaged[rule];
        if (r->engaged[rule] && !goes_on)
            release(r, rule);
    }
    for (unsigned rule = 0; rule != RULES; rule++) {
        if (starts[rule]) {
            r->engaged[rule] = true;
            r->stage[rule] = 0;
        }
    }
#if RETRACES
    pose_record(r, m);
#endif
    pass_resources_on(r);
    for (unsigned i = 0; i != RULES; i++)
        if (starts[rule_order[i]])
            start_stage(r, rule_order[i]);
    settle(r, m);
}

void NAMED(report)(reactor *r, const NAMED(monitor) * m, int64_t t_ns, int task, bool success)
{
    if (task < 0 || task >= (int)TASKS || !set_clock(r, t_ns))
        return;
    if (r->state[task] == RUNNING) {
        if (success)
            r->reported[task] = true;
        else
            fail(r, (unsigned)task, FAILED);
    }
    settle(r, m);
}

int64_t NAMED(reactor_next_wake)(const reactor *r)
{
    int64_t wake_ns = NEVER;
    for (unsigned task = 0; task != TASKS; task++) {
        const int64_t due_ns = due(r, task);
        if (due_ns > r->now_ns)
            wake_ns = due_ns < wake_ns ? due_ns : wake_ns;
    }
#if RETRACES
    wake_ns = pose_wake(r, wake_ns);
#endif
    return wake_ns;
}

int NAMED(task_state)(const reactor *r, int task)
{
    return task >= 0 && task < (int)TASKS ? r->state[task] : (int)IDLE;
}
