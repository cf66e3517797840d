"""What `check --thorough`, its witnesses, and `failures` print."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from support import command_line

RULES = """
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec
action low { set /planner.speed to 0.2; }
action lower { set /planner.speed to 0.1; }
rule fast: if speed > 1 m/s then { low; } clear for 2 sec;
rule faster: if speed > 2 m/s then { lower; } clear for 2 sec;
"""


def run(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    return command_line.run("rossmarie", *arguments, variables={"COLUMNS": "100"})


@pytest.fixture
def rules(tmp_path: Path) -> Path:
    path = tmp_path / "rules.ross"
    path.write_text(RULES)
    return path


def test_witnesses_are_written_and_replay(rules: Path, tmp_path: Path) -> None:
    done = run("check", "--witnesses", tmp_path / "found", rules)
    assert done.returncode == 0
    assert "warning[ROSS700]" in done.stdout
    witness = tmp_path / "found" / "rules_ROSS700_1.csv"
    assert f"wrote {witness}" in done.stdout
    replayed = run("replay", rules, witness)
    assert replayed.returncode == 0, replayed.stderr
    assert "faster" in replayed.stdout


def test_witnesses_are_written_as_tests(rules: Path, tmp_path: Path) -> None:
    path = tmp_path / "kept" / "found.ross"
    path.parent.mkdir()
    for _ in range(2):  # what a check has written it may write again
        done = run("check", "--witnesses", path, rules)
        assert done.returncode == 0
        assert f"wrote 1 test to {path}" in done.stdout
    assert 'import "../rules.ross";' in path.read_text()
    tested = run("test", path)
    assert tested.returncode == 0, tested.stderr
    assert "1 test passed, 0 failed" in tested.stdout


def test_a_file_that_no_check_has_written_is_not_overwritten(rules: Path) -> None:
    done = run("check", "--witnesses", rules, rules)
    assert done.returncode == 2
    assert "rossmarie did not write it" in done.stderr
    assert rules.read_text() == RULES


def test_tests_of_witnesses_are_for_one_rules_file(rules: Path, tmp_path: Path) -> None:
    done = run("check", "--witnesses", tmp_path / "found.ross", rules, rules)
    assert done.returncode == 2
    assert "name one" in done.stderr


def test_without_a_finding_no_tests_are_written(rules: Path, tmp_path: Path) -> None:
    rules.write_text(RULES.replace("low;", "lower;"))
    path = tmp_path / "found.ross"
    assert run("check", "--witnesses", path, rules).returncode == 0
    assert not path.exists()


def test_a_folder_that_cannot_be_written_is_said(rules: Path) -> None:
    taken = rules.with_suffix(".csv")
    taken.touch()
    done = run("check", "--witnesses", taken, rules)
    assert done.returncode == 2
    assert "cannot write to" in done.stderr


def test_without_witnesses_json_is_all_that_is_printed(rules: Path, tmp_path: Path) -> None:
    done = run("check", "--format", "json", "--witnesses", tmp_path / "found", rules)
    assert done.stdout.startswith("{")
    assert done.stdout.endswith("}\n")
    assert "wrote" in done.stderr


def test_proofs_are_reported_when_all_is_asked(rules: Path) -> None:
    assert "ROSS711" not in run("check", rules).stdout
    done = run("check", "--thorough", rules)
    assert "warning[ROSS711]" in done.stdout
    assert done.returncode == 0


def test_how_soon_a_rule_may_not_toggle_is_an_option(rules: Path) -> None:
    rules.write_text(RULES.replace(" clear for 2 sec", ""))
    assert "warning[ROSS708]" in run("check", "--thorough", rules).stdout
    calm = run("check", "--thorough", "--toggle", "0.001", rules)
    assert "ROSS708" not in calm.stdout


def test_errors_keep_everything_else_from_being_asked(rules: Path) -> None:
    rules.write_text(RULES.replace("speed > 2", "sped > 2"))
    done = run("check", "--thorough", rules)
    assert done.returncode == 1
    assert "ROSS7" not in done.stdout
    assert run("failures", rules).returncode == 1


def test_what_the_loss_of_an_input_does_is_a_table(rules: Path) -> None:
    done = run("failures", rules)
    assert done.stdout.splitlines()[1].split() == [
        "speed",
        "/odom",
        "0.5",
        "s",
        "fast,",
        "faster",
        "-",
    ]


def test_the_solver_is_loaded_only_where_it_is_needed(rules: Path) -> None:
    program = "import sys, rossmarie.cli.main, rossmarie.catalog; print('z3' in sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert done.stdout == "False\n"
