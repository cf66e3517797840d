/* Python functions for a guard: those of fastcall.c, which let the reactor follow each message.
 *
 * Compiled together with guarding.c where the headers of Python are at hand.
 */
#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include "guarding.c"

#define TAKE_PACKED guard_packed
#include "fastcall.c"
