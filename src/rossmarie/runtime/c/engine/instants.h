/* Part of ROSSMARie, the same for all rules. */

/* Instants are nanoseconds on one clock. A valid instant is later than EARLIEST and earlier than
 * LATEST. A jump of the clock limits ages to LONGEST.
 */
#ifndef ROSSMARIE_INSTANTS_H
#define ROSSMARIE_INSTANTS_H

#include <stdint.h>

#define EARLIEST (-(INT64_C(1) << 60) * 2)
#define LATEST (INT64_C(1) << 62)
#define LONGEST (INT64_C(1) << 61)
#define NEVER INT64_MAX

/* The type of the indices in the tables. NONE is not an index. */
typedef uint16_t index_t;

enum { NONE = 0xFFFF };

#endif
