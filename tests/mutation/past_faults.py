"""Faults of lists and of the past, for each that runs `past.ross`: the generated C, the generated
Python, and the interpreter.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Damage:
    """A change of a text at one place."""

    name: str
    old: str
    new: str


C = (
    Damage("a list that is full is too long", "poses_count <= 3", "poses_count < 3"),
    Damage("a list that is too long is cut", "poses_count <= 3;", "true;"),
    Damage(
        "no elements are not known",
        "return outcome(!is_known || (trues == 0 && unknowns != 0), trues != 0);",
        "return outcome(!is_known || trues == 0, trues != 0);",
    ),
    Damage(
        "every one of none is false",
        "is_open = trues + unknowns == count",
        "is_open = trues + unknowns == count && count != 0",
    ),
    Damage("unknown elements are not counted as such", "is_known && unknowns == 0 ?", "is_known ?"),
    Damage("the least of nothing is unknown", "MINIMUM_13 = INFINITY", "MINIMUM_13 = NAN"),
    Damage(
        "the field of another column",
        "ELEMENT_12 = poses_pose_position_y[i]",
        "ELEMENT_12 = poses_pose_position_x[i]",
    ),
    Damage(
        "what is out of reach is a lack",
        "is_of_list[8] = {false, false, false, false, true, true, true",
        "is_of_list[8] = {false",
    ),
    Damage(
        "a since begins by itself",
        "either(m->truth_value[begun], both(m->truth_value[held], before))",
        "either(m->truth_value[begun], m->truth_value[held])",
    ),
    Damage(
        "a since forgets",
        "    m->since_before[k] = either(",
        "    return m->truth_value[begun];\n    m->since_before[k] = either(",
    ),
    Damage(
        "what is held before the start is not",
        "held_initially[2] = {TRUE",
        "held_initially[2] = {FALSE",
    ),
    Damage(
        "a window is that of another",
        "window_lengths[1] = {INT64_C(200000000)}",
        "window_lengths[1] = {INT64_C(300000000)}",
    ),
    Damage(
        "a mean of one sample less",
        "(double)m->window_count[0]",
        "(double)(m->window_count[0] - 1)",
    ),
)

PYTHON = (
    Damage("a list that is full is too long", "len(elements_0) > 3", "len(elements_0) > 2"),
    Damage("a list that is too long is cut", " or len(elements_0) > 3", ""),
    Damage(
        "no elements are not known",
        "        if elements_0 is None or",
        "        if not elements_0 or",
    ),
    Damage(
        "unknown elements are not counted as such", "NAN if unknown_19 else", "NAN if False else"
    ),
    Damage("the least of nothing is unknown", "f13 = INF\n", "f13 = NAN\n"),
    Damage("the field of another column", "minimum_of(f13, e_2)", "minimum_of(f13, e_0)"),
    Damage("what is out of reach is a lack", "-INF < s13 < INF", "s13 < INF"),
    Damage("a since forgets", "before_2 = v", "before_2 = 0"),
    Damage(
        "unknown beside stale is unknown at first",
        "v = 1 if t1 == 1 or before_2 == 1 else (t1 if t1 > before_2 else before_2)",
        "v = before_2",
    ),
    Damage("what is held before the start is not", "before_5 = 1\n", "before_5 = 0\n"),
    Damage(
        "what was unknown before has an edge",
        "value == 1 and self.before == 0",
        "value == 1 and self.before != 1",
    ),
    Damage(
        "edges are kept over a jump",
        "        self.instants.clear()\n        self.gap = 2",
        "        self.gap = 2",
    ),
    Damage(
        "samples leave a window late",
        "at_ns - kept[0][0] >= self.window_ns",
        "at_ns - kept[0][0] > self.window_ns",
    ),
    Damage(
        "the middle of two is the upper",
        "ranked((len(self.kept) - 1) // 2)",
        "ranked(len(self.kept) // 2)",
    ),
    Damage("a filter does not feed back", "results_0_100000000.take(known(", "str(known("),
    Damage(
        "the factor of a filter is turned round", "constant + seconds) *", "constant - seconds) *"
    ),
)

INTERPRETER: Mapping[str, Sequence[Damage]] = {
    "elements.py": (
        Damage(
            "the least of nothing is the greatest", "first = math.inf if", "first = -math.inf if"
        ),
        Damage("a count of unknown elements", " or TruthValue.UNKNOWN in values", ""),
        Damage(
            "any is all",
            "if is_any else kleene.conjunction(values)",
            "if not is_any else kleene.conjunction(values)",
        ),
    ),
    "inputs.py": (
        Damage(
            "a list that is too long is cut",
            "is None else values.arrays[index]",
            "== 0 else values.arrays.get(index)",
        ),
        Damage(
            "an array without elements is an observation",
            "values.arrays.get(index) or None",
            "values.arrays.get(index)",
        ),
    ),
    "evaluate.py": (
        Damage("what is out of reach is a lack", " or -math.inf in of_lists", ""),
        Damage(
            "a since forgets",
            "self._memory.since[index] = value",
            "self._memory.since[index] = begun",
        ),
        Damage("a since begins by itself", "kleene.conjunction((held, before))", "held"),
        Damage(
            "a filter does not feed back", "            if feeds_back:\n", "            if False:\n"
        ),
    ),
    "memory.py": (
        Damage(
            "what is held before the start is not",
            "before=kleene.proposition_of(proposition.node.initially)",
            "before=TruthValue.FALSE",
        ),
        Damage("an edge is never over", "        self.before = value\n", ""),
        Damage("a gap is never reported", "return self.gap if is_near else", "return"),
        Damage(
            "edges are kept over a jump",
            "        self.instants.clear()\n        self.gap, ",
            "        self.gap, ",
        ),
        Damage(
            "what was before a jump is the start",
            "recurrence.before = TruthValue.UNKNOWN",
            "recurrence.before = TruthValue.FALSE",
        ),
        Damage(
            "samples leave a window late",
            "at_ns - self._kept[0][0] >= self._window_ns",
            "at_ns - self._kept[0][0] > self._window_ns",
        ),
        Damage("a sum begins anew", "reduce(operator.add, values)", "reduce(operator.sub, values)"),
    ),
}
"""Each module has its faults."""
