"""Changes and edges: rules S47 and S48 of docs/explanation/semantics.md."""

from rossmarie.ir import Compare, Comparison, Recurs, Sampled, Sampling, TruthValue
from support.bench import Bench
from support.drafts import SECOND, Draft
from support.machines import NAN

F, T, U, L = TruthValue.FALSE, TruthValue.TRUE, TruthValue.UNKNOWN, TruthValue.STALE


def test_s47_changed_compares_with_the_sample_before() -> None:
    draft = Draft()
    x = draft.read(timeout_ns=10 * SECOND)
    before = draft.signal(Sampled(Sampling.PREVIOUS, x))
    changed = draft.proposition(Compare(Comparison.NOT_EQUAL, x, before))
    draft.rule(changed)
    bench = Bench(draft)
    samples = ((0, 1.0), (1, 1.0), (2, 3.0))
    assert values(bench, changed, *samples) == [U, F, T]
    bench.advance(3)
    assert bench.proposition(changed) is T, "until the next message"
    assert values(bench, changed, (4, 3.0), (5, NAN), (6, 3.0)) == [F, L, U]


def recurring(count: int, window_s: int, timeout_ns: int | None = None) -> tuple[Bench, int]:
    """Edges of `c0 > 0`, counted within a window."""
    draft = Draft()
    high = draft.above(draft.read(timeout_ns=timeout_ns), 0.0)
    recurs = draft.proposition(Recurs(high, count, window_s * SECOND))
    draft.rule(recurs)
    return Bench(draft), recurs


def values(
    bench: Bench, proposition: int, *samples: tuple[float, float]
) -> list[TruthValue | None]:
    """The proposition behind each of some messages."""
    found = []
    for at_s, value in samples:
        bench.send(at_s, c0=value)
        found.append(bench.proposition(proposition))
    return found


def test_s48_edges_are_counted() -> None:
    bench, twice = recurring(2, 10)
    samples = ((0, -1.0), (1, 1.0), (2, 1.0), (3, -1.0), (4, 1.0), (5, -1.0))
    assert values(bench, twice, *samples) == [F, F, F, F, T, T]


def test_s48_what_is_true_at_the_start_is_an_edge() -> None:
    bench, once = recurring(1, 10)
    assert values(bench, once, (0, 1.0)) == [T]


def test_s48_edges_at_one_instant_are_several() -> None:
    bench, twice = recurring(2, 10)
    assert values(bench, twice, (0, 1.0), (0, -1.0), (0, 1.0)) == [F, F, T]


def test_s48_the_window_closes() -> None:
    bench, twice = recurring(2, 10)
    assert values(bench, twice, (1, 1.0), (2, -1.0), (4, 1.0)) == [F, F, T]
    assert bench.wake() == 11
    bench.advance(10.5)
    assert bench.proposition(twice) is T
    bench.advance(11)
    assert bench.proposition(twice) is F
    assert bench.wake() is None
    assert values(bench, twice, (12, -1.0), (13, 1.0)) == [F, T]


def test_s48_known_edges_stay_while_the_condition_is_unknown() -> None:
    bench, once = recurring(1, 10)
    assert values(bench, once, (0, 1.0), (1, NAN)) == [T, T]
    bench.advance(10)
    assert bench.proposition(once) is U, "there may have been an edge that was not seen"
    assert bench.wake() is None


def test_s48_after_a_gap_it_is_false_once_it_was_known_throughout_the_window() -> None:
    bench, twice = recurring(2, 10)
    samples = ((0, 1.0), (1, NAN), (2, 1.0), (3, -1.0))
    assert values(bench, twice, *samples) == [F, U, U, U], "that it came back true is no edge"
    assert bench.wake() == 12
    assert values(bench, twice, (4, 1.0)) == [T]
    bench.advance(10)
    assert (bench.proposition(twice), bench.wake()) == (U, 12)
    bench.advance(12)
    assert (bench.proposition(twice), bench.wake()) == (F, None)


def test_s48_stale_while_the_input_is() -> None:
    bench, once = recurring(1, 10, timeout_ns=SECOND)
    assert values(bench, once, (0, -1.0)) == [F]
    bench.advance(1)
    assert bench.proposition(once) is L
    assert values(bench, once, (3, -1.0)) == [L]
    bench.advance(4)
    assert values(bench, once, (5, 1.0)) == [L], "nobody saw it become true"


def test_s48_a_jump_forgets_edges() -> None:
    bench, once = recurring(1, 10)
    assert values(bench, once, (20, 1.0), (5, 1.0)) == [T, U]
    assert bench.wake() == 15
    bench.advance(15)
    assert bench.proposition(once) is F
    assert values(bench, once, (16, -1.0), (17, 1.0)) == [F, T]
