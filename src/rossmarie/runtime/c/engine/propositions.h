/* Part of ROSSMARie, the same for all rules. */

/* Propositions and rules are nodes. Each node follows its operands. Propositions use Kleene's
 * three-valued logic; STALE is a form of UNKNOWN.
 */

#if NODES <= 64

/* Marks a node for evaluation, because one of its operands has changed. */
INLINE void mark(monitor *m, unsigned node) { m->dirty |= BIT(node); }

INLINE bool is_pending(const monitor *m) { return m->dirty != 0; }

#else

enum { WORDS = (NODES + 63) / 64 };

INLINE void mark(monitor *m, unsigned node)
{
    m->dirty[node / 64] |= BIT(node % 64);
    m->pending = true;
}

INLINE bool is_pending(const monitor *m) { return m->pending; }

#endif

/* Returns the index of the lowest bit that is set. At least one bit must be set. */
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

/* Sets the truth value of a proposition. If the truth value changes, marks the nodes that depend on
 * the proposition.
 */
INLINE void set_truth_value(monitor *m, unsigned node, unsigned value, int64_t t_ns)
{
    if (value == m->truth_value[node])
        return;
    m->truth_value[node] = (unsigned char)value;
    m->since_ns[node] = t_ns;
#if NODES <= 64
    m->dirty |= node_users[node];
#else
    for (unsigned i = node_users[node]; i != node_users[node + 1]; i++)
        mark(m, users[i]);
#endif
}

/* Returns Kleene's conjunction. STALE is greater than UNKNOWN, so an unknown result is stale if an
 * operand is.
 */
static inline unsigned char both(unsigned char a, unsigned char b)
{
    if (a == FALSE || b == FALSE)
        return FALSE;
    return a > b ? a : b;
}

/* Returns Kleene's disjunction, with STALE as in `both`. */
static inline unsigned char either(unsigned char a, unsigned char b)
{
    if (a == TRUE || b == TRUE)
        return TRUE;
    return a > b ? a : b;
}

/* Returns Kleene's negation. */
static inline unsigned char opposite(unsigned char a)
{
    if (a == FALSE)
        return TRUE;
    return a == TRUE ? (unsigned char)FALSE : a;
}

#if SINCES

/* Returns the truth value of `held since begun` (S44) and stores it for the next evaluation. */
static unsigned char since(monitor *m, unsigned k, unsigned held, unsigned begun)
{
    const unsigned char before = either(m->truth_value[begun], m->since_before[k]);
    m->since_before[k] = either(m->truth_value[begun], both(m->truth_value[held], before));
    return m->since_before[k];
}

#endif
