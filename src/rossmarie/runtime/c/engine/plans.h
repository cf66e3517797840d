/* Part of ROSSMARie, the same for all rules. */

/* The types of the tables of a reactor. */
#ifndef ROSSMARIE_PLANS_H
#define ROSSMARIE_PLANS_H

/* Sizes of the parts that these rules do not use. */
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

/* A task of the plan of a rule. NONE stands for a missing index.
 * - rule: the rule of the task.
 * - timeout_ns: the time within which the task must end, in ns; 0 if the reactor does not await the
 *   end.
 * - end: the state of the task after its end, HOLDING or DONE.
 * - waits: true if the task waits while another rule owns its resource.
 * - fails_at_once: true if the task fails as soon as it waits.
 * - resource: the resource that the task needs.
 * - deed: a number for the use of the resource. Tasks with the same use have the same number.
 * - answer: the same number if the rule uses the resource in no other way, else NONE.
 * - watch: the condition that confirms the end of the task.
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

/* The bounds of a task on a field of a command while the task is in force. low and high are the
 * least and the greatest permitted number. ramp is the rate per second at which the bounds open
 * after the release of the task; 0 opens the bounds at once.
 */
typedef struct bound {
    index_t task;
    index_t field;
    double low;
    double high;
    double ramp;
} bound;

/* A memory of poses.
 * - first: the index of its first number in the array of all poses.
 * - reading: the index of its first reading in pose_readings.
 * - most: the greatest number of poses.
 * - numbers: the count of numbers in each pose.
 * - pose_gap, pose_gap_ns: the least distance from the previous pose, in m and in ns.
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

/* The factor of a task on all fields of a command. After the release of the task, the factor
 * returns to 1 at `ramp` per second; 0 restores 1 at once.
 */
typedef struct scale {
    index_t task;
    double factor;
    double ramp;
} scale;

#endif
