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

/* Propositions: unknown for lack of an input with a timeout is stale; unset is not evaluated yet.
 */
enum { FALSE, TRUE, UNKNOWN, STALE, UNSET };

enum { NEVER_RECEIVED, FRESH, EXPIRED };

/* A rule that only an operator's reset clears: the proposition that it waits for. */
enum { LATCHED = NONE };

/* A limit of a number: above it, the proposition has this value, and up to it the opposite. If the
 * proposition has another limit, `other` is its distance in the table, negative if it comes before;
 * 0 if there is none.
 */
typedef struct limit {
    double at;
    index_t proposition;
    unsigned char above;
    int16_t other;
} limit;

/* The ends of the limits of a number. */
#define BELOW_ALL {-INFINITY, 0, FALSE, 0}
#define ABOVE_ALL {DBL_MAX, 0, FALSE, 0}

/* A set of propositions and rules, if there are few. */
#define BIT(node) ((uint64_t)1 << (node))
#define NOBODY ((uint64_t)0)

#endif
