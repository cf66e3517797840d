/* --- the core ------------------------------------------------------------------------------ */

static void mark(monitor *m, unsigned node)
{
    m->dirty[node / 64] |= (uint64_t)1 << (node % 64);
    m->pending = true;
}

/* The index of the lowest bit that is set, by a de Bruijn sequence. */
static unsigned lowest(uint64_t bits)
{
    static const unsigned char places[64] = {
        0,  1,  2,  53, 3,  7,  54, 27, 4,  38, 41, 8,  34, 55, 48, 28, 62, 5,  39, 46, 44, 42,
        22, 9,  24, 35, 59, 56, 49, 18, 29, 11, 63, 52, 6,  26, 37, 40, 33, 47, 61, 45, 43, 21,
        23, 58, 17, 10, 51, 25, 36, 32, 60, 20, 57, 16, 50, 31, 19, 15, 30, 14, 13, 12};
    return places[((bits & (~bits + 1)) * UINT64_C(0x022fdd63cc95386d)) >> 58];
}
