/* A number that is not finite may be an infinity out of an array, which is as good as any. */
static double or_unknown(const monitor *m, unsigned g) { return m->value[guard_value[g]]; }
