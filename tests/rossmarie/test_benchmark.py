"""The benchmark of the monitor: all contenders count the same on both traces. Nothing is timed."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from support.parts import C_COMPILER, RTLOLA_IN_RUST, needs

ROOT = Path(__file__).parents[2]
BENCHMARKS = ROOT / "benchmarks"
BENCH = ROOT / "build" / "bench"
MODULES = ("workload", "in_process", "generated", "peers_run", "operators")
CASES = ("typical", "worst")
COPIES = 2

Columns = dict[str, Any]


@pytest.fixture(scope="module")
def modules() -> Iterator[dict[str, Any]]:
    """The modules of the benchmark, which find each other beside them."""
    sys.path.insert(0, str(BENCHMARKS))
    try:
        yield {name: importlib.import_module(name) for name in MODULES}
    finally:
        sys.path.remove(str(BENCHMARKS))
        for name in MODULES:
            del sys.modules[name]


@pytest.fixture(scope="module")
def traces(modules: dict[str, Any]) -> dict[str, Columns]:
    """As many samples as the worst trace needs until it rests."""
    workload = modules["workload"]
    whole = {"typical": workload.typical_trace(), "worst": workload.worst_trace()}
    samples = workload.REST_PERIOD
    return {
        case: {name: column[:samples].copy() for name, column in columns.items()}
        for case, columns in whole.items()
    }


@pytest.fixture(scope="module")
def hand(modules: dict[str, Any], tmp_path_factory: pytest.TempPathFactory) -> Any:
    output = tmp_path_factory.mktemp("hand") / "hand.so"
    return modules["in_process"].Hand(BENCHMARKS / "hand" / "hand.c", output, ["-O2"])


def test_every_comparison_changes_with_every_sample_of_the_worst_trace(
    modules: dict[str, Any], traces: dict[str, Columns]
) -> None:
    workload, columns = modules["workload"], traces["worst"]
    jumps = workload.REST_PERIOD - workload.REST_SAMPLES
    comparisons = [columns["contact"] == 0]
    for each in workload.constants(100):
        comparisons += [
            columns["speed"] > each.speed,
            columns["speed"] > each.creep,
            np.abs(columns["pitch"]) > each.pitch,
            columns["distance"] < each.distance,
            columns["force_z"] > each.force_z,
        ]
    assert all((one[1:jumps] != one[: jumps - 1]).all() for one in comparisons)
    assert all(one[jumps:].all() for one in comparisons)


@needs(C_COMPILER)
@pytest.mark.parametrize("case", CASES)
def test_ours_counts_as_the_hand_written_loops_do(
    case: str, modules: dict[str, Any], traces: dict[str, Columns], hand: Any, tmp_path: Path
) -> None:
    generated, in_process = modules["generated"], modules["in_process"]
    columns = traces[case]
    for copies in (1, COPIES):
        compiled = generated.machine(tmp_path, copies)
        _, expected = hand.table(columns, copies)()
        steps = generated.Generated(compiled, tmp_path, ["-O2"]).over_columns(columns)
        assert steps()[1] == expected
        assert min(expected) > 0
    compiled = generated.machine(tmp_path, 1)
    _, expected = hand.over_columns("hand_loop", columns)()
    for contender in (
        hand.over_columns("hand_opaque", columns),
        generated.from_python_columns(compiled, columns, 10_000),
        generated.from_python_steps(compiled, columns),
        generated.python_steps(compiled, columns),
        in_process.closure_steps(columns),
        in_process.numpy_whole_columns(columns),
    ):
        assert contender()[1] == expected


@needs(C_COMPILER)
def test_rules_with_scopes_and_exemptions_count_what_they_should(
    modules: dict[str, Any], traces: dict[str, Columns], tmp_path: Path
) -> None:
    columns = traces["typical"]
    is_fast = columns["speed"] > 0.5
    drives = columns["contact"][::10].repeat(10)[: len(is_fast)] == 1
    expected = {"plain": is_fast, "scope": is_fast & drives, "exemption": is_fast & ~drives}
    for code, active in expected.items():
        run = modules["operators"].over_skills(tmp_path, code, columns)
        assert run()[1] == [active.sum()]


@needs(RTLOLA_IN_RUST)
@needs(C_COMPILER)
@pytest.mark.parametrize("case", CASES)
def test_rtlola_in_rust_counts_as_ours_does(
    case: str, modules: dict[str, Any], traces: dict[str, Columns], hand: Any, tmp_path: Path
) -> None:
    peers, columns = modules["peers_run"], traces[case]
    modules["workload"].write_trace(tmp_path, columns)
    samples = len(columns["t_ns"])
    workload = peers.Workload(BENCH, tmp_path, samples, COPIES, 1)
    assert peers.rtlola_in_rust(workload).counts == hand.table(columns, COPIES)()[1]


@pytest.mark.parametrize("peer", ["rtlola_in_rust", "rtlola", "r2u2", "reelay", "rtamt"])
def test_a_peer_that_is_not_installed_is_left_out_with_the_reason(
    peer: str, modules: dict[str, Any], tmp_path: Path
) -> None:
    peers = modules["peers_run"]
    with pytest.raises(peers.NotMeasuredError, match=r"^no \w+$"):
        getattr(peers, peer)(peers.Workload(tmp_path, tmp_path, 10, 1, 1))
