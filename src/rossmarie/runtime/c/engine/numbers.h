/* Part of ROSSMARie, the same for all rules. */

/* Conversion of numbers that are not finite to NaN, which means unknown (S4); and results over the
 * elements of arrays and lists (S23 to S25, S53).
 */

/* Returns x if x is finite, else NaN. The expression x - (x - x) is exactly x for each finite x. */
static inline double known(double x) { return x - (x - x); }

/* Returns the result of a comparison as a number: 1, 0, or NaN if an operand is NaN. */
static inline double outcome(bool is_unknown, bool value)
{
    return is_unknown ? NAN : value ? 1.0 : 0.0;
}

/* Returns the truth value of a proposition about one element of an array. */
static inline unsigned char element_proposition(bool is_unknown, bool value)
{
    return is_unknown ? UNKNOWN : value ? TRUE : FALSE;
}

/* Returns the result of `any`: 1, 0, or NaN if it is unknown. Without elements, the result is NaN.
 * The arguments are the number of elements for which the proposition is true, the number for which
 * it is unknown, and the number of all elements.
 */
static inline double some(size_t trues, size_t unknowns, size_t count)
{
    return trues != 0 ? 1.0 : unknowns != 0 || count == 0 ? NAN : 0.0;
}

/* Returns the result of `all`: 1, 0, or NaN if it is unknown. The arguments are those of `some`. */
static inline double every(size_t trues, size_t unknowns, size_t count)
{
    return trues + unknowns != count ? 0.0 : unknowns != 0 || count == 0 ? NAN : 1.0;
}

/* Returns the result of `count`, or NaN if it is unknown. Without elements, the result is NaN. The
 * arguments are those of `some`.
 */
static inline double how_many(size_t trues, size_t unknowns, size_t count)
{
    return unknowns != 0 || count == 0 ? NAN : (double)trues;
}

/* The following functions return the same results for a list. A list without elements is known.
 * `is_known` is false if the elements of the list are unknown.
 */
static inline double some_of_list(size_t trues, size_t unknowns, bool is_known)
{
    return outcome(!is_known || (trues == 0 && unknowns != 0), trues != 0);
}

static inline double every_of_list(size_t trues, size_t unknowns, size_t count, bool is_known)
{
    const bool is_open = trues + unknowns == count;
    return outcome(!is_known || (is_open && unknowns != 0), is_open);
}

static inline double how_many_of_list(size_t trues, size_t unknowns, bool is_known)
{
    return is_known && unknowns == 0 ? (double)trues : NAN;
}
