/* Part of ROSSMARie, the same for all rules. */

/* The words in which the tables of a reactor are written. */
#ifndef ROSSMARIE_PLANS_H
#define ROSSMARIE_PLANS_H

/* Parts that these rules do not use. */
#ifndef COMMANDS
#define COMMANDS 0
#endif
#ifndef SCALES
#define SCALES 0
#endif
#ifndef CONFIRMED
#define CONFIRMED 0
#endif
#ifndef ESCALATIONS
#define ESCALATIONS 0
#endif
#ifndef RETRACES
#define RETRACES 0
#endif
#ifndef YIELDING
#define YIELDING 0
#endif

#include <stdbool.h>
#include <string.h>

#include "instants.h"

#if COMMANDS || RETRACES
#include "binary64.h"
#endif

enum {
    IDLE = NAMED(TASK_IDLE),
    RUNNING = NAMED(TASK_RUNNING),
    HOLDING = NAMED(TASK_HOLDING),
    WAITING = NAMED(TASK_WAITING),
    DONE = NAMED(TASK_DONE),
    FAILED = NAMED(TASK_FAILED),
    OVERDUE = NAMED(TASK_OVERDUE)
};

/* A task: the rule whose it is; how long its end is awaited (0: it is not), and its state then;
 * whether it waits while another rule has what it needs, and whether it fails at once then; what it
 * needs; what it does to that, as a number, and the same if its rule does nothing else to it; the
 * condition that confirms its end. NONE is nothing of each.
 */
typedef struct plan {
    index_t rule;
    int64_t timeout_ns;
    unsigned char end;
    bool waits;
    bool fails_at_once;
    index_t resource;
    index_t deed;
    index_t answer;
    index_t watch;
} plan;

/* What a task does to a field of a command while it is in force: the number is at least and at most
 * this; and by how much that fades in a second when it is not in force (0: at once).
 */
typedef struct bound {
    index_t task;
    index_t field;
    double low;
    double high;
    double ramp;
} bound;

/* A memory: where its poses begin among the numbers of all, and its readings among those of all;
 * how many poses it keeps at most, and how many numbers each has; how far a pose has to be from the
 * one before it, in m and in ns.
 */
typedef struct memory {
    unsigned first;
    unsigned reading;
    unsigned most;
    unsigned numbers;
    double pose_gap;
    int64_t pose_gap_ns;
} memory;

/* A task that sends the poses of a memory, one in each period. */
typedef struct retrace {
    index_t task;
    index_t memory;
    int64_t pose_period_ns;
} retrace;

/* By what a task multiplies all fields of a command, and how that fades. */
typedef struct scale {
    index_t task;
    double factor;
    double ramp;
} scale;

#endif
