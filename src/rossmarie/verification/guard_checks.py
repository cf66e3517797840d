"""Checks of tests of guarded numbers, and the contract that replaces such a test elsewhere.

The input is the invariants of a machine. The result is, for each guard, a check of `cross`, a check
of `is_inside`, and a contract. All other checks call the contract, which covers both. The values
that a guard and its propositions keep from an earlier number are called *kept*: they belong to some
number, not necessarily to the present number.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rossmarie.verification.check import Check, Parts, WrittenCheck
from rossmarie.verification.definitions import Definitions
from rossmarie.verification.invariants import Invariants, Sentence, remark_of, users_of
from rossmarie.verification.layout import ProofLayout
from rossmarie.verification.places import WatchedGuard
from rossmarie.verification.program import ANY, assertions, assumptions, obligation, predicate

_LOOPS_OVER_LIMITS = ("cross_far.0", "cross_far.1", "flip.0", "gain_sight.1")

_LOOKS: Parts = (("is_inside", "always_outside"), ("cross", "contract_look"))
"""The functions that replace a test of a guard."""


def unlooked(parts: Parts) -> Parts:
    """The replaced parts for checks to which the state of guards does not matter."""
    kept = tuple(pair for pair in parts if pair not in _LOOKS)
    return (*kept, ("cross", "ignore_cross")) if kept != parts else parts


class GuardChecks:
    """Writes these checks for one machine."""

    def __init__(
        self, layout: ProofLayout, definitions: Definitions, invariants: Invariants
    ) -> None:
        self._layout = layout
        self._definitions = definitions
        self._invariants = invariants

    def parts(self) -> Parts:
        """The replaced parts in the checks of other functions."""
        return _LOOKS if self._layout.guards else ()

    def written(self) -> Iterator[WrittenCheck]:
        """Two checks for each guard, and one check of `set_truth_value`."""
        for number, guard in enumerate(self._layout.guards):
            remark = remark_of(self._layout.values[guard.value])
            about = f"a new `{remark}` is compared with its limits"
            parts = (("set_truth_value", f"contract_set_{number}"),)
            most = guard.limit_count + 2
            loops = tuple((loop, most) for loop in _LOOPS_OVER_LIMITS)
            check = Check(f"cross_{number}", about, parts, loops)
            yield WrittenCheck(check, self._check(number, guard))
            about = f"a new `{remark}` inside its guard changes nothing"
            yield WrittenCheck(Check(f"inside_{number}", about), self._inside(number, guard))
        if self._layout.guards:
            about = "a proposition gets a value, and its dependents are marked"
            yield WrittenCheck(Check("set_truth_value", about), self._check_set_proposition())

    def text(self) -> str:
        """The predicates, the contract, and the functions that the checks compare with."""
        if not self._layout.guards:
            return ""
        finite = list(self._finite())
        parts: list[str] = []
        parts.append(predicate("static void suppose_finite", assumptions(finite)))
        parts.append(predicate("static void must_be_finite", assertions(finite)))
        for number, guard in enumerate(self._layout.guards):
            kept = [self._kept(number, guard), *self._invariants.tests(guard)]
            parts.append(self._probe(number, guard))
            parts.append(predicate(f"static void suppose_kept_{number}", assumptions(kept)))
            parts.append(predicate(f"static void must_be_kept_{number}", assertions(kept)))
            parts.append(self._change(number, guard))
            parts.append(self._set(f"contract_set_{number}", guard.leaves))
        parts.append(self._set("spec_set_proposition", [*self._layout.node_of_proposition]))
        parts.append(
            _CONTRACTS.format(
                numbers=self._cases("return m->value[{value}];"),
                stays=self._cases(
                    "must_be_kept_{number}(m, t_ns); suppose_guard_{number}(m, t_ns); break;"
                ),
                changes=self._cases("look_{number}(m, x, t_ns); break;"),
            )
        )
        return "\n".join(parts)

    def _cases(self, text: str) -> str:
        """The same text for each guard."""
        return "".join(
            f"    case {number}: {text.format(number=number, value=guard.value)}\n"
            for number, guard in enumerate(self._layout.guards)
        )

    # --- kept values -------------------------------------------------------------------------

    def _finite(self) -> Iterator[Sentence]:
        """Numbers that have no guard are kept as finite or unknown, except the numbers from
        arrays.
        """
        watched = [guard.value for guard in self._layout.guards]
        others = self._layout.places.kept_raw | {
            value
            for signal, value in self._layout.value_of_signal.items()
            if self._definitions.can_be_infinite(signal)
        }
        for value in dict.fromkeys([*self._layout.places.value_of_slot, *watched]):
            if value not in others:
                remark = remark_of(self._layout.values[value])
                yield Sentence(f"`{remark}` is finite or unknown", f"!isinf(m->value[{value}])")

    def _probe(self, number: int, guard: WatchedGuard) -> str:
        """State that propositions are right for the largest number inside a guard."""
        right = " && ".join(
            f"{self._definitions.proposition(proposition)} == "
            + (
                f"(m->high[{number}] > 0.5 ? TRUE : FALSE)"
                if self._invariants.is_test(proposition)
                else f"spec_proposition_{proposition}(&probe, t_ns)"
            )
            for proposition in guard.leaves
        )
        return (
            f"static bool is_kept_{number}(const monitor *m, int64_t t_ns)\n{{\n"
            f"    monitor probe = *m;\n"
            f"    probe.value[{guard.value}] = m->high[{number}];\n"
            f"    return {right};\n}}\n"
        )

    def _kept(self, number: int, guard: WatchedGuard) -> Sentence:
        place, low, high = f"m->place[{number}]", f"m->low[{number}]", f"m->high[{number}]"
        first, last = self._invariants.places(number)
        propositions = [self._definitions.proposition(proposition) for proposition in guard.leaves]
        unknown = " && ".join(
            [
                *(
                    f"{proposition} >= UNKNOWN && {proposition} <= UNSET"
                    for proposition in propositions[:1]
                ),
                *(f"{proposition} == {propositions[0]}" for proposition in propositions[1:]),
                f"{place} == -(int){propositions[0]} && {low} == INFINITY && {high} == -INFINITY",
            ]
        )
        known = (
            f"{place} >= {first} && {place} <= {last} && {low} == limits[{place}].at && "
            f"{high} == limits[{place} + 1].at && is_kept_{number}(m, t_ns)"
        )
        return Sentence(
            "a guard and its propositions fit a number", f"{place} < 0 ? {unknown} : {known}"
        )

    # --- changes -----------------------------------------------------------------------------

    def _change(self, number: int, guard: WatchedGuard) -> str:
        """The contract of a test of a number that may have left its guard. The guard's propositions
        change, and the nodes that depend on them are marked. Nothing else changes. A number inside
        its guard changes nothing; the contract includes this case.
        """
        nodes = [self._layout.node_of_proposition[proposition] for proposition in guard.leaves]
        return "\n".join(
            [
                f"static void look_{number}(monitor *m, double x, int64_t t_ns)\n{{",
                f"    must_be_kept_{number}(m, t_ns);",
                "    must_be_finite(m, t_ns);",
                "    must_be_marks(m, t_ns);",
                "    const monitor old = *m;",
                self._numbers(),
                f"    m->place[{number}] = nondet_integer();",
                f"    m->low[{number}] = nondet_double();",
                f"    m->high[{number}] = nondet_double();",
                *(
                    f"    m->truth_value[{node}] = (unsigned char)nondet_number();"
                    for node in nodes
                ),
                *self._consequences(guard),
                f"    suppose_guard_{number}(m, t_ns);\n}}\n",
            ]
        )

    def _numbers(self) -> str:
        """Numbers that are kept as received until they are read (S4): the test makes one finite or
        unknown.
        """
        lines = [
            f"        m->value[{value}] = spec_finite(m->value[{value}]);"
            for value in self._layout.places.kept_raw
        ]
        return "\n".join(["    if (!isfinite(x)) {", *lines, "    }"]) if lines else "    (void)x;"

    def _consequences(self, guard: WatchedGuard) -> Iterator[str]:
        for proposition in guard.leaves:
            node = self._layout.node_of_proposition[proposition]
            yield f"    if (m->truth_value[{node}] != old.truth_value[{node}]) {{"
            yield f"        m->since_ns[{node}] = t_ns;"
            for user in users_of(self._layout, proposition):
                yield f"        mark(m, {user});"
            yield "    }"

    # --- propositions
    # ------------------------------------------------------------------------------

    def _set(self, name: str, propositions: Sequence[int]) -> str:
        """The function that sets one of these propositions to a value."""
        cases = []
        for proposition in propositions:
            node = self._layout.node_of_proposition[proposition]
            marks = "".join(f" mark(m, {user});" for user in users_of(self._layout, proposition))
            cases.append(
                f"    case {node}:\n        if (value != m->truth_value[{node}]) {{\n"
                f"            m->truth_value[{node}] = (unsigned char)value;\n"
                f"            m->since_ns[{node}] = t_ns;\n"
                f"           {marks}\n        }}\n        break;\n"
            )
        return _SET.format(name=name, cases="".join(cases))

    def _check_set_proposition(self) -> str:
        return f"""\
{ANY}
    const unsigned node = nondet_number();
    const unsigned value = nondet_number() % 5;
    __CPROVER_assume(node < PROPOSITIONS);
    suppose_marks(m, t_ns);
    monitor expected = s;
    spec_set_proposition(&expected, node, value, t_ns);
    set_truth_value(m, node, value, t_ns);
    must_be_same(m, &expected);"""

    # --- the check ---------------------------------------------------------------------------

    def _check(self, number: int, guard: WatchedGuard) -> str:
        """The check that a test leaves the result that the contract makes of the memory before."""
        nodes = [self._layout.node_of_proposition[proposition] for proposition in guard.leaves]
        copied = [f"{name}[{number}]" for name in ("place", "low", "high")]
        copied += [f"truth_value[{node}]" for node in nodes]
        return "\n".join(
            [
                ANY,
                *self._each_place(number),
                f"    suppose_kept_{number}(m, t_ns);",
                "    suppose_finite(m, t_ns);",
                "    suppose_marks(m, t_ns);",
                "    const monitor old = s;",
                f"    const double x = m->value[{guard.value}];",
                f"    __CPROVER_assume(!is_inside(m, {number}, x));",
                f"    cross(m, {number}, x, t_ns);",
                f"    must_be_guard_{number}(m, t_ns);",
                "    monitor expected = old;",
                self._numbers().replace("m->", "expected."),
                *(f"    expected.{place} = m->{place};" for place in copied),
                "    {",
                "        monitor *const m = &expected;",
                *(f"    {line}" for line in self._consequences(guard)),
                "    }",
                "    must_be_same(m, &expected);",
            ]
        )

    def _inside(self, number: int, guard: WatchedGuard) -> str:
        """The check that memory already satisfies the result of `look` if the number is inside its
        guard.
        """
        return "\n".join(
            [
                ANY,
                *self._each_place(number),
                f"    suppose_kept_{number}(m, t_ns);",
                f"    const double x = m->value[{guard.value}];",
                f"    __CPROVER_assume(is_inside(m, {number}, x));",
                obligation("isfinite(x)", "a number inside its guard is finite"),
                obligation(
                    f"x > m->low[{number}] && x <= m->high[{number}]",
                    "the number lies within the guard",
                ),
                f"    must_be_guard_{number}(m, t_ns);",
            ]
        )

    def _each_place(self, number: int) -> Iterator[str]:
        """Treat each place that a guard can have as a case of its own."""
        first, last = self._invariants.places(number)
        yield f"    switch (m->place[{number}]) {{"
        for place in (*range(-4, -1), *range(first, last + 1)):
            yield f"    case {place}: m->place[{number}] = {place}; break;"
        yield "    default: __CPROVER_assume(false);"
        yield "    }"


_SET = """\
void {name}(monitor *m, unsigned node, unsigned value, int64_t t_ns)
{{
    switch (node) {{
{cases}    default:
        __CPROVER_assert(false, "the node is one of these propositions");
    }}
}}
"""

_CONTRACTS = """\
void ignore_cross(monitor *m, unsigned g, double x, int64_t t_ns)
{{
    (void)m;
    (void)g;
    (void)x;
    (void)t_ns;
}}

