/* Guards for policies: the monitor processes an observation, then the reactor runs, and then the
 * bounds of the reactor change the action. The functions work on one guard or on an array of
 * guards.
 *
 * This file is compiled together with host.c and guard.c.
 */
#include "batch.c"

#include "guard.c"

/* The mapping of numbers of observations and actions to fields of messages. A field has `count`
 * numbers, at the indexes first, first + step, and so on. A scalar has one number, or none if it is
 * missing. A number x stands for x * scale + offset in the unit of the message.
 */
typedef struct guard_part {
    int64_t first;
    int64_t step;
    size_t count;
    double scale;
    double offset;
    int32_t is_flag;
    int32_t command; /* for a part of an action */
    int32_t field;
    int32_t unused;
} guard_part;

/* A command that a task publishes instead of an action: the numbers of all its parts. */
typedef struct guard_publication {
    int32_t task;
    int32_t command;
    int32_t lasts; /* 0 if it replaces only one action */
    int32_t first; /* its first number in `published` */
} guard_publication;

typedef struct guard_wiring {
    size_t observed; /* the length of an observation; `acted` is that of an action */
    size_t acted;
    size_t slot_count;
    size_t array_count;
    size_t part_count;
    size_t publication_count;
    const unsigned char *present; /* the channels that arrive with each observation */
    const guard_part *slots;
    const guard_part *arrays;
    const int32_t *clouds; /* for each array, the cloud of which it is a column, or -1 */
    const unsigned char *is_axis;
    const guard_part *parts; /* of actions, command by command */
    const guard_publication *publications;
    const double *published;
    double *slot_room;
    double *element_room;
    double **array_room;
    size_t *count_room;
    double *bound_room;
    double *action_room;
} guard_wiring;

/* The bits of the result of guard_step. */
enum { GUARD_CHANGED = 1, GUARD_REFUSED = 2, GUARD_REPORTED = 4, GUARD_CLOSED = 8 };

static double of_message(const guard_part *part, double x)
{
    if (part->is_flag)
        return isfinite(x) ? (double)(x != 0.0) : NAN;
    return part->scale == 1.0 && part->offset == 0.0 ? x : x * part->scale + part->offset;
}

static double of_action(const guard_part *part, double value)
{
    const bool is_same = part->scale == 1.0 && part->offset == 0.0;
    return is_same ? value : (value - part->offset) / part->scale;
}

/* Returns true if a point of a cloud has a position: none of its coordinates is unknown. */
static bool has_place(const guard_wiring *w, int32_t cloud, size_t point)
{
    for (size_t i = 0; i != w->array_count; i++)
        if (w->clouds[i] == cloud && w->is_axis[i] && isnan(w->array_room[i][point]))
            return false;
    return true;
}

/* Removes the points without a position from a cloud. `first` is the first column of the cloud. */
static void leave_out(const guard_wiring *w, size_t first)
{
    const int32_t cloud = w->clouds[first];
    const size_t given = w->count_room[first];
    size_t count = 0;
    for (size_t point = 0; point != given; point++) {
        if (!has_place(w, cloud, point))
            continue;
        for (size_t i = first; i != w->array_count; i++)
            if (w->clouds[i] == cloud)
                w->array_room[i][count] = w->array_room[i][point];
        count++;
    }
    for (size_t i = first; i != w->array_count; i++)
        if (w->clouds[i] == cloud)
            w->count_room[i] = count;
}

static int take_observation(host *h, const guard_wiring *w, int64_t t_ns, const double *observation)
{
    double *elements = w->element_room;
    for (size_t i = 0; i != w->slot_count; i++) {
        const guard_part *part = &w->slots[i];
        w->slot_room[i] = part->count ? of_message(part, observation[part->first]) : NAN;
    }
    for (size_t i = 0; i != w->array_count; i++) {
        const guard_part *part = &w->arrays[i];
        w->array_room[i] = elements;
        w->count_room[i] = part->count;
        for (size_t k = 0; k != part->count; k++)
            *elements++ = of_message(part, observation[part->first + (int64_t)k * part->step]);
    }
    for (size_t i = 0; i != w->array_count; i++)
        if (w->clouds[i] >= 0 && (i == 0 || w->clouds[i] != w->clouds[i - 1]))
            leave_out(w, i);
    return host_step(h, t_ns, w->present, w->slot_room, (const double *const *)w->array_room,
                     w->count_room);
}

/* Returns true if a task publishes instead of this action: the task is in force, or it has just
 * started. In the second case, the log contains a task command that the host has not taken yet.
 */
