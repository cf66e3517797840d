"""rtamt's online monitors (Python) on the workload: TRACE_FOLDER SAMPLES COPIES ROUNDS.

A rule counts as active if its robustness is above zero.
"""

from __future__ import annotations

from collections.abc import Iterator

import rtamt
from peer import PERIOD_S, Arguments, measure

Online = rtamt.StlDiscreteTimeOnlineSpecification


def formulas(arguments: Arguments) -> Iterator[tuple[str, tuple[int, ...]]]:
    """The rules in past-time STL, with a weak start, and the columns that each formula reads."""
    for c in arguments.constants:
        fast, tilted, pushed = c.fast_samples * 10, c.tilted_samples * 10, c.pushed_samples * 10
        yield f"historically[0:{fast}ms](c0 > {c.speed!r}) and (c2 < {c.distance!r})", (0, 2)
        yield f"historically[0:{tilted}ms](abs(c1) > {c.pitch!r}) and (c0 > {c.creep!r})", (1, 0)
        yield f"historically[0:{pushed}ms](c3 > {c.force_z!r}) and (c4 < 0.5)", (3, 4)


def specification(formula: str, columns: tuple[int, ...]) -> Online:
    """Parse a specification."""
    result = Online()
    for column in columns:
        result.declare_var(f"c{column}", "float")
    result.declare_var("out", "float")
    result.set_sampling_period(10, "ms", 0.1)
    result.unit = "s"
    result.spec = f"out = {formula}"
    result.parse()
    return result


def main() -> None:
    """Measure. Each round builds new specifications; the construction is not timed."""
    arguments = Arguments.read()
    rows = arguments.rows()

    def build() -> list[tuple[Online, tuple[int, ...]]]:
        return [(specification(*pair), pair[1]) for pair in formulas(arguments)]

    def run(monitors: list[tuple[Online, tuple[int, ...]]]) -> list[int]:
        counts = [0, 0, 0]
        for index, row in enumerate(rows):
            for rule, (monitor, columns) in enumerate(monitors):
                values = [(f"c{column}", float(row[column])) for column in columns]
                counts[rule % 3] += monitor.update(index * PERIOD_S, values) > 0
        return counts

    measure(arguments, build, run)


if __name__ == "__main__":
    main()