static double number_of(const monitor *m, unsigned g)
{{
    switch (g) {{
{numbers}    default:
        __CPROVER_assert(false, "the guard exists");
        return NAN;
    }}
}}

/* The guard of the last call of `is_inside`. */
static unsigned asked = GUARDS;

/* `contract_look` covers both cases: a number has left its guard, or not. So no two paths join. */
bool always_outside(const monitor *m, unsigned g, double x)
{{
    __CPROVER_assert(spec_same(x, number_of(m, g)), "`is_inside` gets the number of its guard");
    asked = g;
    return false;
}}

void contract_look(monitor *m, unsigned g, double x, int64_t t_ns)
{{
    __CPROVER_assert(g == asked, "the monitor calls `is_inside` for the guard before `cross`");
    __CPROVER_assert(spec_same(x, number_of(m, g)), "`cross` gets the number of its guard");
    asked = GUARDS;
    switch (g) {{
{changes}    default:
        __CPROVER_assert(false, "the guard exists");
    }}
}}

/* The guards that the short path tests, and the first guard that its number has left. */
static bool is_here[GUARDS];
static unsigned first_left = GUARDS;
static bool is_left = false;

bool inside_until_left(const monitor *m, unsigned g, double x)
{{
    const int64_t t_ns = m->now_ns;
    if (is_left || g == first_left) {{
        is_left = true;
        return always_outside(m, g, x);
    }}
    __CPROVER_assert(spec_same(x, number_of(m, g)), "`is_inside` gets the number of its guard");
    __CPROVER_assert(g < GUARDS && is_here[g], "the message can change the number of the guard");
    switch (g) {{
{stays}    default:
        __CPROVER_assert(false, "the guard exists");
    }}
    __CPROVER_assume(x > m->low[g] && x <= m->high[g]);
    return true;
}}
"""
