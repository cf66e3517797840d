/* Part of ROSSMARie, the same for all rules. */

/* Numbers that are not finite are unknown, which is NaN; and results over the elements of arrays.
 */

/* A number that is not finite is unknown: x - (x - x) is exactly x if x is finite, and NaN if it is
 * not.
 */
static inline double known(double x) { return x - (x - x); }

/* The result of a comparison as a number: 0 or 1, or NaN if an operand is NaN. */
static inline double outcome(bool is_unknown, bool value)
{
    return is_unknown ? NAN : value ? 1.0 : 0.0;
}

/* A proposition about one element of an array. */
static inline unsigned char element_proposition(bool is_unknown, bool value)
{
    return is_unknown ? UNKNOWN : value ? TRUE : FALSE;
}

/* "For some element", given the numbers of true, of unknown, and of all elements. */
static inline double some(size_t trues, size_t unknowns, size_t count)
{
    return trues != 0 ? 1.0 : unknowns != 0 || count == 0 ? NAN : 0.0;
}

/* "For all elements", given the numbers of true, of unknown, and of all elements. */
static inline double every(size_t trues, size_t unknowns, size_t count)
{
    return trues + unknowns != count ? 0.0 : unknowns != 0 || count == 0 ? NAN : 1.0;
}

/* The number of elements for which a proposition is true, given the numbers of true, of unknown,
 * and of all elements.
 */
static inline double how_many(size_t trues, size_t unknowns, size_t count)
{
    return unknowns != 0 || count == 0 ? NAN : (double)trues;
}

/* The same for the elements of a list, which may be empty, if they are known. */
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