static bool publishes(const host *h, const guard_publication *one)
{
    const guard *g = guard_of(h);
    if (one->lasts)
        return guard_task_state(h, one->task) == GUARD_HOLDING;
    for (size_t i = 0; i != g->count; i++)
        if (g->task_commands[i].task == one->task && g->task_commands[i].command == GUARD_START)
            return true;
    return false;
}

/* Returns true if all numbers of an action that belong to commands are finite. */
static bool is_finite(const guard_wiring *w, const double *action)
{
    for (size_t i = 0; i != w->part_count; i++)
        for (size_t k = 0; k != w->parts[i].count; k++)
            if (!isfinite(of_message(&w->parts[i],
                                     action[w->parts[i].first + (int64_t)k * w->parts[i].step])))
                return false;
    return true;
}

/* Returns true if the bounds change no number. */
static bool are_free(const double *bounds, size_t count)
{
    for (size_t i = 0; i != count; i++)
        if (bounds[3 * i] != 1.0 || bounds[3 * i + 1] != -INFINITY || bounds[3 * i + 2] != INFINITY)
            return false;
    return true;
}

/* Bounds the parts of one command, from `first` to `end` - 1. If any number of the command is not
 * finite, sets all numbers of the command to 0. Returns bits of guard_step.
 */
static int bound_parts(const host *h, const guard_wiring *w, int64_t t_ns, size_t first, size_t end,
                       const double *published, double *action)
{
    int said = 0;
    const double *numbers = published;
    guard_bounds(h, t_ns, w->parts[first].command, w->bound_room);
    for (size_t i = first; i != end; i++) {
        const guard_part *part = &w->parts[i];
        for (size_t k = 0; k != part->count; k++) {
            const double x = published
                                 ? *numbers++
                                 : of_message(part, action[part->first + (int64_t)k * part->step]);
            if (!isfinite(x))
                said |= GUARD_REFUSED;
        }
    }
    numbers = published;
    for (size_t i = first; i != end; i++) {
        const guard_part *part = &w->parts[i];
        for (size_t k = 0; k != part->count; k++) {
            double *place = &action[part->first + (int64_t)k * part->step];
            const double given = of_message(part, *place);
            const double wanted = published ? *numbers++ : given;
            const double bounded =
                said & GUARD_REFUSED ? 0.0 : guard_bounded(w->bound_room + 3 * part->field, wanted);
            if (bounded != given) {
                *place = of_action(part, bounded);
                said |= GUARD_CHANGED;
            }
        }
    }
    return said;
}

/* Returns true if a guard accepts an instant: it is in range, and time does not go backwards. */
static bool can_be_at(const host *h, int64_t t_ns)
{
    return t_ns > -(INT64_C(1) << 61) && t_ns < INT64_C(1) << 62 &&
           !(h->machine.started && t_ns < h->machine.now_ns);
}

/* Processes an observation, and runs the reactor. Returns 0, or -1 if the observation is refused.
 */
static int observe(host *h, const guard_wiring *w, int64_t t_ns, const double *observation)
{
    if (take_observation(h, w, t_ns, observation) < 0)
        return -1;
    guard_follow(h, t_ns);
    if (!guard_of(h)->is_open && guard_has_all_inputs(h))
        guard_open(h);
    return 0;
}

/* Changes an action into a permitted action at this instant. Returns bits of guard_step. */
static int decide(host *h, const guard_wiring *w, int64_t t_ns, double *action)
{
    int said = 0;
    bool is_free = true;
    if (guard_of(h)->is_free && is_finite(w, action))
        return 0;
    for (size_t first = 0, end = 0; first != w->part_count; first = end) {
        const double *published = NULL;
        while (end != w->part_count && w->parts[end].command == w->parts[first].command)
            end++;
        for (size_t i = 0; i != w->publication_count; i++) {
            const guard_publication *one = &w->publications[i];
            if (one->command == w->parts[first].command && publishes(h, one))
                published = w->published + one->first;
        }
        said |= bound_parts(h, w, t_ns, first, end, published, action);
        is_free =
            is_free && !published && are_free(w->bound_room, (size_t)w->parts[end - 1].field + 1);
    }
    guard_of(h)->is_free = is_free && guard_of(h)->count == 0;
    return said;
}

/* Performs a step: processes an observation, then changes an action into a permitted action.
 * `observation` may be NULL: then the last observation and its instant are used. `action` may be
 * NULL: then only the observation is processed. Returns bits, or -1 if the guard refuses the
 * instant. Then the guard has not changed.
 */
