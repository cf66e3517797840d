/* The tables of monitor.c, in the words of engine/tables.h; rules.py says what they mean. */
#ifndef MONITOR_TABLES_H
#define MONITOR_TABLES_H

enum { X, Y, Z, LEAST, RATE, CHANGE, MEDIAN, MEAN, LOW_PASS, QUOTIENT, SUM };
enum { INPUT_X, INPUT_Y, INPUT_Z };
enum {
    X_INSIDE,
    X_OUTSIDE,
    X_ABOVE,
    Y_ABOVE,
    Y_HUGE,
    Z_ABOVE,
    LEAST_ABOVE,
    LEAST_HUGE,
    RATE_ABOVE,
    CHANGED,
    MEDIAN_ABOVE,
    MEAN_ABOVE,
    LOW_PASS_ABOVE,
    QUOTIENT_ABOVE,
    SUM_ABOVE,
    AGE_X,
    AGE_Y,
    AGE_Z,
    ALWAYS,
    NOT_EVER,
    SWING_Y = LEAVES,
    SWING_X,
    NOT_INSIDE,
    ABOVE_HELD,
    OUTSIDE_HELD,
    ONCE,
    HUGE_HELD,
    NESTED,
    Y_SINCE_X,
    NOT_INSIDE_SINCE_ONCE,
    EDGES_X,
    EDGES_HELD,
    BOTH,
    EITHER,
    MIXED,
    SUM_HELD,
    RULE
};

static const index_t input_channel[INPUTS] = {0, 1, 0};
static const int64_t input_timeouts[INPUTS] = {INT64_C(500), INT64_C(0), INT64_C(900)};
static const index_t input_values[INPUTS + 1] = {0, 5, 5, 6};
static const index_t stale_values[6] = {X, RATE, MEAN, QUOTIENT, SUM, Z};
static const index_t input_samples[INPUTS + 1] = {0, 1, 1, 1};
static const index_t stale_samples[1] = {0};
static const index_t input_windows[INPUTS + 1] = {0, 1, 1, 1};
static const index_t stale_windows[1] = {1};
static const index_t sampled_values[SAMPLED_VALUES] = {RATE, CHANGE, MEDIAN, MEAN, LOW_PASS};

/* Who depends on a proposition, sorted by propositions. */
static const struct {
    index_t proposition;
    index_t user;
} uses[] = {
    {X_INSIDE, NOT_INSIDE},
    {X_OUTSIDE, OUTSIDE_HELD},
    {X_ABOVE, ABOVE_HELD},
    {X_ABOVE, Y_SINCE_X},
    {X_ABOVE, EDGES_X},
    {Y_ABOVE, Y_SINCE_X},
    {Y_ABOVE, BOTH},
    {Y_HUGE, HUGE_HELD},
    {RATE_ABOVE, BOTH},
    {CHANGED, MIXED},
    {QUOTIENT_ABOVE, EITHER},
    {SUM_ABOVE, SUM_HELD},
    {AGE_Y, RULE + 5},
    {AGE_Z, RULE + 9},
    {ALWAYS, RULE + 0},
    {ALWAYS, RULE + 4},
    {ALWAYS, RULE + 6},
    {ALWAYS, RULE + 8},
    {ALWAYS, RULE + 9},
    {SWING_Y, EITHER},
    {SWING_X, RULE + 8},
    {NOT_INSIDE, NOT_INSIDE_SINCE_ONCE},
    {NOT_INSIDE, RULE + 3},
    {ABOVE_HELD, NESTED},
    {ABOVE_HELD, EDGES_HELD},
    {ABOVE_HELD, RULE + 0},
    {OUTSIDE_HELD, ONCE},
    {ONCE, NOT_INSIDE_SINCE_ONCE},
    {ONCE, RULE + 2},
    {Y_SINCE_X, RULE + 2},
    {NOT_INSIDE_SINCE_ONCE, RULE + 7},
    {EDGES_X, RULE + 3},
    {BOTH, RULE + 7},
    {EITHER, MIXED},
    {EITHER, RULE + 1},
    {MIXED, RULE + 4},
    {SUM_HELD, RULE + 6},
};
enum { USES = sizeof uses / sizeof uses[0] };

#if NODES <= 64

static uint64_t node_users[PROPOSITIONS];

static void list_users(void)
{
    for (unsigned i = 0; i != USES; i++)
        node_users[uses[i].proposition] |= BIT(uses[i].user);
}

#else

static index_t node_users[PROPOSITIONS + 1], users[USES];

static void list_users(void)
{
    for (unsigned i = 0; i != USES; i++) {
        users[i] = uses[i].user;
        node_users[uses[i].proposition + 1] = (index_t)(i + 1);
    }
    for (unsigned node = 0; node != PROPOSITIONS; node++)
        if (node_users[node + 1] < node_users[node])
            node_users[node + 1] = node_users[node];
}

#endif

static const index_t guard_value[GUARDS] = {X,      Y,    Z,        LEAST,    RATE, CHANGE,
                                            MEDIAN, MEAN, LOW_PASS, QUOTIENT, SUM};
