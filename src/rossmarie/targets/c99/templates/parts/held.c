/* `operand for duration`: true once the operand has been true that long; until then what the operand
 * was before. (Next to no branches: whether an operand rose or fell is badly predictable.)
 */
static unsigned char held(monitor *m, unsigned k, unsigned node, int64_t t_ns)
{
    const unsigned char operand = m->truth[node];
    const int64_t due_ns = m->since_ns[node] + held_durations[k];
    m->held_due_ns[k] = operand == TRUE ? due_ns : NEVER;
    m->held_before[k] = operand == TRUE ? m->held_before[k] : operand;
    wake_by(m, m->held_due_ns[k]);
    return operand == TRUE && t_ns >= due_ns ? (unsigned char)TRUE : m->held_before[k];
}