int guard_step(host *h, const guard_wiring *w, int64_t t_ns, const double *observation,
               double *action)
{
    int said = 0;
    if (!can_be_at(h, t_ns) || (!observation && !h->machine.started))
        return -1;
    if (observation && observe(h, w, t_ns, observation) < 0)
        return -1;
    if (action)
        said = decide(h, w, t_ns, action);
    said |= guard_of(h)->is_open ? 0 : GUARD_CLOSED;
    return said | (h->count || guard_of(h)->count ? GUARD_REPORTED : 0);
}

/* --- many guards --------------------------------------------------------------------------- */

/* Writes the margins of each guard into its row of GUARD_MARGINS numbers, in SI units; NaN before
 * the first observation.
 */
void guards_margins(const host *first, size_t count, double *margins)
{
    for (size_t i = 0; i != count; i++)
        guard_margins(&(guard_of(first) + i)->base, margins + i * GUARD_MARGINS);
}

/* Returns an array of `count` guards in their initial state, or NULL if there is not enough memory.
 */
host *guards_new(size_t count)
{
    guard *guards = (guard *)calloc(count, sizeof *guards);
    for (size_t i = 0; guards && i != count; i++)
        guard_restart(&guards[i].base);
    return guards ? &guards->base : NULL;
}

void guards_free(host *first, size_t count)
{
    guard *guards = guard_of(first);
    for (size_t i = 0; i != count; i++) {
        free(guards[i].task_commands);
        free(guards[i].base.events);
    }
    free(guards);
}

host *guards_at(host *first, size_t index) { return &(guard_of(first) + index)->base; }

/* Restores the initial state of each guard whose byte in `which` is not 0. */
void guards_restart(host *first, size_t count, const unsigned char *which)
{
    for (size_t i = 0; i != count; i++)
        if (which[i])
            guard_restart(guards_at(first, i));
}

/* Performs a step of each guard with its row of the arrays.
 * - which: NULL, or a byte for each guard; a guard whose byte is 0 does no step.
 * - times: NULL, or instants in ns that are time_step entries apart. Without `times`, each guard
 *   stays at its current instant.
 * - observations, actions: NULL, or the arrays of guard_step.
 * - active: room for a byte for each rule of each guard, 1 if the rule is active.
 * - changed: room for a byte for each guard, 1 if its action was changed.
 *
 * The step removes the events from the logs, and after an action also the task commands. Returns
 * `count`, or the first guard that does not accept its instant. Then no guard has changed.
 */
size_t guards_step(host *first, size_t count, const guard_wiring *w, const unsigned char *which,
                   const int64_t *times, size_t time_step, const double *observations,
                   double *actions, unsigned char *active, unsigned char *changed)
{
    for (size_t i = 0; i != count; i++) {
        const host *h = guards_at(first, i);
        if (which && !which[i])
            continue;
        if (times ? !can_be_at(h, times[i * time_step]) : !h->machine.started)
            return i;
    }
    for (size_t i = 0; i != count; i++) {
        host *h = guards_at(first, i);
        changed[i] = 0;
        if (!which || which[i]) {
            const int64_t t_ns = times ? times[i * time_step] : h->machine.now_ns;
            const int said =
                guard_step(h, w, t_ns, observations ? observations + i * w->observed : NULL,
                           actions ? actions + i * w->acted : NULL);
            changed[i] = (said & GUARD_CHANGED) != 0;
            h->count = 0;
            if (actions)
                guard_of(h)->count = 0;
        }
        for (size_t rule = 0; rule != GUARD_RULES; rule++)
            *active++ = h->machine.active[rule / 8] >> rule % 8 & 1;
    }
    return count;
}

/* Tests which actions each guard would leave unchanged. `allowed` has room for a byte for each
 * action, guard by guard. Returns `count`, or the first guard without an observation.
 */
size_t guards_allow(host *first, size_t count, const guard_wiring *w, const double *actions,
                    size_t action_count, unsigned char *allowed)
{
    for (size_t i = 0; i != count; i++) {
        host *h = guards_at(first, i);
        if (!h->machine.started)
            return i;
        for (size_t k = 0; k != action_count; k++) {
            for (size_t n = 0; n != w->acted; n++)
                w->action_room[n] = actions[k * w->acted + n];
            *allowed++ = decide(h, w, h->machine.now_ns, w->action_room) == 0;
        }
    }
    return count;
}
