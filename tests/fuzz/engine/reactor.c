/* A reactor with tables that were written by hand; plans.py says what they mean. Its monitor is a
 * stand-in: calls say which rules are active.
 */
#include "calls.h"

#include <stdbool.h>
#include <stddef.h>

#define NAMED(part) fuzzed_##part
#define TASKS 9
#define RULES 4
#define COMMANDS 2
#define SCALES 1
#define CONFIRMED 1
#define ESCALATIONS 2
#define YIELDING 1

enum fuzzed_truth_value { fuzzed_FALSE, fuzzed_TRUE, fuzzed_UNKNOWN, fuzzed_STALE };
enum fuzzed_task_command { fuzzed_START, fuzzed_STOP, fuzzed_OVERRULED, fuzzed_FAILED };
enum fuzzed_task_state {
    fuzzed_TASK_IDLE,
    fuzzed_TASK_RUNNING,
    fuzzed_TASK_HOLDING,
    fuzzed_TASK_WAITING,
    fuzzed_TASK_DONE,
    fuzzed_TASK_FAILED,
    fuzzed_TASK_OVERDUE
};

typedef void (*fuzzed_perform)(void *user, int task, enum fuzzed_task_command command, int by_rule);

typedef struct fuzzed_decision {
    int32_t by_rule;
    uint16_t task;
    uint16_t command;
} fuzzed_decision;

typedef struct fuzzed_reactor {
    int64_t now_ns;
    int64_t since_ns[TASKS];
    unsigned char state[TASKS];
    bool reported[TASKS];
    bool engaged[RULES];
    bool opened;
    uint16_t stage[RULES];
    uint16_t started[TASKS];
    uint16_t started_count[RULES];
    uint16_t failed[TASKS];
    uint16_t failed_count;
    uint16_t decided;
    fuzzed_decision decisions[2 * TASKS];
    fuzzed_perform perform;
    void *user;
} fuzzed_reactor;

typedef struct fuzzed_bounds {
    double factor;
    double low;
    double high;
} fuzzed_bounds;

/* The monitor: a bit for each active rule, and the watched proposition. */
typedef struct fuzzed_monitor {
    unsigned active;
    unsigned truth_value;
} fuzzed_monitor;

static bool fuzzed_is_active(const fuzzed_monitor *m, int rule)
{
    return (m->active >> rule & 1u) != 0;
}

static enum fuzzed_truth_value fuzzed_watch(const fuzzed_monitor *m, int watch)
{
    (void)watch;
    return (enum fuzzed_truth_value)m->truth_value;
}

typedef fuzzed_reactor reactor;

#include "engine/plans.h"

static const plan tasks[TASKS] = {
    {0, 0, HOLDING, true, false, 0, 0, 0, NONE},
    {0, 400, HOLDING, false, false, NONE, NONE, NONE, NONE},
    {0, 0, HOLDING, false, false, NONE, NONE, NONE, NONE},
    {1, 300, DONE, true, true, 1, NONE, NONE, NONE},
    {1, 0, HOLDING, true, false, 0, 0, 0, NONE},
    {1, 0, HOLDING, false, false, NONE, NONE, NONE, NONE},
    {2, 500, HOLDING, true, false, 0, NONE, NONE, 0},
    {2, 0, HOLDING, false, false, NONE, NONE, NONE, NONE},
    {3, 0, HOLDING, false, false, 1, 1, NONE, NONE},
};
static const index_t task_escalations[TASKS + 1] = {0, 0, 1, 1, 2, 2, 2, 2, 2, 2};
static const index_t escalations[2] = {2, 5};
static const index_t rule_order[RULES] = {2, 0, 1, 3};
static const index_t rule_stages[RULES + 1] = {0, 1, 3, 5, 6};
static const index_t stage_tasks[7] = {0, 2, 3, 4, 5, 6, 7};
static const index_t staged_tasks[7] = {0, 1, 3, 4, 6, 7, 8};
static const index_t rule_tasks[RULES + 1] = {0, 3, 6, 8, 9};
static const index_t planned_tasks[TASKS] = {0, 1, 2, 3, 4, 5, 6, 7, 8};
static const index_t rule_unless[RULES + 1] = {0, 0, 0, 0, 1};
static const index_t others[1] = {2};
static const index_t resource_rules[3] = {0, 3, 5};
static const index_t claiming_rules[5] = {2, 0, 1, 1, 3};
static const index_t claiming_deed[5] = {NONE, 0, 0, NONE, 1};
static const index_t command_fields[COMMANDS] = {3, 1};
static const index_t command_limits[COMMANDS + 1] = {0, 3, 3};
static const bound bounding[3] = {
    {2, 0, -0.2, 0.2, 0.3}, {2, 2, -1.0, 1.0, 0.0}, {7, 0, -0.1, 0.5, 1e9}};
