/* Numbers that are kept as they arrive while they are inside their guards: one is not finite. */
RARE double or_unknown(monitor *m, unsigned g)
{
    for (unsigned i = 0; i != COVERED; i++)
        m->value[covered_values[i]] = known(m->value[covered_values[i]]);
    return m->value[guard_value[g]];
}
