/* A timer was started. `wake_ns` is never later than the earliest timer; it may be earlier. */
static void wake_by(monitor *m, int64_t due_ns)
{
    if (due_ns < m->wake_ns)
        m->wake_ns = due_ns;
}
