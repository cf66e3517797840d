/* Part of ROSSMARie, the same for all rules. */

/* Bounds on the fields of commands (R11, R12 of the reactions). */

#if COMMANDS

/* Returns the distance by which a bound has moved outward since the release of its task: 0 while
 * the task is HOLDING, else the ramp times the seconds since the release. The distance is infinite
 * if there is no ramp, or if the task has never started.
 */
static double moved(const reactor *r, unsigned task, double ramp, int64_t t_ns)
{
    const int64_t since_ns = r->since_ns[task];
    if (r->state[task] == HOLDING)
        return 0.0;
    if (since_ns == NEVER || ramp == 0.0)
        return INFINITY;
    return t_ns > since_ns ? ramp * ((double)(t_ns - since_ns) / 1e9) : 0.0;
}

static double lesser(double a, double b) { return b < a ? b : a; }

static double greater(double a, double b) { return b > a ? b : a; }

static double factor_of(const reactor *r, unsigned command, int64_t t_ns)
{
    double factor = 1.0;
#if SCALES
    for (unsigned i = command_scales[command]; i != command_scales[command + 1]; i++) {
        const double gone = moved(r, scales[i].task, scales[i].ramp, t_ns);
        factor = lesser(factor, scales[i].factor + gone);
    }
#endif
    (void)r;
    (void)command;
    (void)t_ns;
    return factor;
}

void NAMED(bounds_of)(const reactor *r, int64_t t_ns, int command, NAMED(bounds) bounds[])
{
    const bool passes = r->opened && t_ns > EARLIEST && t_ns < LATEST;
    double factor;
    if (command < 0 || command >= (int)COMMANDS)
        return;
    factor = passes ? factor_of(r, (unsigned)command, t_ns) : 1.0;
    for (unsigned i = 0; i != command_fields[command]; i++) {
        bounds[i].factor = factor;
        bounds[i].low = passes ? -INFINITY : 0.0;
        bounds[i].high = passes ? INFINITY : 0.0;
    }
    for (unsigned i = command_limits[command]; passes && i != command_limits[command + 1]; i++) {
        NAMED(bounds) *b = &bounds[bounding[i].field];
        const double gone = moved(r, bounding[i].task, bounding[i].ramp, t_ns);
        b->low = greater(b->low, bounding[i].low - gone);
        b->high = lesser(b->high, bounding[i].high + gone);
    }
}

double NAMED(bounded)(NAMED(bounds) b, double value)
{
    return isfinite(value) ? lesser(greater(value * b.factor, b.low), b.high) : 0.0;
}

#endif
