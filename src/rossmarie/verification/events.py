"""The reports of a monitor when a rule changes, or when time goes backwards.

The input is a layout and its definitions; the result is C that compares the reports with the state
of a monitor. `observe` of the contracts stores the reports.
"""

from __future__ import annotations

from collections.abc import Iterator

from rossmarie.verification.definitions import Definitions
from rossmarie.verification.layout import ProofLayout
from rossmarie.verification.program import obligation
from rossmarie.verification.supports import reported


class Events:
    """Writes these comparisons for one machine."""

    def __init__(self, layout: ProofLayout, definitions: Definitions) -> None:
        self._layout = layout
        self._definitions = definitions
        self._rules = layout.machine.rules

    def text(self) -> str:
        """For each rule, a function that asserts one report, with the content of S41, if the rule
        has changed since `old` and there is a listener.
        """
        return "\n".join(map(self._reported, range(len(self._rules))))

    def _reported(self, rule: int) -> str:
        about = f"the report of rule {self._rules[rule].name} is right (S41)"
        changed, is_now = self.changed(rule), _bit("m->", rule)
        once = f"reports[{rule}] == ({changed} && m->on_event ? 1u : 0u)"
        lines = "\n".join(
            obligation(f"!reports[{rule}] || {each}", about) for each in self._said(rule)
        )
        condition = self._definitions.proposition(self._rules[rule].condition)
        return _REPORTED.format(
            rule=rule,
            name=self._layout.name,
            once=obligation(once, f"each change of rule {self._rules[rule].name} is reported once"),
            lines=lines,
            is_now=is_now,
            condition=condition,
        )

    def _said(self, rule: int) -> Iterator[str]:
        yield f"(said->at_ns == t_ns && said->from_ns == t_ns && said->rule == {rule})"
        yield "said->change == change"
        found = reported(self._layout.machine, self._rules[rule].condition)
        for place, term in enumerate(found.terms):
            yield f"said->truth_values[{place}] == {self._definitions.proposition(term)}"
            yield f"said->since_ns[{place}] == {self._definitions.since(term)}"
        for place, signal in enumerate(found.signals):
            yield f"spec_same(said->values[{place}], {self._definitions.number(signal)})"
        for place, used in enumerate(found.inputs):
            yield f"said->inputs[{place}] == m->state[{used}]"

    def changed(self, rule: int) -> str:
        """The condition that a rule differs from its state in `old`."""
        return f"({_bit('m->', rule)} != {_bit('old.', rule)})"

    def reported(self, rules: set[int]) -> Iterator[str]:
        """The obligations that changes of these rules are reported, and no changes of other
        rules.
        """
        for rule in range(len(self._rules)):
            if rule in rules:
                yield f"    must_report_{rule}(m, old, t_ns);"
            else:
                yield obligation(f"reports[{rule}] == 0", "no other rule is reported")
        yield obligation("jumps == 0", "no time jump is reported")


def _bit(monitor: str, rule: int) -> str:
    return f"({monitor}active[{rule // 8}] >> {rule % 8} & 1)"


_REPORTED = """\
static void must_report_{rule}(const monitor *m, monitor old, int64_t t_ns)
{{
    const {name}_event *const said = &reported[{rule}];
    const int32_t change = !{is_now} ? {name}_CLEARED
                         : {condition} == STALE ? {name}_ACTIVATED_STALE : {name}_ACTIVATED;
{once}
{lines}
}}
"""
