"""Contracts that replace memories of poses, and parts of them, as C text."""

from __future__ import annotations

from rossmarie.verification.check import Parts

PARTS: Parts = (
    ("pose_record", "ignore_pose_record"),
    ("pose_wake", "same_wake"),
    ("pose_send", "room_for_poses"),
    ("pose_begin", "ignore_pose_begin"),
    ("pose_set_back", "ignore_pose_set_back"),
    ("pose_forget", "ignore_pose_forget"),
)
"""The contracts that replace the memories in checks of other functions."""

COMPARISON = """\
static bool is_same(const reactor *a, const reactor *b) { return is_same_byte(a, b); }
"""
"""The comparison of two reactors without poses."""

COMPARISON_WITH_POSES = """\
/* Compare poses as numbers, at arbitrary places: an unknown number has several bit patterns. Then
 * replace the poses by zeros, and compare the rest.
 */
static bool take_same_poses(reactor *a, reactor *b)
{
    const unsigned i = nondet_number() % (sizeof a->poses / sizeof a->poses[0]);
    const unsigned k = nondet_number() % (sizeof a->poses_sent / sizeof a->poses_sent[0]);
    const unsigned n = nondet_number() % MOST_NUMBERS;
    const bool are_same = spec_same(a->poses[i], b->poses[i])
        && spec_same(a->poses_sent[k][n], b->poses_sent[k][n]);
    __CPROVER_array_set(a->poses, 0.0);
    __CPROVER_array_set(b->poses, 0.0);
    __CPROVER_array_set(a->poses_sent, 0.0);
    __CPROVER_array_set(b->poses_sent, 0.0);
    return are_same;
}

static bool is_same(const reactor *a, const reactor *b)
{
    reactor one = *a, other = *b;
    const bool are_same = take_same_poses(&one, &other);
    return are_same && is_same_byte(&one, &other);
}
"""
"""The comparison of two reactors with poses."""

CONTRACTS = """\
static bool is_new[MEMORIES];
static double compared[MOST_NUMBERS];
static const double *compared_to;
static int64_t compared_ns;

bool note_compared(unsigned k, const double *pose, const double *last, int64_t age_ns)
{{
    for (unsigned n = 0; n != MOST_NUMBERS; n++)
        compared[n] = last[n];
    compared_to = pose;
    compared_ns = age_ns;
    return is_new[k];
}}

bool any_new_pose(const reactor *r, unsigned k, const double *pose)
{{
    (void)r;
    (void)pose;
    return is_new[k];
}}

static double read[{readings}];

static void any_readings(void)
{{
    for (unsigned i = 0; i != {readings}; i++)
        read[i] = nondet_double();
}}

double {name}_reading(const {name}_monitor *m, int reading)
{{
    (void)m;
    __CPROVER_assert(reading >= 0 && reading < {readings}, "the reading exists");
    return read[reading];
}}

static void suppose_poses(const reactor *r)
{{
{suppose}
}}

static void must_be_poses(const reactor *r)
{{
{must}
}}

void ignore_pose_record(reactor *r, const {name}_monitor *m)
{{
    (void)r;
    (void)m;
}}

int64_t same_wake(const reactor *r, int64_t wake_ns)
{{
    (void)r;
    return wake_ns;
}}

void room_for_poses(reactor *r)
{{
{room}
}}

void ignore_pose_begin(reactor *r, unsigned task)
{{
    (void)r;
    (void)task;
}}

void ignore_pose_set_back(reactor *r, int64_t t_ns)
{{
    (void)r;
    (void)t_ns;
}}

void ignore_pose_forget(reactor *r) {{ (void)r; }}

/* The contract of `decide`. */
void note_sent(reactor *r, unsigned task, unsigned command, int32_t by_rule)
{{
    (void)r;
    __CPROVER_assert(task < TASKS, "the task of a task command exists");
    __CPROVER_assert(command == {name}_RETRACE && by_rule == -1,
        "the task command sends a pose");
    reported.count[task]++;
}}
"""
