/* --- the core ------------------------------------------------------------------------------ */

static void mark(monitor *m, unsigned node)
{
    m->dirty[node / 64] |= (uint64_t)1 << (node % 64);
    m->pending = true;
}

/* The index of the lowest bit that is set. */
static unsigned lowest(uint64_t bits)
{
#if defined(__GNUC__)
    return (unsigned)__builtin_ctzll(bits);
#else
    unsigned place = 0;
    for (unsigned width = 32; width != 0; width /= 2) {
        if ((bits & (((uint64_t)1 << width) - 1)) == 0) {
            bits >>= width;
            place += width;
        }
    }
    return place;
#endif
}
