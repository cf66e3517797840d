/* `operand for duration`: true once the operand has been true that long; until then what the operand
 * was before. (Next to no branches: whether an operand rose or fell is badly predictable.)
 */
static unsigned char held(monitor *m, unsigned k, unsigned char operand, int64_t t_ns)
{
    const bool has_begun = m->held_due_ns[k] != NEVER;
    const int64_t due_ns = has_begun ? m->held_due_ns[k] : t_ns + held_durations[k];
    m->held_due_ns[k] = operand == TRUE ? due_ns : NEVER;
    m->held_before[k] = operand == TRUE ? m->held_before[k] : operand;
    wake_by(m, m->held_due_ns[k]);
    return operand == TRUE && t_ns >= due_ns ? (unsigned char)TRUE : m->held_before[k];
}
