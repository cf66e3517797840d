/* Part of ROSSMARie, the same for all rules. */

/* Sizes of the parts that these rules do not use. The generated file defines the sizes of the parts
 * that the rules use.
 */
#ifndef TIMEOUTS
#define TIMEOUTS 0
#endif
#ifndef GUARDS
#define GUARDS 0
#endif
#ifndef COVERED
#define COVERED 0
#endif
#ifndef EXCUSES
#define EXCUSES 0
#endif
#ifndef LITERALS
#define LITERALS 0
#endif
#ifndef HELD
#define HELD 0
#endif
#ifndef HELD_INITIALLY
#define HELD_INITIALLY 0
#endif
#ifndef SINCES
#define SINCES 0
#endif
#ifndef AGES
#define AGES 0
#endif
#ifndef OSCILLATIONS
#define OSCILLATIONS 0
#endif
#ifndef EDGES
#define EDGES 0
#endif
#ifndef RECENT
#define RECENT 0
#endif
#ifndef SAMPLED
#define SAMPLED 0
#endif
#ifndef SAMPLED_VALUES
#define SAMPLED_VALUES 0
#endif
#ifndef WINDOWS
#define WINDOWS 0
#endif
#ifndef LISTS
#define LISTS 0
#endif
#ifndef BESIDE
#define BESIDE 0
#endif
#ifndef READINGS
#define READINGS 0
#endif
#ifndef WATCHES
#define WATCHES 0
#endif