static const index_t command_scales[COMMANDS + 1] = {0, 1, 1};
static const scale scales[1] = {{5, 0.5, 0.1}};

#include "engine/reactor.h"

/* --- calls --------------------------------------------------------------------------------- */

enum { REACT, REPORT, OPEN, BOUND };
enum { TASK_COMMAND = 1, STAND };

typedef struct task_command {
    int32_t kind;
    int32_t task;
    int32_t command;
    int32_t by_rule;
} task_command;

/* How a reactor stands after a call, and what lies on the first command then. */
typedef struct stand {
    int64_t kind;
    int64_t now_ns;
    int64_t next_wake_ns;
    int64_t since_ns[TASKS];
    fuzzed_bounds bounds[3];
    double bounded[3];
    unsigned char state[TASKS];
    unsigned char engaged[RULES];
    unsigned char stage[RULES];
} stand;

static reactor tried;
static fuzzed_monitor monitored;

static void tell(void *user, int task, enum fuzzed_task_command given, int by_rule)
{
    const task_command reported = {TASK_COMMAND, task, given, by_rule};
    (void)user;
    answer(&reported, sizeof reported);
}

static void start_anew(void)
{
    memset(&monitored, 0, sizeof monitored);
    if (fuzzed_reactor_init(&tried, tell, NULL) != NULL)
        exit(3);
}

static void make(const call *made)
{
    const unsigned about = (unsigned)made->about;
    unsigned char exempted[RULES];
    stand now;
    memset(&now, 0, sizeof now);
    for (unsigned rule = 0; rule != RULES; rule++)
        exempted[rule] = (unsigned char)(about >> (4 + rule) & 1u);
    if (made->kind == REACT) {
        monitored.active = about & 15u;
        monitored.truth_value = about >> 8 & 3u;
        fuzzed_react(&tried, &monitored, exempted, made->t_ns);
    } else if (made->kind == REPORT) {
        fuzzed_report(&tried, &monitored, made->t_ns, (int)(about & 15u), (about & 16u) != 0);
    } else if (made->kind == OPEN) {
        fuzzed_reactor_open(&tried);
    }
    now.kind = STAND;
    now.now_ns = tried.now_ns;
    now.next_wake_ns = fuzzed_reactor_next_wake(&tried);
    memcpy(now.since_ns, tried.since_ns, sizeof now.since_ns);
    fuzzed_bounds_of(&tried, made->t_ns, 0, now.bounds);
    for (unsigned i = 0; i != 3; i++)
        now.bounded[i] = fuzzed_bounded(now.bounds[i], made->x[i]);
    for (int task = 0; task != TASKS; task++)
        now.state[task] = (unsigned char)fuzzed_task_state(&tried, task);
    for (unsigned rule = 0; rule != RULES; rule++) {
        now.engaged[rule] = tried.engaged[rule];
        now.stage[rule] = (unsigned char)tried.stage[rule];
    }
    answer(&now, sizeof now);
}

int main(void)
{
    answer_all(start_anew, make);
    return 0;
}
