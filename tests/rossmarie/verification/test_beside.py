"""Numbers beside elements (S74) in the generated C, proved by CBMC; what they mean is not what they
mean after a change.
"""

from __future__ import annotations

import pytest

from rossmarie import ir
from rossmarie.driver import compile_file
from rossmarie.verification.prover import ProofVerdict, Prover
from support.depth import deep
from support.provers import NO_CHANGE, asked, real_prover

SECONDS = 120
RULES = """\
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec;
input ranges = topic /scan : sensor_msgs/LaserScan .ranges timeout 0.2 sec;
action stop;
rule near: if any(ranges < abs(speed) * 1 sec) then { stop; };
"""


@pytest.fixture(scope="module")
def prover() -> Prover:
    return real_prover()


@pytest.fixture(scope="module")
def machine(tmp_path_factory: pytest.TempPathFactory) -> ir.Machine:
    path = tmp_path_factory.mktemp("rules") / "beside.ross"
    path.write_text(RULES)
    return compile_file(path).machine


@pytest.mark.parametrize(
    "part",
    ["numbers_scan", "handed_scan", *deep(["tick", "step", "update_scan", "update_odom"])],
)
def test_they_are_what_they_mean(prover: Prover, machine: ir.Machine, part: str) -> None:
    found = list(asked(prover, machine, NO_CHANGE, [part]))
    assert found
    assert {each.verdict for each in found} == {ProofVerdict.PROVED}


@pytest.mark.parametrize(
    ("change", "part", "expected"),
    [
        (("    prepare(m, arrived);\n    fold_scan(m", "    fold_scan(m"), "handed_scan",
         "the numbers beside elements are ready before the results"),
        (("    fold_scan(m, ranges, ranges_count);\n    compute(m, arrived, t_ns);",
          "    compute(m, arrived, t_ns);\n    fold_scan(m, ranges, ranges_count);"), "handed_scan",
         "the numbers beside elements are ready before the results"),
        *deep([
            (("    fold_scan(m, ranges, ranges_count);\n    compute", "    compute"), "handed_scan",
             "an accepted message is folded once, a refused one never"),
            (("        VALUE_ANY_RANGES_ABS_SPEED_1_SEC,\n};", "        VALUE_SPEED,\n};"), "tick",
             "becomes unknown with a number beside elements (S74)"),
            (("const double BESIDE_4 = ", "const double BESIDE_4 = 1.0 + "), "numbers_scan",
             "has its defined value"),
            (("    prepare(m, arrived);\n    if (v->has_scan)\n", "    if (v->has_scan)\n"),
             "step_numbers_odom", "has its defined value"),
        ]),
    ],
)  # fmt: skip
def test_a_mutant_is_refuted(
    prover: Prover, machine: ir.Machine, change: tuple[str, str], part: str, expected: str
) -> None:
    reasons = {each for one in asked(prover, machine, change, [part]) for each in one.reasons}
    assert any(expected in reason for reason in reasons)
