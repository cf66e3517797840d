"""Tests that are generated from rules: they pass, they cover, and they notice mutations."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import HealthCheck, example, given, settings

from rossmarie.driver.generating import generate_tests
from rossmarie.driver.testing import RanTests, run_test_file
from support.depth import examples, is_deep
from support.rule_texts import NAMED, rules
from support.testing import INPUTS

_SLOW = (HealthCheck.too_slow, HealthCheck.data_too_large)
_NUMBER = re.compile(r"(?<![\w.])\d+(?:\.\d+)?(?= (?:m/s|m\b|deg|sec))")

MUTATED = """\
rule slope: if orientation.pitch() > 10 deg for 1.0 sec and speed > 0.1 m/s then { slow; };
rule jolt: if norm(acceleration) not in [7, 13] m/s^2 then { slow; } clear for 2 sec;
rule near: if min(ranges) < 0.4 m then { stop; } latched until reset;
rule close: if any(ranges < 0.8 m) then { slow; } clear when all(ranges > 1.2 m);
rule brake: if rate(speed) < -1.5 m/s^2 then { slow; };
rule late: if age(fix) > 2.5 sec and speed > 0.2 m/s then { slow; };
"""

DECLARED = """\
input efforts = topic /effort_states : std_msgs/Float64MultiArray .data
    names ["shoulder", "elbow", "wrist"] in Nm timeout 0.1 sec;
rule heavy: if efforts["elbow"] > 30 Nm for 0.1 sec then { slow; } clear for 0.5 sec;
rule strained: if any(efforts > 90 Nm) or efforts["wrist"] > 9 Nm then { stop; };
"""


def written(folder: Path, text: str) -> Path:
    """The rules in a folder, with generated tests beside them."""
    path = folder / "rules.ross"
    path.write_text(INPUTS + text, encoding="utf-8")
    found = generate_tests(path)
    found.path.write_text(found.text, encoding="utf-8")
    return path


def is_failed(found: RanTests) -> bool:
    return any(ran.found for ran in found.ran)


@settings(max_examples=examples(0.5), deadline=None, suppress_health_check=_SLOW, derandomize=True)
@given(rules().map(NAMED.__add__))
@example(MUTATED)
@example(DECLARED)
def test_generated_tests_pass_on_the_interpreter_and_in_c(text: str) -> None:
    with TemporaryDirectory() as folder:
        found = run_test_file(written(Path(folder), text))
    assert not is_failed(found)
    assert found.has_c


@pytest.mark.parametrize("text", [MUTATED, DECLARED])
def test_generated_tests_cover_everything_that_can_be(tmp_path: Path, text: str) -> None:
    found = run_test_file(written(tmp_path, text))
    missing = [goal for goal in found.coverage.goals if goal not in found.coverage.reached]
    assert missing == []


def test_they_are_the_same_each_time(tmp_path: Path) -> None:
    path = written(tmp_path, MUTATED)
    assert generate_tests(path).text == generate_tests(path).text


def mutants(text: str) -> Iterator[str]:
    """The rules with one number more, or less, or `<=` for `<`."""
    for found in _NUMBER.finditer(text):
        for factor in (0.98, 1.02):
            number = f"{float(found.group()) * factor:.6g}"
            yield text[: found.start()] + number + text[found.end() :]
    for found in re.finditer(r" [<>] ", text):
        yield text[: found.start()] + f" {found.group().strip()}= " + text[found.end() :]


def test_mutated_thresholds_and_durations_are_noticed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = written(tmp_path, MUTATED)
    tried = list(mutants(MUTATED))[:: 1 if is_deep() else 5]
    missed = []
    for mutant in tried:
        path.write_text(INPUTS + mutant, encoding="utf-8")
        if not is_failed(run_test_file(path, in_c=False)):
            missed.append(mutant)
    with capsys.disabled():
        sys.stdout.write(f"\nmutation score: {len(tried) - len(missed)} of {len(tried)}\n")
    assert missed == []
