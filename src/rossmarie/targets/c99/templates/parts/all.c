/* All of the elements, given how many are true, are unknown, and are. */
static double every(size_t truths, size_t unknowns, size_t count)
{
    return truths + unknowns != count ? 0.0 : unknowns != 0 || count == 0 ? NAN : 1.0;
}
