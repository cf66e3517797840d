"""Write sentences and calls as C text."""

from __future__ import annotations

from collections.abc import Sequence

from rossmarie.verification.invariants import Sentence

PRELUDE = """\
#include <math.h>
#undef isnan
#undef isinf
#undef isfinite
#undef signbit
#define isnan(x) __CPROVER_isnand(x)
#define isinf(x) __CPROVER_isinfd(x)
#define isfinite(x) __CPROVER_isfinited(x)
#define signbit(x) __CPROVER_signd(x)
"""
"""CBMC's functions on numbers, under their C names."""

ANY = """\
    monitor s = any();
    monitor *const m = &s;
    const int64_t t_ns = nondet_instant();
    asked_ns = t_ns;
    base = s;"""
"""An arbitrary memory, at an arbitrary instant."""


def predicate(head: str, body: str) -> str:
    """A function of a monitor and an instant."""
    return (
        f"{head}(const monitor *m, int64_t t_ns)\n{{\n    (void)m;\n    (void)t_ns;\n{body}\n}}\n"
    )


def assumptions(sentences: Sequence[Sentence]) -> str:
    """Statements that restrict the states to those in which the sentences are true."""
    return "\n".join(f"    __CPROVER_assume({sentence.holds});" for sentence in sentences)


def assertions(sentences: Sequence[Sentence]) -> str:
    """Assertions of the sentences, each with its name."""
    return "\n".join(obligation(sentence.holds, sentence.about) for sentence in sentences)


def obligation(holds: str, about: str) -> str:
    """An assertion."""
    plain = about.replace("\\", "\\\\").replace('"', '\\"').replace("\n", " ")
    return f'    __CPROVER_assert({holds}, "{plain}");'
