/* How many elements a truth holds for, given how many are true, are unknown, and are. */
static double how_many(size_t truths, size_t unknowns, size_t count)
{
    return unknowns != 0 || count == 0 ? NAN : (double)truths;
}
