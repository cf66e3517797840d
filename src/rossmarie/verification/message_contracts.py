"""Contracts of the steps that a message goes through, for checks of two things: the order of the
steps, and their arguments.
"""

RECEIVED = """\
static unsigned received_{channel};
{given}

void received_{name}({parameters})
{{
    (void)m;
    __CPROVER_assert(t_ns == asked_ns, "it is handed on at its instant");
    __CPROVER_assert(stage == NOT_STORED, "it is handed on before anything is computed");
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
    __CPROVER_assert(stage == {before}, "what stands beside elements is there before");
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
    __CPROVER_assert(stage == STORED, "what stands beside elements is made of what is stored");
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
        "it is computed from what a message brought");
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
        "what is not refused is handed on once");
    __CPROVER_assert(stage == (events < 0 ? NOT_STORED : COMPUTED),
        "what is handed on is computed with");"""

ASKED_ONCE = """\
    __CPROVER_assert(folded_{channel} == (events < 0 ? 0u : 1u),
        "what is not refused is asked once");"""
