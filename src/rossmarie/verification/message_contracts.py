"""Contracts of the steps that a message goes through, for checks of two things: the order of the
steps, and their arguments.
"""

RECEIVED = """\
static unsigned received_{channel};
{given}

void received_{name}({parameters})
{{
    (void)m;
    __CPROVER_assert(t_ns == asked_ns, "the message is passed on at its instant");
    __CPROVER_assert(stage == NOT_STORED, "the message is stored before any computation");
{obligations}
    stage = STORED;
    received_{channel}++;
}}
"""

ASKED = """\
static unsigned folded_{channel};

void folded_{name}({parameters})
{{
    (void)m;
    __CPROVER_assert(stage == {before}, "the numbers beside elements are ready before the results");
{obligations}
    stage = ASKED;
    folded_{channel}++;
}}
"""

STAGES = """\
/* The steps that a message goes through. */
static enum { NOT_STORED, STORED, PREPARED, ASKED, COMPUTED } stage;
"""

PREPARED = """\
void ignore_prepare(monitor *m, const bool arrived[])
{
    (void)m;
    (void)arrived;
}

void prepared(monitor *m, const bool arrived[])
{
    (void)m;
    (void)arrived;
    __CPROVER_assert(stage == STORED, "the numbers beside elements come from stored numbers");
    stage = PREPARED;
}
"""
"""The contracts of the computation of numbers that are used beside elements. One is for checks to
which this computation does not matter; the other asserts that it comes in time.
"""

COMPUTED = """\
void ignore_compute(monitor *m, const bool arrived[], int64_t t_ns)
{
    (void)arrived;
    m->now_ns = t_ns;
}

void computed(monitor *m, const bool arrived[], int64_t t_ns)
{
    __CPROVER_assert(stage != NOT_STORED && stage != COMPUTED,
        "the computation follows a stored message, and only once");
    stage = COMPUTED;
    ignore_compute(m, arrived, t_ns);
}
"""
"""The contracts of a computation from messages. One is for checks to which its results do not
matter; the other asserts that the computation comes last.
"""

HANDED = """\
    received_{channel} = 0;
    const int events = {call};
    __CPROVER_assert(received_{channel} == (events < 0 ? 0u : 1u),
        "an accepted message is passed on once, a refused one never");
    __CPROVER_assert(stage == (events < 0 ? NOT_STORED : COMPUTED),
        "an accepted message is computed, a refused one is not stored");"""

ASKED_ONCE = """\
    __CPROVER_assert(folded_{channel} == (events < 0 ? 0u : 1u),
        "an accepted message is folded once, a refused one never");"""
