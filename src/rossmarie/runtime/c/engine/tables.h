/* Part of ROSSMARie, the same for all rules. */

/* The types of the tables of a monitor. */
#ifndef ROSSMARIE_TABLES_H
#define ROSSMARIE_TABLES_H

#include <stdbool.h>
#include <string.h>

#include "binary64.h"
#include "instants.h"

#if defined(__GNUC__)
#define UNLIKELY(condition) __builtin_expect(!!(condition), 0)
#define INLINE static inline __attribute__((always_inline))
#define RARE static __attribute__((noinline))
#else
#define UNLIKELY(condition) (condition)
#define INLINE static inline
#define RARE static
#endif

/* Truth values. STALE: unknown because an input with a timeout is missing. UNSET: not evaluated
 * yet.
 */
enum { FALSE, TRUE, UNKNOWN, STALE, UNSET };

/* States of inputs. */
enum { NEVER_RECEIVED, FRESH, EXPIRED };

/* The release of a rule that only the reset of an operator clears. */
enum { LATCHED = NONE };

/* A limit of a value. The proposition has the truth value `above` if the value is greater than
 * `at`, else the opposite. `other` is the distance in the table to the other limit of the
 * proposition. The distance is negative if the other limit comes before, and 0 if there is no other
 * limit.
 */
typedef struct limit {
    double at;
    index_t proposition;
    unsigned char above;
    int16_t other;
} limit;

/* The first and the last row of the limits of a value. */
#define BELOW_ALL {-INFINITY, 0, FALSE, 0}
#define ABOVE_ALL {DBL_MAX, 0, FALSE, 0}

/* Sets of nodes, for monitors with at most 64 nodes. */
#define BIT(node) ((uint64_t)1 << (node))
#define NOBODY ((uint64_t)0)

#endif
