/* A monitor with tables that were written by hand and use all parts of the engine; rules.py says
 * what they mean. With PADDING it has more nodes than fit one word.
 */
#include "fuzzed_monitor.h"

#include "calls.h"

#include "engine/tables.h"

#define NAMED(part) fuzzed_##part
typedef fuzzed_monitor monitor;

#define CHANNELS 2
#define LEAVES (20 + PADDING)
#define NODES (PROPOSITIONS + RULES)
#define TIMEOUTS 2
#define COVERED 1
#define EXCUSES 10
#define LITERALS (2 + PADDING)
#define HELD 5
#define HELD_INITIALLY (PADDING ? 0 : 1)
#define SINCES 2
#define AGES 3
#define OSCILLATIONS 2
#define EDGES 2
#define RECENT 4
#define SAMPLED 3
#define SAMPLED_VALUES 5
#define WINDOWS 2
#define LISTS 1
#define WATCHES 2

#include "monitor_tables.h"

#include "engine/monitor.h"

static unsigned char derive(monitor *m, unsigned node, int64_t t_ns)
{
    switch (node) {
    case SWING_Y:
        return swings_or_gap(m, 0, t_ns);
    case SWING_X:
        return swings_or_gap(m, 1, t_ns);
    case NOT_INSIDE:
        return opposite(m->truth_value[X_INSIDE]);
    case ABOVE_HELD:
        return held(m, 0, X_ABOVE, t_ns);
    case OUTSIDE_HELD:
        return held(m, 1, X_OUTSIDE, t_ns);
    case ONCE:
        return opposite(m->truth_value[OUTSIDE_HELD]);
    case HUGE_HELD:
        return held(m, 2, Y_HUGE, t_ns);
    case NESTED:
        return held(m, 3, ABOVE_HELD, t_ns);
    case Y_SINCE_X:
        return since(m, 0, Y_ABOVE, X_ABOVE);
    case NOT_INSIDE_SINCE_ONCE:
        return since(m, 1, NOT_INSIDE, ONCE);
    case EDGES_X:
        return recurs(m, 0, X_ABOVE, t_ns);
    case EDGES_HELD:
        return recurs(m, 1, ABOVE_HELD, t_ns);
    case BOTH:
        return both(m->truth_value[RATE_ABOVE], m->truth_value[Y_ABOVE]);
    case EITHER:
        return either(m->truth_value[QUOTIENT_ABOVE], m->truth_value[SWING_Y]);
    case MIXED:
        return both(m->truth_value[EITHER], m->truth_value[CHANGED]);
    case SUM_HELD:
        return held(m, 4, SUM_ABOVE, t_ns);
    default:
        return UNKNOWN;
    }
}

static void set_constants(monitor *m) { (void)m; }

static void compute(monitor *m, const bool arrived[], int64_t t_ns)
{
    double *v = m->value;
    m->now_ns = t_ns;
    if (arrived[0]) {
        sample(m, 0, v[X], t_ns);
        v[RATE] = known((m->latest[0] - m->before[0]) / seconds_between(m, 0));
        sample_window(m, 1, v[X], t_ns);
        v[MEAN] = known(window_total(m, 1) / (double)m->window_count[1]);
        follow(m, 1, t_ns);
    }
    if (arrived[1]) {
        sample(m, 1, v[Y], t_ns);
        v[CHANGE] = outcome(isnan(v[Y]) || isnan(m->before[1]), v[Y] != m->before[1]);
        sample_window(m, 0, v[Y], t_ns);
        const double a = window_middle(m, 0, 0), b = window_middle(m, 0, 1);
        v[MEDIAN] = a == b ? a : a / 2.0 + b / 2.0;
        sample(m, 2, v[Y], t_ns);
        const double d = seconds_between(m, 2), y = m->before[2];
        v[LOW_PASS] = known(isnan(y) ? v[Y] : y + d / (3e-07 + d) * (m->latest[2] - y));
        sample(m, 2, v[LOW_PASS], t_ns);
        follow(m, 0, t_ns);
    }
    v[QUOTIENT] = known(v[X] / v[Y]);
    v[SUM] = known(v[LEAST] + v[X]);
}

