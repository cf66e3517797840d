/* Some of the elements, given how many are true, are unknown, and are. */
static double some(size_t truths, size_t unknowns, size_t count)
{
    return truths != 0 ? 1.0 : unknowns != 0 || count == 0 ? NAN : 0.0;
}
