/* Part of ROSSMARie, the same for all rules. */

/* The engine needs IEEE 754 binary64 arithmetic, evaluated as written. This file rejects compilers
 * and targets that deviate. The function arithmetic_fault detects the other deviations at run time.
 */
#ifndef ROSSMARIE_BINARY64_H
#define ROSSMARIE_BINARY64_H

#include <float.h>
#include <math.h>
#include <stddef.h>

#if FLT_EVAL_METHOD != 0
#error "needs IEEE 754 binary64 without excess precision, as with -msse2 -mfpmath=sse"
#endif
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) ||           \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__)
#error "needs IEEE 754 semantics: compile without -ffast-math and without its parts"
#endif
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif

/* The array is volatile, so that no compiler can compute with these numbers at compile time. */
static volatile const double given[] = {
    NAN, INFINITY, 1.0, 3.0, -0.0, 1.0 + 0x1p-27, 1.0 + 0x1p-26, DBL_EPSILON / 4.0, DBL_MIN,
};

/* Tests the arithmetic of this program and of this thread. The test detects compiler flags that
 * define no macro, and processor modes of the calling thread. Returns NULL if the arithmetic is
 * that of IEEE 754, else the reason why it is not.
 */
static const char *arithmetic_fault(void)
{
    const double nan = given[0], infinite = given[1], one = given[2], three = given[3];
    const double zero = given[4], factor = given[5], square = given[6];
    const double little = given[7], least = given[8];
    return 0.1 == (double)0.1f ? "constants are float (-fsingle-precision-constant)"
           : one + little != one || -one - little != -one || one - little / 2.0 != one
               ? "results are not rounded to nearest"
           : nan == nan || nan >= one || nan <= one || !isnan(nan)
               ? "NaN counts as a number (-ffinite-math-only, -fno-honor-nans)"
           : !(infinite > DBL_MAX) || !isinf(infinite)
               ? "infinity counts as a number (-ffinite-math-only, -fno-honor-infinities)"
           : (one + 0x1p53) - 0x1p53 != 0.0 ? "sums are regrouped (-fassociative-math)"
           : three / 10.0 != 0.3            ? "divisions are multiplications (-freciprocal-math)"
           : 1.0 / (zero + 0.0) < 0.0       ? "zeros have no sign (-fno-signed-zeros)"
           : factor * factor - square != 0.0
               ? "products and sums are contracted: compile with -ffp-contract=off"
           : least / 2.0 == 0.0 || least / 2.0 * 2.0 != least
               ? "subnormal numbers count as 0 (-ffast-math of any library, -mdaz-ftz)"
               : NULL;
}

#endif
