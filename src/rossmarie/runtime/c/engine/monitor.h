/* Part of ROSSMARie, the same for all rules. */

/* The engine of a monitor. The generated file NAME_monitor.c includes this file. Before the
 * include, the generated file defines the sizes and the tables in the types of tables.h. After the
 * include, it defines the functions that evaluate conditions and store the numbers of messages. The
 * compiler therefore compiles the engine for the tables of one monitor. Include the engine of only
 * one monitor in a file.
 *
 * Each value that a condition compares has a guard. The guard is the range around the current value
 * in which none of its comparisons changes. If all values of a message stay inside their guards,
 * the engine checks only these values. A value that leaves its guard crosses one or more limits.
 * This changes the propositions at these limits. The engine then evaluates, in order, only the
 * nodes that depend on these propositions.
 *
 * Numbers such as S30 in comments refer to the rules of the semantics of ROSSMARie.
 */
#ifdef ROSSMARIE_MONITOR
#error "include the engine of only one monitor in a file"
#endif
#define ROSSMARIE_MONITOR

#include "absent.h"

#include "propositions.h"

#include "numbers.h"

#include "functions.h"

#include "timers.h"

#include "limits.h"

#include "samples.h"

#include "recent.h"

#include "oscillations.h"

#include "rules.h"

#include "evaluation.h"

#include "messages.h"

/* Computes the values that depend only on constants. The generated file defines this function. */
static void set_constants(monitor *m);

const char *NAMED(init)(monitor *m, NAMED(callback) on_event, void *user)
{
    memset(m, 0, sizeof *m);
    m->on_event = on_event;
    m->user = user;
    m->wake_ns = INT64_MIN;
    for (unsigned i = 0; i != VALUES; i++)
        m->value[i] = NAN;
    set_constants(m);
    return arithmetic_fault();
}

int NAMED(advance)(monitor *m, int64_t t_ns)
{
    int events = catch_up(m, t_ns);
    if (events < 0)
        return events;
    tick(m, t_ns);
#if GUARDS && BESIDE
    review(m, t_ns);
#endif
    if (is_pending(m))
        events += evaluate(m, t_ns);
    m->now_ns = t_ns;
    set_wake(m);
    return events;
}

int NAMED(reset)(monitor *m, int64_t t_ns, int rule)
{
    int events = NAMED(advance)(m, t_ns);
    if (events < 0)
        return events;
    for (unsigned i = 0; i != RULES; i++)
        if ((rule < 0 || (unsigned)rule == i) && rule_release[i] == LATCHED && is_active(m, i) &&
            m->truth_value[rule_condition[i]] == FALSE)
            events += change_rule(m, i, NAMED(CLEARED), t_ns);
    return events;
}

int64_t NAMED(next_wake)(const monitor *m) { return m->started ? earliest_timer(m) : NEVER; }

bool NAMED(is_active)(const monitor *m, int rule)
{
    return rule >= 0 && rule < (int)RULES && is_active(m, (unsigned)rule);
}

void NAMED(latch)(monitor *m, int rule)
{
    if (!m->started && rule >= 0 && rule < (int)RULES && rule_release[rule] == LATCHED)
        m->active[rule / 8] = (unsigned char)(m->active[rule / 8] | 1u << (rule % 8));
}

int NAMED(input_state)(const monitor *m, int input)
{
    return input >= 0 && input < (int)INPUTS ? m->state[input] : (int)NEVER_RECEIVED;
}

bool NAMED(has_all_inputs)(const monitor *m)
{
#if TIMEOUTS
    for (unsigned i = 0; i != INPUTS; i++)
        if (m->state[i] == NEVER_RECEIVED && input_timeouts[i] != 0)
            return false;
#endif
    (void)m;
    return true;
}

#if READINGS

double NAMED(reading)(const monitor *m, int reading)
{
    if (!m->started || reading < 0 || reading >= (int)READINGS)
        return NAN;
    return m->value[watched_values[reading]];
}

#endif

#if WATCHES

enum NAMED(truth_value) NAMED(watch)(const monitor *m, int watch)
{
    if (!m->started || watch < 0 || watch >= (int)WATCHES)
        return NAMED(UNKNOWN);
    return (enum NAMED(truth_value))m->truth_value[watched_propositions[watch]];
}

#endif
