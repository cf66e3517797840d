static void turn(monitor *m, unsigned k, signed char heading, double x, int64_t t_ns)
{
    const unsigned count = turn_first[k + 1] - turn_first[k];
    if (m->heading[k] != 0) {
        m->turn_ns[turn_first[k] + m->turn_next[k]] = t_ns;
        m->turn_next[k] = (index_t)((m->turn_next[k] + 1u) % count);
        if (m->turns[k] != count)
            m->turns[k]++;
    }
    m->heading[k] = heading;
    m->extreme[k] = x;
}

/* A sample of a number that may swing. */
static void follow(monitor *m, unsigned k, int64_t t_ns)
{
    const double x = m->value[turn_value[k]], swing = turn_swings[k], extreme = m->extreme[k];
    const int heading = m->heading[k];
    if (isfinite(x)) {
        if (isnan(extreme) || (heading > 0 && x > extreme) || (heading < 0 && x < extreme))
            m->extreme[k] = x;
        else if (heading <= 0 && x > extreme + swing)
            turn(m, k, 1, x, t_ns);
        else if (heading >= 0 && x < extreme - swing)
            turn(m, k, -1, x, t_ns);
    }
    look_at_swings(m, k, t_ns);
}
