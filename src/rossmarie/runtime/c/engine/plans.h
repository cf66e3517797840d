/* Part of ROSSMARie, the same for all rules. */

/* The types of the tables of a reactor. */
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

/* A task: its rule; the time for which its end is awaited (0: not at all), and its state then;
 * whether it waits while another rule has its resource, and whether it fails at once then; its
 * resource; its deed on the resource, as a number, and the same if its rule has no other deed on
 * it; the condition that confirms its end. NONE means that there is none.
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

/* The bounds of a task on a field of a command while the task is in force: the least and the
 * greatest number; and the speed at which the bounds open afterwards, per second (0: at once).
 */
typedef struct bound {
    index_t task;
    index_t field;
    double low;
    double high;
    double ramp;
} bound;

/* A memory: the index of its first number among all poses, and of its first reading among all
 * readings; its greatest number of poses, and the count of numbers in each; the least distance of a
 * pose from the one before it, in m and in ns.
 */
typedef struct memory {
    unsigned first;
    unsigned reading;
    unsigned most;
    unsigned numbers;
    double pose_gap;
    int64_t pose_gap_ns;
} memory;

/* A task that sends the poses of a memory, one per period. */
typedef struct retrace {
    index_t task;
    index_t memory;
    int64_t pose_period_ns;
} retrace;

/* The factor of a task on all fields of a command, and the speed at which it returns to 1. */
typedef struct scale {
    index_t task;
    double factor;
    double ramp;
} scale;

#endif
