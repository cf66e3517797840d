/* Guards: monitors with the reactors of their rules.
 *
 * Compiled together with host.c and guard.c.
 */
#include "batch.c"

#include "guard.c"
