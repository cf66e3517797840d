"""C that all definitions use: the named numbers, and the logic of S2."""

from __future__ import annotations

HELPERS = """\
/* Say whether two numbers are identical: both NaN, or equal with the same sign. */
static bool spec_same(double a, double b)
{
    return (isnan(a) && isnan(b)) || (a == b && signbit(a) == signbit(b));
}

/* S4: a number that is not finite is unknown. */
static double spec_finite(double x) { return isfinite(x) ? x : NAN; }

/* S2: `not`, `and` and `or` of truth values. */
static unsigned spec_not(unsigned a) { return a == FALSE ? TRUE : a == TRUE ? FALSE : a; }
static unsigned spec_and(unsigned a, unsigned b)
{
    return a == FALSE || b == FALSE ? FALSE : a > b ? a : b;
}
static unsigned spec_or(unsigned a, unsigned b)
{
    return a == TRUE || b == TRUE ? TRUE : a > b ? a : b;
}
"""


CONSTANTS = """\
/* The range of instants and durations, and the truth values and input states of the header. */
_Static_assert(EARLIEST == -INT64_C(0x2000000000000000), "instants lie above -2^61");
_Static_assert(LATEST == INT64_C(0x4000000000000000), "instants lie below 2^62");
_Static_assert(LONGEST == INT64_C(0x2000000000000000), "durations lie below 2^61");
_Static_assert(FALSE == {name}_FALSE && TRUE == {name}_TRUE, "truth values of the header");
_Static_assert(UNKNOWN == {name}_UNKNOWN && STALE == {name}_STALE, "truth values of the header");
_Static_assert(NEVER_RECEIVED == {name}_NEVER_RECEIVED, "state of the header");
_Static_assert(FRESH == {name}_FRESH && EXPIRED == {name}_EXPIRED, "states of the header");
"""
"""The numbers that the C names. CBMC rejects a program in which one of these is wrong."""
