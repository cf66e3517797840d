/* Kleene's negation. */
static unsigned char opposite(unsigned char a) { return a == FALSE ? TRUE : a == TRUE ? FALSE : a; }