static const index_t covered_values[COVERED] = {Z};
static const index_t channel_guards[CHANNELS + 1] = {0, 6, 13};
static const index_t watching[13] = {0, 2, 4, 7, 9, 10, 1, 3, 5, 6, 8, 9, 10};
static const index_t guard_leaves[GUARDS + 1] = {0, 3, 5, 6, 8, 9, 10, 11, 12, 13, 14, 15};
static const index_t guard_limits[GUARDS + 1] = {0, 7, 11, 14, 18, 21, 24, 27, 30, 33, 36, 39};
static const limit limits[39] = {
    BELOW_ALL,
    {-1.0, X_INSIDE, TRUE, 4},
    {0.0, X_OUTSIDE, FALSE, 2},
    {0.5, X_ABOVE, TRUE, 0},
    {1.0, X_OUTSIDE, TRUE, -2},
    {2.0, X_INSIDE, FALSE, -4},
    ABOVE_ALL,
    BELOW_ALL,
    {0.0, Y_ABOVE, TRUE, 0},
    {1e300, Y_HUGE, TRUE, 0},
    ABOVE_ALL,
    BELOW_ALL,
    {0.0, Z_ABOVE, TRUE, 0},
    ABOVE_ALL,
    BELOW_ALL,
    {0.0, LEAST_ABOVE, TRUE, 0},
    {1e300, LEAST_HUGE, TRUE, 0},
    ABOVE_ALL,
    BELOW_ALL,
    {1e7, RATE_ABOVE, TRUE, 0},
    ABOVE_ALL,
    BELOW_ALL,
    {0.5, CHANGED, TRUE, 0},
    ABOVE_ALL,
    BELOW_ALL,
    {0.0, MEDIAN_ABOVE, TRUE, 0},
    ABOVE_ALL,
    BELOW_ALL,
    {0.5, MEAN_ABOVE, TRUE, 0},
    ABOVE_ALL,
    BELOW_ALL,
    {0.0, LOW_PASS_ABOVE, TRUE, 0},
    ABOVE_ALL,
    BELOW_ALL,
    {1.0, QUOTIENT_ABOVE, TRUE, 0},
    ABOVE_ALL,
    BELOW_ALL,
    {0.0, SUM_ABOVE, TRUE, 0},
    ABOVE_ALL,
};
static const unsigned char leaf_below[15] = {FALSE, TRUE}; /* and all others FALSE */

/* Rows of guards, then of oscillations: y. */
static const index_t row_blames[GUARDS + OSCILLATIONS + 1] = {0, 1, 1, 2, 2, 3, 3,
                                                              3, 4, 4, 5, 6, 6, 7};
static const index_t blames[7] = {X, Z, X, X, X, X, X};
static const index_t row_excuses[GUARDS + OSCILLATIONS + 1] = {0, 0, 1, 1, 2, 3,  4,
                                                               5, 6, 7, 8, 9, 10, 10};
static const index_t excuses[10] = {Y, LEAST, RATE, Y, MEDIAN, MEAN, LOW_PASS, Y, LEAST, Y};
static const bool is_of_list[10] = {false, true,  false, false, false,
                                    false, false, false, true,  false};

static const int64_t held_durations[HELD] = {300, 400, LONGEST - 1, 250, 200};
static const index_t held_nodes[HELD] = {ABOVE_HELD, OUTSIDE_HELD, HUGE_HELD, NESTED, SUM_HELD};
#if HELD_INITIALLY
static const unsigned char held_initially[HELD] = {FALSE, TRUE, FALSE, FALSE, FALSE};
#endif
static const int64_t age_limits[AGES] = {LONGEST - 1, 700, 1200};
static const index_t age_input[AGES] = {INPUT_X, INPUT_Y, INPUT_Z};
static const unsigned char age_unknown[AGES] = {STALE, UNKNOWN, STALE};
static const index_t age_leaf[AGES] = {AGE_X, AGE_Y, AGE_Z};
static const index_t recent_first[RECENT + 1] = {0, 2, 5, 7, 8};
static const int64_t recent_windows[RECENT] = {600, LONGEST - 1, 700, 100};
static const index_t recent_proposition[RECENT] = {SWING_Y, SWING_X, EDGES_X, EDGES_HELD};
static const index_t turn_value[OSCILLATIONS] = {Y, X};
static const double turn_swings[OSCILLATIONS] = {1.0, 0.5};
static const int64_t window_lengths[WINDOWS] = {800, 400};

static index_t literals[LITERALS];
static unsigned char literal_values[LITERALS];

static void list_literals(void)
{
    for (unsigned i = 0; i != LITERALS; i++) {
        literals[i] = (index_t)(ALWAYS + i);
        literal_values[i] = i == 1 ? FALSE : TRUE;
    }
}

static const index_t rule_condition[RULES] = {ABOVE_HELD, EITHER,   Y_SINCE_X, EDGES_X, MIXED,
                                              AGE_Y,      SUM_HELD, BOTH,      SWING_X, AGE_Z};
static const index_t rule_release[RULES] = {ALWAYS, LATCHED, ONCE,   NOT_INSIDE,
                                            ALWAYS, LATCHED, ALWAYS, NOT_INSIDE_SINCE_ONCE,
                                            ALWAYS, ALWAYS};
static const index_t rule_terms[RULES + 1] = {0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20};
static const index_t terms[20] = {X_ABOVE,    ABOVE_HELD, EITHER,   SWING_Y,   Y_SINCE_X,
                                  Y_ABOVE,    EDGES_X,    X_ABOVE,  MIXED,     CHANGED,
                                  AGE_Y,      ALWAYS,     SUM_HELD, SUM_ABOVE, BOTH,
                                  RATE_ABOVE, SWING_X,    NOT_EVER, AGE_Z,     Z_ABOVE};
static const index_t rule_values[RULES + 1] = {0, 1, 2, 3, 4, 5, 5, 7, 8, 9, 10};
static const index_t shown_values[10] = {X, QUOTIENT, Y, X, CHANGE, SUM, LEAST, RATE, X, Z};
static const index_t rule_inputs[RULES + 1] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
static const index_t shown_inputs[10] = {INPUT_X, INPUT_X, INPUT_Y, INPUT_X, INPUT_Y,
                                         INPUT_Y, INPUT_X, INPUT_X, INPUT_X, INPUT_Z};
static const index_t watched_propositions[WATCHES] = {SWING_Y, NESTED};

#endif
