/* Not inside if not finite. (Written so that each comparison needs one instruction.) */
INLINE bool is_inside(const monitor *m, unsigned g, double x)
{
    return !UNLIKELY(!(x > m->low[g])) && !UNLIKELY(x > m->high[g]);
}

/* Whether the value behind a guard is unknown for lack of an input with a timeout. */
static unsigned char unknown_kind(const monitor *m, unsigned g)
{
    for (unsigned i = guard_blames[g]; i != guard_blames[g + 1]; i++)
        if (isnan(m->value[blames[i]]))
            return LOST;
    return UNKNOWN;
}

RARE void lose_sight(monitor *m, unsigned g, int64_t t_ns)
{
    const unsigned char kind = unknown_kind(m, g);
    if (m->region[g] == -(int)kind)
        return;
    m->region[g] = -(int)kind;
    m->low[g] = INFINITY; /* nothing is inside */
    m->high[g] = -INFINITY;
    for (unsigned leaf = guard_leaves[g]; leaf != guard_leaves[g + 1]; leaf++)
        set_truth(m, leaf, kind, t_ns);
}

/* A number that was unknown is known: every truth starts below its limits. */
RARE void gain_sight(monitor *m, unsigned g, double x, int64_t t_ns)
{
    unsigned place = guard_limits[g];
    for (unsigned leaf = guard_leaves[g]; leaf != guard_leaves[g + 1]; leaf++)
        set_truth(m, leaf, leaf_below[leaf], t_ns);
    for (; place != guard_limits[g + 1] && x > limits[place]; place++)
        set_truth(m, limit_leaf[place], limit_above[place], t_ns);
    m->region[g] = (int)(place - guard_limits[g]);
}

/* A number crossed limits: flip the truths there, but for those with both their limits among them. */
static void flip(monitor *m, unsigned from, unsigned to, bool is_rising, int64_t t_ns)
{
    for (unsigned i = from; i != to; i++) {
        const bool has_twin_there = limit_twin[i] >= from && limit_twin[i] < to;
        if (!has_twin_there)
            set_truth(m, limit_leaf[i], limit_above[i] ^ (is_rising ? 0u : 1u), t_ns);
    }
}

/* A number left its guard. */
static void cross(monitor *m, unsigned g, double x, int64_t t_ns)
{
    const unsigned first = guard_limits[g], end = guard_limits[g + 1];
    const unsigned old = first + (unsigned)m->region[g];
    unsigned place = old;
    if (!isfinite(x)) {
        x = or_unknown(m, g);
        if (isnan(x)) {
            lose_sight(m, g, t_ns);
            return;
        }
    }
    if (m->region[g] < 0) {
        gain_sight(m, g, x, t_ns);
        place = first + (unsigned)m->region[g];
    } else if (place != end && x > limits[place]) {
        do
            place++;
        while (place != end && x > limits[place]);
        flip(m, old, place, true, t_ns);
    } else {
        while (place != first && x <= limits[place - 1])
            place--;
        flip(m, place, old, false, t_ns);
    }
    m->region[g] = (int)(place - first);
    m->low[g] = place == first ? -INFINITY : limits[place - 1];
    m->high[g] = place == end ? DBL_MAX : limits[place];
}

/* Look at all numbers again, after some of them were forgotten. */
static void review(monitor *m, int64_t t_ns)
{
    for (unsigned g = 0; g != GUARDS; g++)
        if (!is_inside(m, g, m->value[guard_value[g]]))
            cross(m, g, m->value[guard_value[g]], t_ns);
}
