/* The engine with tables that no generator wrote, step by step. Ends with 1 at the first that errs.
 */
#include "hand_monitor.h"

#include "engine/tables.h"

#include <stdio.h>
#include <stdlib.h>

#define NAMED(part) hand_##part
typedef hand_monitor monitor;

#define INPUTS 1
#define CHANNELS 1
#define VALUES 1
#define LEAVES 2
#define PROPOSITIONS 4
#define RULES 1
#define NODES 5
#define TIMEOUTS 1
#define GUARDS 1
#define COVERED 1
#define LITERALS 1
#define HELD 1

enum { INPUT_SPEED };
enum { VALUE_SPEED };
enum { INSIDE, ALWAYS, OUTSIDE, LONG_OUTSIDE, RULE };
enum { GUARD_SPEED };

static const index_t input_channel[1] = {0};
static const int64_t input_timeouts[1] = {INT64_C(500)};
static const index_t input_values[2] = {0, 1};
static const index_t stale_values[1] = {VALUE_SPEED};
static const uint64_t node_users[4] = {BIT(OUTSIDE), BIT(RULE), BIT(LONG_OUTSIDE), BIT(RULE)};
static const index_t guard_value[1] = {VALUE_SPEED};
static const index_t covered_values[1] = {VALUE_SPEED};
static const index_t channel_guards[2] = {0, 1};
static const index_t watching[1] = {GUARD_SPEED};
static const index_t guard_leaves[2] = {0, 1};
static const index_t guard_limits[2] = {0, 4};
static const limit limits[4] = {
    BELOW_ALL, {-1.0, INSIDE, TRUE, 1}, {2.0, INSIDE, FALSE, -1}, ABOVE_ALL};
static const unsigned char leaf_below[1] = {FALSE};
static const index_t row_blames[2] = {0, 1};
static const index_t blames[1] = {VALUE_SPEED};
static const int64_t held_durations[1] = {INT64_C(1000)};
static const index_t held_nodes[1] = {LONG_OUTSIDE};
static const index_t literals[1] = {ALWAYS};
static const unsigned char literal_values[1] = {TRUE};
static const index_t rule_condition[1] = {LONG_OUTSIDE};
static const index_t rule_release[1] = {ALWAYS};
static const index_t rule_terms[2] = {0, 1};
static const index_t terms[1] = {INSIDE};
static const index_t rule_values[2] = {0, 1};
static const index_t shown_values[1] = {VALUE_SPEED};
static const index_t rule_inputs[2] = {0, 1};
static const index_t shown_inputs[1] = {INPUT_SPEED};

#include "engine/monitor.h"

static unsigned char derive(monitor *m, unsigned node, int64_t t_ns)
{
    return node == OUTSIDE ? opposite(m->truth_value[INSIDE]) : held(m, 0, OUTSIDE, t_ns);
}

static void set_constants(monitor *m) { (void)m; }

static int receive(monitor *m, int64_t t_ns, double speed)
{
    static const bool arrived[CHANNELS] = {true};
    const int before = is_calm(m, t_ns) ? (int)CALM : begin(m, arrived, t_ns);
    if (before == REFUSED)
        return REFUSED;
    m->now_ns = t_ns;
    m->stamp_ns[INPUT_SPEED] = t_ns;
    m->value[VALUE_SPEED] = speed;
    if (before == CALM && is_inside(m, GUARD_SPEED, speed))
        return 0;
    return settle(m, arrived, t_ns, before);
}

static hand_event last;

static void keep(void *user, const hand_event *event)
{
    (void)user;
    last = *event;
}

static void check(bool holds, int line)
{
    if (!holds) {
        fprintf(stderr, "by_hand.c:%d does not hold\n", line);
        exit(1);
    }
}

#define CHECK(condition) check(condition, __LINE__)

/* Messages every 100 ns, from an instant up to and without another. */
static int drive(monitor *m, int64_t from_ns, int64_t to_ns, double speed)
{
    int events = 0;
    for (int64_t t_ns = from_ns; t_ns < to_ns; t_ns += 100)
        events += receive(m, t_ns, speed);
    return events;
}

int main(void)
{
    monitor m;
    CHECK(hand_init(&m, keep, NULL) == NULL);
    CHECK(hand_next_wake(&m) == NEVER && !hand_has_all_inputs(&m));

    CHECK(receive(&m, LATEST, 0.0) == -1 && receive(&m, EARLIEST, 0.0) == -1);
    CHECK(drive(&m, 0, 1000, 2.0) == 0 && m.truth_value[INSIDE] == TRUE); /* a limit is inside */
    CHECK(hand_has_all_inputs(&m) && hand_input_state(&m, 0) == FRESH);
    CHECK(drive(&m, 1000, 1500, 3.0) == 0 && m.since_ns[INSIDE] == 1000);
    CHECK(receive(&m, 1500, -5.0) == 0); /* both limits are crossed: it is still outside */
    CHECK(m.truth_value[INSIDE] == FALSE && m.since_ns[INSIDE] == 1000);
    CHECK(drive(&m, 1600, 2000, -5.0) == 0 && hand_next_wake(&m) == 2000);
    CHECK(receive(&m, 2050, -5.0) == 1); /* the timer of 2000 runs before the message */
    CHECK(last.change == hand_ACTIVATED && last.at_ns == 2000 && hand_is_active(&m, 0));
    CHECK(last.truth_values[0] == FALSE && last.since_ns[0] == 1000 && last.values[0] == -5.0);
    CHECK(receive(&m, 2100, 0.0) == 1 && last.change == hand_CLEARED);

    CHECK(hand_next_wake(&m) == 2600 && hand_advance(&m, 2599) == 0);
    CHECK(hand_advance(&m, 2600) == 1 && last.change == hand_ACTIVATED_STALE);
    CHECK(hand_input_state(&m, 0) == EXPIRED && last.inputs[0] == EXPIRED);
    CHECK(receive(&m, 2700, NAN) == 0 && m.truth_value[INSIDE] == STALE); /* it lacks its number */
    CHECK(receive(&m, 2800, INFINITY) == 0 && m.truth_value[INSIDE] == STALE);
    CHECK(receive(&m, 2900, 0.0) == 1 && last.change == hand_CLEARED);

    CHECK(receive(&m, 100, 0.0) == 1 && last.change == hand_TIME_JUMP && last.from_ns == 2900);
    CHECK(hand_reset(&m, 200, -1) == 0 && !hand_is_active(&m, 1) && !hand_is_active(&m, -1));
    return 0;
}
