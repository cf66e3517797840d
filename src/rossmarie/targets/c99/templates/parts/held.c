/* `operand for duration`: true once the operand has been true that long. */
static unsigned char held(monitor *m, unsigned k, unsigned char operand, int64_t t_ns)
{
    if (operand != TRUE) {
        m->held_due_ns[k] = NEVER;
        return operand;
    }
    if (m->held_due_ns[k] == NEVER) {
        m->held_due_ns[k] = t_ns + held_durations[k];
        wake_by(m, m->held_due_ns[k]);
    }
    return t_ns >= m->held_due_ns[k] ? TRUE : FALSE;
}
