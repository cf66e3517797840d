/* Part of ROSSMARie, the same for all rules. */

/* Memories of poses (R16, R17 of the reactions). The reactor records poses while no engaged rule
 * retraces the memory. A retrace sends the newest pose first.
 */

#if RETRACES

/* Returns the index of pose i of memory k in the array of all poses. Pose 0 is the oldest. */
static unsigned pose_place(const reactor *r, unsigned k, unsigned i)
{
    return memories[k].first + (r->poses_oldest[k] + i) % memories[k].most * memories[k].numbers;
}

static bool is_known_pose(unsigned k, const double *pose)
{
    for (unsigned i = 0; i != memories[k].numbers; i++)
        if (!isfinite(pose[i]))
            return false;
    return true;
}

/* Returns true if a pose differs enough from the last pose. `age_ns` is the time since the last
 * recording.
 */
static bool is_apart(unsigned k, const double *pose, const double *last, int64_t age_ns)
{
    const double x = pose[0] - last[0];
    const double y = pose[1] - last[1];
    const double z = pose[2] - last[2];
    bool differs = false;
    for (unsigned i = 0; i != memories[k].numbers; i++)
        differs = differs || pose[i] != last[i];
    return differs && x * x + y * y + z * z >= memories[k].pose_gap * memories[k].pose_gap &&
           age_ns >= memories[k].pose_gap_ns;
}

/* Returns true if a pose differs enough from the newest pose in the memory, or if the memory is
 * empty.
 */
static bool is_new_pose(const reactor *r, unsigned k, const double *pose)
{
    double last[MOST_NUMBERS] = {0.0};
    unsigned place = 0;
    if (r->poses_kept[k] == 0)
        return true;
    place = pose_place(r, k, r->poses_kept[k] - 1u);
    for (unsigned i = 0; i != memories[k].numbers; i++)
        last[i] = r->poses[place + i];
    return is_apart(k, pose, last, r->now_ns - r->pose_recorded_ns[k]);
}

/* Records the current pose of each memory. In a full memory, the new pose replaces the oldest pose.
 */
static void pose_record(reactor *r, const NAMED(monitor) * m)
{
    for (unsigned k = 0; k != MEMORIES; k++) {
        double pose[MOST_NUMBERS] = {0.0};
        bool is_used = false;
        unsigned place = 0;
        for (unsigned i = pose_rules[k]; i != pose_rules[k + 1]; i++)
            is_used = is_used || r->engaged[pose_users[i]];
        for (unsigned i = 0; i != memories[k].numbers; i++)
            pose[i] = NAMED(reading)(m, (int)pose_readings[memories[k].reading + i]);
        r->poses_known[k] = is_known_pose(k, pose);
        if (is_used || !r->poses_known[k] || !is_new_pose(r, k, pose))
            continue;
        if (r->poses_kept[k] == memories[k].most) {
            r->poses_oldest[k] = (index_t)((r->poses_oldest[k] + 1u) % memories[k].most);
            r->poses_kept[k]--;
        }
        place = pose_place(r, k, r->poses_kept[k]);
        for (unsigned i = 0; i != memories[k].numbers; i++)
            r->poses[place + i] = pose[i];
        r->poses_kept[k]++;
        r->pose_recorded_ns[k] = r->now_ns;
    }
}

/* Returns the instant from which a task may send its next pose. Returns NEVER if the memory is
 * empty, the current pose is unknown, or the task is not HOLDING.
 */
static int64_t pose_due(const reactor *r, unsigned i)
{
    const unsigned k = retraces[i].memory;
    if (r->state[retraces[i].task] != HOLDING || r->poses_kept[k] == 0 || !r->poses_known[k])
        return NEVER;
    return r->pose_sent_ns[i] == NEVER ? EARLIEST : r->pose_sent_ns[i] + retraces[i].pose_period_ns;
}

/* Returns the earlier of wake_ns and the earliest future instant at which a task sends a pose. */
static int64_t pose_wake(const reactor *r, int64_t wake_ns)
{
    for (unsigned i = 0; i != RETRACES; i++)
        if (pose_due(r, i) > r->now_ns && pose_due(r, i) < wake_ns)
            wake_ns = pose_due(r, i);
    return wake_ns;
}

/* Gives the task command RETRACE to each task whose next pose is due. A memory forgets a pose that
 * is sent.
 */
static void pose_send(reactor *r)
{
    for (unsigned i = 0; i != RETRACES; i++) {
        const unsigned k = retraces[i].memory;
        unsigned place = 0;
        if (pose_due(r, i) > r->now_ns)
            continue;
        r->poses_kept[k]--;
        place = pose_place(r, k, r->poses_kept[k]);
        for (unsigned n = 0; n != memories[k].numbers; n++)
            r->poses_sent[i][n] = r->poses[place + n];
        r->pose_sent_ns[i] = r->now_ns;
        decide(r, retraces[i].task, NAMED(RETRACE), -1);
    }
}

/* Lets a task that starts send its first pose at once. */
static void pose_begin(reactor *r, unsigned task)
{
    for (unsigned i = 0; i != RETRACES; i++)
        if (retraces[i].task == task)
            r->pose_sent_ns[i] = NEVER;
}

/* Returns an instant that has the same age before t_ns as since_ns has before now_ns, at most
 * LONGEST.
 */
static int64_t set_back(int64_t since_ns, int64_t now_ns, int64_t t_ns)
{
    int64_t age_ns = 0;
    if (since_ns == NEVER)
        return NEVER;
    age_ns = now_ns - since_ns;
    return t_ns - (age_ns < LONGEST ? age_ns : LONGEST);
}

static void pose_set_back(reactor *r, int64_t t_ns)
{
    for (unsigned i = 0; i != RETRACES; i++)
        r->pose_sent_ns[i] = set_back(r->pose_sent_ns[i], r->now_ns, t_ns);
    for (unsigned k = 0; k != MEMORIES; k++)
        r->pose_recorded_ns[k] = set_back(r->pose_recorded_ns[k], r->now_ns, t_ns);
}

static void pose_forget(reactor *r)
{
    for (unsigned i = 0; i != RETRACES; i++)
        r->pose_sent_ns[i] = NEVER;
    for (unsigned k = 0; k != MEMORIES; k++)
        r->pose_recorded_ns[k] = NEVER;
}

int NAMED(retraced)(const reactor *r, int task, double pose[])
{
    for (unsigned i = 0; i != RETRACES; i++) {
        const unsigned numbers = memories[retraces[i].memory].numbers;
        if ((int)retraces[i].task == task) {
            memcpy(pose, r->poses_sent[i], numbers * sizeof *pose);
            return (int)numbers;
        }
    }
    return 0;
}

#endif
