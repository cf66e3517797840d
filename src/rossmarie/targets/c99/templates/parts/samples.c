static void forget_samples(monitor *m, unsigned k)
{
    m->latest[k] = NAN;
    m->before[k] = NAN;
}
