/* A new value of a truth that looks at numbers or at the clock. */
static void set_leaf(monitor *m, unsigned leaf, unsigned char value)
{
    m->fresh[leaf] = value;
    mark(m, leaf);
}

/* Not inside if not finite. (Written so that each comparison needs one instruction.) */
static bool is_inside(const monitor *m, unsigned g, double x)
{
    return x > m->low[g] && !(x > m->high[g]);
}

/* Whether the value behind a guard is unknown for lack of an input with a timeout. */
static unsigned char unknown_kind(const monitor *m, unsigned g)
{
    for (unsigned i = guard_blames[g]; i != guard_blames[g + 1]; i++)
        if (isnan(m->value[blames[i]]))
            return LOST;
    return UNKNOWN;
}

static void lose_sight(monitor *m, unsigned g)
{
    const unsigned char kind = unknown_kind(m, g);
    if (m->region[g] == -(int)kind)
        return;
    m->region[g] = -(int)kind;
    m->low[g] = INFINITY; /* nothing is inside */
    m->high[g] = -INFINITY;
    for (unsigned leaf = guard_leaves[g]; leaf != guard_leaves[g + 1]; leaf++)
        set_leaf(m, leaf, kind);
}

/* A number left its guard: flip the truths at every limit between its old place and its new one. */
static void cross(monitor *m, unsigned g, double x)
{
    const unsigned first = guard_limits[g], end = guard_limits[g + 1];
    unsigned place = first;
    if (isnan(x)) {
        lose_sight(m, g);
        return;
    }
    if (m->region[g] >= 0)
        place += (unsigned)m->region[g];
    else
        for (unsigned leaf = guard_leaves[g]; leaf != guard_leaves[g + 1]; leaf++)
            set_leaf(m, leaf, leaf_below[leaf]);
    for (; place != end && x > limits[place]; place++)
        set_leaf(m, limit_leaf[place], limit_above[place]);
    for (; place != first && x <= limits[place - 1]; place--)
        set_leaf(m, limit_leaf[place - 1], limit_above[place - 1] == TRUE ? FALSE : TRUE);
    m->region[g] = (int)(place - first);
    m->low[g] = place == first ? -INFINITY : limits[place - 1];
    m->high[g] = place == end ? DBL_MAX : limits[place];
}

/* Look at all numbers again, after some of them were forgotten. */
static void review(monitor *m)
{
    for (unsigned g = 0; g != GUARDS; g++)
        if (!is_inside(m, g, m->value[guard_value[g]]))
            cross(m, g, m->value[guard_value[g]]);
}
