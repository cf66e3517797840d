/* Not finite is unknown: x - (x - x) is x, to the bit, if x is finite, and NaN if it is not. */
static double known(double x) { return x - (x - x); }
