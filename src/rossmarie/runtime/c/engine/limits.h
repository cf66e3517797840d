/* Part of ROSSMARie, the same for all rules. */

/* Guards: every number in a condition has one, the range around its present value in which
 * none of its comparisons changes. Guard g watches guard_value[g]. It owns the propositions from
 * guard_leaves[g] up to, but without, guard_leaves[g + 1], and the limits between the ends
 * guard_limits[g] and guard_limits[g + 1] - 1, from low to high.
 */

#if EXCUSES

/* True if a number that something rests on is missing: it is unknown, or beyond all numbers; the
 * least or greatest of a list without elements is so on either side.
 */
static bool is_missing(const monitor *m, unsigned excuse)
{
    const double x = m->value[excuses[excuse]];
#if LISTS
    if (is_of_list[excuse])
        return !isfinite(x);
#endif
    return !(x < INFINITY);
}

#endif

#if GUARDS || OSCILLATIONS

/* True if a number is unknown for lack of an input with a timeout: its value is missing, or nothing
 * is missing and no number comes out (a division by zero).
 */
static unsigned char unknown_kind(const monitor *m, unsigned row)
{
    for (unsigned i = row_blames[row]; i != row_blames[row + 1]; i++)
        if (isnan(m->value[blames[i]]))
            return STALE;
    if (row_blames[row] == row_blames[row + 1])
        return UNKNOWN;
#if EXCUSES
    for (unsigned i = row_excuses[row]; i != row_excuses[row + 1]; i++)
        if (is_missing(m, i))
            return UNKNOWN;
#endif
    return STALE;
}

#endif

#if GUARDS

#if COVERED

/* Numbers that are stored as they arrive while they are inside their guards: mark one as unknown if
 * it is not finite.
 */
RARE double or_unknown(monitor *m, unsigned g)
{
    for (unsigned i = 0; i != COVERED; i++)
        m->value[covered_values[i]] = known(m->value[covered_values[i]]);
    return m->value[guard_value[g]];
}

#else

/* A number that is not finite may be an infinite element of an array, which is an ordinary number.
 */
static double or_unknown(const monitor *m, unsigned g) { return m->value[guard_value[g]]; }

#endif

/* Not inside if not finite. (Written so that each comparison needs one instruction.) */
INLINE bool is_inside(const monitor *m, unsigned g, double x)
{
    return !UNLIKELY(!(x > m->low[g])) && !UNLIKELY(x > m->high[g]);
}

/* (The loops over leaves ask for `<`: with `!=` gcc 12 unrolls them beyond the propositions and
 * warns.)
 */
RARE void lose_sight(monitor *m, unsigned g, int64_t t_ns)
{
    const unsigned char kind = unknown_kind(m, g);
    if (m->place[g] == -(int)kind)
        return;
    m->place[g] = -(int)kind;
    m->low[g] = INFINITY; /* nothing is inside */
    m->high[g] = -INFINITY;
    for (unsigned leaf = guard_leaves[g]; leaf < guard_leaves[g + 1]; leaf++)
        set_truth_value(m, leaf, kind, t_ns);
}

/* The place of a guard is the limit at or below its number. */
static void settle_at(monitor *m, unsigned g, unsigned place)
{
    m->place[g] = (int)place;
    m->low[g] = limits[place].at;
    m->high[g] = limits[place + 1].at;
}

/* A number that was unknown has become known: every proposition starts below its limits. */
static void gain_sight(monitor *m, unsigned g, double x, int64_t t_ns)
{
    unsigned place = guard_limits[g];
    for (unsigned leaf = guard_leaves[g]; leaf < guard_leaves[g + 1]; leaf++)
        set_truth_value(m, leaf, leaf_below[leaf], t_ns);
    for (; place + 2 != guard_limits[g + 1] && x > limits[place + 1].at; place++)
        set_truth_value(m, limits[place + 1].proposition, limits[place + 1].above, t_ns);
    settle_at(m, g, place);
}

/* A number crossed the limits behind `from` up to `to`: flip the propositions there, but for those
 * with both their limits among them.
 */
static void flip(monitor *m, unsigned from, unsigned to, unsigned is_falling, int64_t t_ns)
{
    for (unsigned i = from + 1; i <= to; i++) {
        const unsigned other = (unsigned)((int)i + limits[i].other);
        const bool has_other_there = other != i && other > from && other <= to;
        if (!has_other_there)
            set_truth_value(m, limits[i].proposition, limits[i].above ^ is_falling, t_ns);
    }
}

/* A number crossed several limits, or became known or unknown. */
RARE void cross_far(monitor *m, unsigned g, double x, int64_t t_ns)
{
    unsigned place = (unsigned)m->place[g];
    if (!isfinite(x))
        x = or_unknown(m, g);
    if (isnan(x)) {
        lose_sight(m, g, t_ns);
    } else if (m->place[g] < 0) {
        gain_sight(m, g, x, t_ns);
    } else if (x > limits[place + 1].at) {
        while (place + 2 != guard_limits[g + 1] && x > limits[place + 1].at)
            place++;
        flip(m, (unsigned)m->place[g], place, 0, t_ns);
        settle_at(m, g, place);
    } else {
        while (place != guard_limits[g] && x <= limits[place].at)
            place--;
        flip(m, place, (unsigned)m->place[g], 1, t_ns);
        settle_at(m, g, place);
    }
}

/* A number left its guard. Most cross a single limit: one proposition flips. */
static void cross(monitor *m, unsigned g, double x, int64_t t_ns)
{
    const unsigned is_rising = x > m->high[g] ? 1 : 0;
    const unsigned crossed = (unsigned)m->place[g] + is_rising;
    const unsigned place = crossed + is_rising - 1;
    if (UNLIKELY(m->place[g] < 0 || !isfinite(x) || x <= limits[place].at ||
                 x > limits[place + 1].at)) {
        cross_far(m, g, x, t_ns);
        return;
    }
    set_truth_value(m, limits[crossed].proposition, limits[crossed].above ^ is_rising ^ 1u, t_ns);
    settle_at(m, g, place);
}

/* Look at all numbers again, after some of them were forgotten. */
static void review(monitor *m, int64_t t_ns)
{
    for (unsigned g = 0; g != GUARDS; g++)
        if (!is_inside(m, g, m->value[guard_value[g]]))
            cross(m, g, m->value[guard_value[g]], t_ns);
}

#endif
