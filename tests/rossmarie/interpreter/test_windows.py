"""Windows of samples: rule S43 of docs/explanation/semantics.md."""

import math

from rossmarie.ir import Fold, Folding, Sampled, Sampling
from support.bench import Bench
from support.drafts import SECOND, Draft
from support.machines import NAN


def medians(window_ns: int, *samples: tuple[int, float]) -> list[float]:
    """The median of a field behind each of some messages."""
    draft = Draft()
    median = draft.signal(Sampled(Sampling.MEDIAN, draft.read(), window_ns))
    bench = Bench(draft)
    found = []
    for at_s, value in samples:
        bench.send(at_s, c0=value)
        found.append(bench.signal(median))
    return found


def test_s43_median_of_the_window() -> None:
    assert medians(10 * SECOND, (0, 3.0), (1, 1.0), (2, 9.0), (3, 2.0)) == [3.0, 2.0, 3.0, 2.5]
    assert medians(10 * SECOND, (0, 1.0), (0, 5.0), (1, 7.0)) == [1.0, 5.0, 6.0]
    found = medians(10 * SECOND, (0, 0.0), (1, -0.0), (2, 0.0))  # equal ones in their order
    assert [math.copysign(1.0, each) for each in found] == [1.0, 1.0, -1.0]
    assert medians(10 * SECOND, (0, 1.7e308), (1, 1.6e308)) == [1.7e308, 0.8e308 + 0.85e308]


def test_s43_the_window_has_an_end() -> None:
    assert medians(2 * SECOND, (0, 9.0), (1, 1.0), (2, 2.0), (9, 5.0)) == [9.0, 5.0, 1.5, 5.0]


def test_s43_at_most_64_samples() -> None:
    samples = [(at_s, float(at_s)) for at_s in range(100)]
    assert medians(1000 * SECOND, *samples)[-1] == (36 + 99) / 2


def test_s43_unknown_and_infinite_samples() -> None:
    assert (
        str(medians(3 * SECOND, (0, 1.0), (1, NAN), (3, 2.0), (4, 4.0))) == "[1.0, nan, nan, 3.0]"
    )
    draft = Draft()
    least = draft.signal(Fold(Folding.MINIMUM, draft.elements()))
    median = draft.signal(Sampled(Sampling.MEDIAN, least, 10 * SECOND))
    bench = Bench(draft)
    for at_s, value in enumerate((math.inf, 1.0, math.inf)):
        bench.send(at_s, c0=[value])
    assert bench.signal(median) == math.inf
