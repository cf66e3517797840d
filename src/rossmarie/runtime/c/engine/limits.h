/* Part of ROSSMARie, the same for all rules. */

/* Each value that a condition compares has a guard. The guard is the range around the current value
 * in which none of its comparisons changes. Guard g watches the value guard_value[g]. Two tables
 * describe guard g:
 * - Its propositions are guard_leaves[g] to guard_leaves[g + 1] - 1.
 * - Its limits are the rows between guard_limits[g] and guard_limits[g + 1] - 1, from low to high.
 *   These two rows are the ends of the list.
 */

#if EXCUSES

/* Returns true if a value that a proposition depends on is missing: the value is unknown or
 * +infinity. A fold over a list is also missing at -infinity, because the list can have no
 * elements.
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

/* Returns STALE or UNKNOWN for a proposition whose value is unknown (S30). The result is STALE in
 * these cases:
 * - A value of an input with a timeout is missing.
 * - The row has such inputs and no value is missing, so the computation has no result (for example
 *   a division by zero).
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

/* Returns the value that a guard watches. The values in covered_values are stored as they arrive,
 * so this function first replaces each covered value that is not finite by NaN.
 */
RARE double or_unknown(monitor *m, unsigned g)
{
    for (unsigned i = 0; i != COVERED; i++)
        m->value[covered_values[i]] = known(m->value[covered_values[i]]);
    return m->value[guard_value[g]];
}

#else

/* Returns the value that a guard watches. An infinite value can come from an array, where infinity
 * is a valid number.
 */
static double or_unknown(const monitor *m, unsigned g) { return m->value[guard_value[g]]; }

#endif

/* Returns true if a value is inside its guard. A value that is not finite is never inside. The form
 * of the expression needs one instruction for each comparison.
 */
INLINE bool is_inside(const monitor *m, unsigned g, double x)
{
    return !UNLIKELY(!(x > m->low[g])) && !UNLIKELY(x > m->high[g]);
}

/* Makes all propositions of a guard unknown or stale. The loop uses `<`, because gcc 12 unrolls a
 * loop with `!=` beyond the propositions and warns.
 */
RARE void lose_sight(monitor *m, unsigned g, int64_t t_ns)
{
    const unsigned char kind = unknown_kind(m, g);
    if (m->place[g] == -(int)kind)
        return;
    m->place[g] = -(int)kind;
    m->low[g] = INFINITY; /* an empty range */
    m->high[g] = -INFINITY;
    for (unsigned leaf = guard_leaves[g]; leaf < guard_leaves[g + 1]; leaf++)
        set_truth_value(m, leaf, kind, t_ns);
}

/* Sets the place and the range of a guard. The place is the index of the last limit below the
 * value.
 */
static void settle_at(monitor *m, unsigned g, unsigned place)
{
    m->place[g] = (int)place;
    m->low[g] = limits[place].at;
    m->high[g] = limits[place + 1].at;
}

/* Sets all propositions of a guard whose value has become known. Each proposition starts with its
 * truth value below all limits.
 */
static void gain_sight(monitor *m, unsigned g, double x, int64_t t_ns)
{
    unsigned place = guard_limits[g];
    for (unsigned leaf = guard_leaves[g]; leaf < guard_leaves[g + 1]; leaf++)
        set_truth_value(m, leaf, leaf_below[leaf], t_ns);
    for (; place + 2 != guard_limits[g + 1] && x > limits[place + 1].at; place++)
        set_truth_value(m, limits[place + 1].proposition, limits[place + 1].above, t_ns);
    settle_at(m, g, place);
}

/* Changes the propositions at the limits from + 1 to `to`, which the value has crossed. A
 * proposition with both of its limits among them does not change.
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

/* Updates a guard whose value has crossed several limits, or has become known or unknown. */
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

/* Updates a guard whose value has left the range. Most values cross a single limit, which changes
 * one proposition.
 */
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

/* Checks the values of all guards. Call this function after values were forgotten. */
static void review(monitor *m, int64_t t_ns)
{
    for (unsigned g = 0; g != GUARDS; g++)
        if (!is_inside(m, g, m->value[guard_value[g]]))
            cross(m, g, m->value[guard_value[g]], t_ns);
}

#endif
