/* --- the core ------------------------------------------------------------------------------ */

/* Something that a truth or rule depends on changed: it is evaluated again. */
INLINE void mark(monitor *m, unsigned node)
{
    m->dirty[node / 64] |= (uint64_t)1 << (node % 64);
    m->pending = true;
}

INLINE bool is_pending(const monitor *m) { return m->pending; }

/* The index of the lowest bit that is set. */
INLINE unsigned lowest(uint64_t bits)
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

/* A truth has a value; if that is new, what depends on it is marked. */
INLINE void set_truth(monitor *m, unsigned node, unsigned value, int64_t t_ns)
{
    if (value == m->truth[node])
        return;
    m->truth[node] = (unsigned char)value;
    m->since_ns[node] = t_ns;
    for (unsigned i = node_users[node]; i != node_users[node + 1]; i++)
        mark(m, users[i]);
}
