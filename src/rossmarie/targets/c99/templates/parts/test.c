/* The outcome of a comparison as a number: 0 or 1, or NaN if an operand is. */
static double outcome(bool is_unknown, bool value) { return is_unknown ? NAN : value ? 1.0 : 0.0; }