/* Messages as a generated monitor takes them. */
static int take(monitor *m, int64_t t_ns, const bool arrived[], const double x[])
{
    const int before = are_calm(m, arrived, t_ns) ? (int)CALM : begin(m, arrived, t_ns);
    bool is_inside_all = before == CALM;
    if (before == REFUSED)
        return REFUSED;
    if (arrived[0]) {
        m->stamp_ns[INPUT_X] = t_ns;
        m->stamp_ns[INPUT_Z] = t_ns;
        m->value[X] = known(x[0]);
        m->value[Z] = x[1];
    }
    if (arrived[1]) {
        m->stamp_ns[INPUT_Y] = t_ns;
        m->value[Y] = known(x[2]);
        m->value[LEAST] = x[3];
    }
    compute(m, arrived, t_ns);
    for (unsigned channel = 0; channel != CHANNELS; channel++)
        for (unsigned i = channel_guards[channel]; i != channel_guards[channel + 1]; i++)
            if (arrived[channel])
                is_inside_all &= is_inside(m, watching[i], m->value[guard_value[watching[i]]]);
    if (is_inside_all && !is_pending(m))
        return 0;
    return settle(m, arrived, t_ns, before);
}

/* --- calls --------------------------------------------------------------------------------- */

enum { ADVANCE, MESSAGE_X, MESSAGE_Y, MESSAGES, RESET, LATCH };
enum { EVENT = 1, STATE };

/* How a monitor stands after a call. */
typedef struct stand {
    int32_t kind;
    int32_t result;
    int64_t next_wake_ns;
    int64_t wake_ns;
    int64_t since_ns[PROPOSITIONS];
    double value[VALUES];
    unsigned char truth_value[PROPOSITIONS];
    unsigned char state[INPUTS];
    unsigned char active[RULES];
    unsigned char watched[WATCHES];
    unsigned char has_all_inputs;
} stand;

static monitor tried;

static void tell(void *user, const fuzzed_event *event)
{
    const int64_t kind = EVENT;
    (void)user;
    answer(&kind, sizeof kind);
    answer(event, sizeof *event);
}

static void start(void)
{
    if (fuzzed_init(&tried, tell, NULL) != NULL)
        exit(3);
}

static int called(const call *made)
{
    const bool arrived[CHANNELS] = {made->kind != MESSAGE_Y, made->kind != MESSAGE_X};
    switch (made->kind) {
    case ADVANCE:
        return fuzzed_advance(&tried, made->t_ns);
    case RESET:
        return fuzzed_reset(&tried, made->t_ns, made->about);
    case LATCH:
        fuzzed_latch(&tried, made->about);
        return 0;
    default:
        return take(&tried, made->t_ns, arrived, made->x);
    }
}

static void make(const call *made)
{
    stand now;
    memset(&now, 0, sizeof now);
    now.kind = STATE;
    now.result = called(made);
    now.next_wake_ns = fuzzed_next_wake(&tried);
    now.wake_ns = tried.wake_ns;
    memcpy(now.since_ns, tried.since_ns, sizeof now.since_ns);
    memcpy(now.value, tried.value, sizeof now.value);
    memcpy(now.truth_value, tried.truth_value, sizeof now.truth_value);
    for (int i = 0; i != INPUTS; i++)
        now.state[i] = (unsigned char)fuzzed_input_state(&tried, i);
    for (int i = 0; i != RULES; i++)
        now.active[i] = fuzzed_is_active(&tried, i);
    for (int i = 0; i != WATCHES; i++)
        now.watched[i] = (unsigned char)fuzzed_watch(&tried, i);
    now.has_all_inputs = fuzzed_has_all_inputs(&tried);
    answer(&now, sizeof now);
}

int main(void)
{
    list_users();
    list_literals();
    answer_all(start, make);
    return 0;
}
