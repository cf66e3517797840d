"""The command line as a user meets it: what it prints, and its exit codes."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from rossmarie import ir
from rossmarie.driver.build import check_for
from rossmarie.ir import machine_from_json, machine_to_json
from support import command_line

ROOT = Path(__file__).parents[3]
RULES = """action stop;
input on = topic /on : std_msgs/Bool timeout 1 sec
rule it: if on then { stop; };
"""
WRONG = RULES.replace("if on", "if on and no")


def run(*arguments: str | Path, **variables: str) -> subprocess.CompletedProcess[str]:
    return command_line.run("rossmarie", *arguments, variables={"COLUMNS": "100", **variables})


@pytest.fixture
def rules(tmp_path: Path) -> Path:
    path = tmp_path / "rules.ross"
    path.write_text(RULES)
    return path


@pytest.fixture
def wrong(tmp_path: Path) -> Path:
    path = tmp_path / "wrong.ross"
    path.write_text(WRONG)
    return path


def test_check_says_what_it_found_and_counts(rules: Path, wrong: Path) -> None:
    fine = run("check", rules)
    assert (fine.returncode, fine.stdout, fine.stderr) == (0, "no errors in 1 file\n", "")
    bad = run("check", rules, wrong)
    assert bad.returncode == 1
    assert "error[ROSS101]: `no` is not declared" in bad.stdout
    assert bad.stdout.endswith("\n1 error in 2 files\n")
    assert "\x1b" not in bad.stdout


def test_a_finding_in_an_imported_file_is_reported_once(tmp_path: Path, wrong: Path) -> None:
    importing = tmp_path / "importing.ross"
    importing.write_text('import "wrong.ross";')
    assert run("check", wrong, importing).stdout.count("error[ROSS101]") == 1


def test_check_for_machines(wrong: Path) -> None:
    as_json = json.loads(run("check", wrong, "--format", "json").stdout)
    assert as_json["summary"] == {"errors": 1, "warnings": 0, "notes": 0, "files": 1}
    log = json.loads(run("check", wrong, "--format", "sarif").stdout)
    (found,) = log["runs"][0]["results"]
    assert found["ruleId"] == "ROSS101"


@pytest.mark.parametrize(
    "arguments",
    [
        ["check"],
        ["check", "nowhere.ross"],
        ["check", "rules.ross", "--format", "xml"],
        ["check", "rules.ross", "--messages", "nowhere"],
        ["explain", "ROSS999"],
        ["replay", "rules.ross", "drive.bag", "--topic-map", "nonsense"],
        ["dump", "rules.ross", "--after", "lunch"],
        ["dump", "rules.ross", "--after", "check", "--format", "json"],
        ["graph", "rules.ross", "--format", "png"],
        ["check", "rules.ross", "--target", "ros"],
        ["dance"],
    ],
    ids=" ".join,
)
def test_a_wrong_call_ends_with_2(
    arguments: list[str], rules: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(rules.parent)
    done = run(*arguments)
    assert done.returncode == 2
    assert done.stdout + done.stderr
    assert "Traceback" not in done.stderr


def test_explain_prints_the_page() -> None:
    done = run("explain", "unit-mismatch")
    assert done.returncode == 0
    assert done.stdout.startswith("# ROSS301 unit-mismatch\n")
    assert "did you mean `ROSS301`" in run("explain", "ROS301").stderr


def test_fmt_rewrites_and_checks(rules: Path, wrong: Path) -> None:
    wrong.write_text("action   stop ;")
    assert run("fmt", "--check", wrong).returncode == 1
    assert wrong.read_text() == "action   stop ;"
    assert run("fmt", wrong).returncode == 0
    assert wrong.read_text() == "action stop;\n"
    run("fmt", rules)
    assert run("fmt", "--check", rules, wrong).returncode == 0


def test_fmt_leaves_a_file_with_syntax_errors_alone(wrong: Path) -> None:
    wrong.write_text("action stop\naction ;")
    done = run("fmt", wrong)
    assert done.returncode == 1
    assert "error[ROSS0" in done.stdout
    assert wrong.read_text() == "action stop\naction ;"


@pytest.mark.parametrize(
    ("stage", "shown"),
    [
        ("parse", "text = 'stop'"),
        ("check", "input on = /on : std_msgs/Bool .data : boolean, timeout 1000000000 ns"),
        ("lower", "rule it = if t0"),
        ("generate", "int rules_update_on("),
    ],
)
def test_dump_stops_after_any_stage(rules: Path, stage: str, shown: str) -> None:
    done = run("dump", rules, "--after", stage)
    assert done.returncode == 0
    assert shown in done.stdout


def test_dump_for_machines(rules: Path) -> None:
    tree = json.loads(run("dump", rules, "--after", "parse", "--format", "json").stdout)
    (file,) = tree["files"]
    action = next(item for item in file["items"] if item["class"] == "Action")
    start, end = action["name"]["span"]
    assert rules.read_text()[start:end] == action["name"]["text"] == "stop"
    text = run("dump", rules, "--format", "json").stdout
    assert machine_to_json(machine_from_json(text)) == text


def test_dump_says_what_has_no_json_form(rules: Path) -> None:
    done = run("dump", rules, "--after", "check", "--format", "json")
    assert done.stderr == "rossmarie: --after check has no JSON form; parse or lower has\n"


def test_dump_of_rules_with_errors(wrong: Path) -> None:
    assert run("dump", wrong, "--after", "parse").returncode == 0
    done = run("dump", wrong, "--after", "lower")
    assert done.returncode == 1
    assert "error[ROSS101]" in done.stdout


def test_build_writes_what_compiles_and_leaves_it_alone(rules: Path, tmp_path: Path) -> None:
    out = tmp_path / "generated"
    assert run("build", rules, "--out", out).returncode == 0
    files = [path for path in out.rglob("*") if path.is_file()]
    written = {path: path.stat().st_mtime_ns for path in files}
    source = next(path for path in written if path.suffix == ".c")
    subprocess.run(["cc", "-std=c99", "-c", source, "-o", tmp_path / "monitor.o"], check=True)
    run("build", rules, "--out", out)
    assert {path: path.stat().st_mtime_ns for path in files} == written


def test_build_writes_the_rules_beside_their_c(rules: Path, tmp_path: Path) -> None:
    page = tmp_path / "pages" / "review.html"
    done = run("build", rules, "--out", tmp_path / "generated", "--review", page)
    assert done.stdout.endswith(f"wrote {page}\n")
    assert "rules_monitor.c:" in page.read_text(encoding="utf-8")
    done = run("build", rules, "--target", "python", "--out", tmp_path / "other", "--review", page)
    assert done.returncode == 2
    assert "--review is for targets in C" in done.stderr
    assert not (tmp_path / "other").exists()


def test_build_of_a_module_that_runs_by_itself(rules: Path, tmp_path: Path) -> None:
    out = tmp_path / "generated"
    done = run("build", rules, "--target", "python", "--out", out)
    assert done.stdout.endswith(f"wrote {out}/rules_monitor.py\n")
    program = (
        f"import sys; sys.path.insert(0, {str(out)!r}); import rules_monitor as m; "
        "monitor = m.start(); monitor.update_on(0, True); "
        "print(m.RULES[monitor.take_events()[0].rule].name, monitor.active())"
    )
    alone = [sys.executable, "-I", "-S", "-c", program]
    assert subprocess.run(alone, capture_output=True, text=True, check=True).stdout == (
        "it (True,)\n"
    )


def test_build_where_nothing_can_be_written(rules: Path) -> None:
    done = run("build", rules, "--out", rules / "below a file")
    assert done.returncode == 2
    assert "cannot write" in done.stderr


# --- what a target cannot do -----------------------------------------------------------------

SETTING = RULES.replace("action stop;", "action stop { set /planner.path.speed to 0.1; }")


def test_check_says_what_a_target_cannot_do(rules: Path, tmp_path: Path) -> None:
    setting = tmp_path / "setting.ross"
    setting.write_text(SETTING)
    assert run("check", setting).stdout == "no errors in 1 file\n"
    assert run("check", setting, "--target", "c99").stdout == "no errors in 1 file\n"
    done = run("check", setting, rules, "--target", "ros1")
    assert done.returncode == 1
    assert (
        "error[ROSS503]: the target ros1 cannot do `set /planner.path.speed to 0.1`" in done.stdout
    )
    assert "error[ROSS504]" in done.stdout
    assert done.stdout.endswith("\n2 errors in 2 files\n")


def test_check_for_a_target_tells_warnings_and_other_errors_as_well(
    tmp_path: Path, wrong: Path
) -> None:
    warned = tmp_path / "warned.ross"
    warned.write_text("const unused = 1;\n" + SETTING)
    done = run("check", warned, wrong, "--target", "ros1", "--format", "json")
    found = [one["code"] for one in json.loads(done.stdout)["diagnostics"]]
    assert found == ["ROSS401", "ROSS503", "ROSS101"]


def test_check_for_a_target_tells_what_no_target_can_do(
    rules: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ir, "MOST_EVALUATIONS", 0)
    assert [found.code for found in check_for("python", rules)] == ["ROSS502"]


# --- graph -----------------------------------------------------------------------------------

STOPPING = RULES.replace("action stop;", "action stop { block /cmd_vel : geometry_msgs/Twist; }")


def test_graph_prints_the_wiring(rules: Path) -> None:
    rules.write_text(STOPPING)
    done = run("graph", rules)
    assert (done.returncode, done.stderr) == (0, "")
    path = "planner --> /unfil_cmd_vel --> rules_safety --> /cmd_vel --> robot"
    assert path in done.stdout
    assert run("graph", rules, "--format", "dot").stdout.startswith('digraph "rules_safety" {\n')


def test_graph_writes_a_file_again_and_again(rules: Path, tmp_path: Path) -> None:
    picture = tmp_path / "wiring.svg"
    for text in (RULES, STOPPING):
        rules.write_text(text)
        done = run("graph", rules, "--format", "svg", "--out", picture)
        assert (done.returncode, done.stdout) == (0, f"wrote {picture}\n")
    assert "/unfil_cmd_vel" in picture.read_text()
    mark, _, drawn = picture.read_text().partition("\n")
    assert mark == "<!-- Written by rossmarie. -->"
    assert run("graph", rules, "--format", "svg").stdout == drawn


def test_graph_does_not_write_over_rules(rules: Path, wrong: Path) -> None:
    before = rules.read_text()
    done = run("graph", rules, "--out", rules)
    assert done.returncode == 2
    assert done.stderr == f"rossmarie: {rules} would be a rules file; choose another --out\n"
    assert rules.read_text() == before
    done = run("graph", rules, "--out", rules / "below a file")
    assert done.returncode == 2
    assert done.stderr.startswith("rossmarie: cannot write ")


def test_graph_of_rules_with_errors(wrong: Path) -> None:
    done = run("graph", wrong)
    assert done.returncode == 1
    assert "error[ROSS101]" in done.stdout


# --- replay ----------------------------------------------------------------------------------

DRIVE = "time,on\n0.0,0\n1.0,1\n2.5,0\n3.0,0\n"


def test_replay_prints_a_table_and_writes_reports(rules: Path, tmp_path: Path) -> None:
    recording = tmp_path / "drive.csv"
    recording.write_text(DRIVE)
    done = run("replay", rules, recording, "--out", tmp_path / "out")
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stderr == ""
    assert "01.0  on, true since" in done.stdout
    lines = [
        json.loads(line) for line in (tmp_path / "out/verdicts.jsonl").read_text().splitlines()
    ]
    changes = [(line["time_s"], line["change"]) for line in lines[1:]]
    assert changes == [(1.0, "activated"), (2.5, "cleared")]
    assert lines[0]["monitor"] == "native"
    assert "<html" in (tmp_path / "out/timeline.html").read_text(encoding="utf-8")


def test_replay_without_a_compiler_says_so_and_finds_the_same(rules: Path, tmp_path: Path) -> None:
    recording = tmp_path / "drive.csv"
    recording.write_text(DRIVE)
    native = run("replay", rules, recording, "--out", tmp_path / "native")
    in_python = run("replay", rules, recording, "--out", tmp_path / "slow", CC="no-such-compiler")
    assert "no C compiler found" in in_python.stderr
    assert in_python.stdout.replace("slow", "native") == native.stdout
    one, other = (
        (tmp_path / kind / "verdicts.jsonl").read_text().splitlines() for kind in ("native", "slow")
    )
    assert one[1:] == other[1:]


def test_replay_of_what_is_no_recording(rules: Path, tmp_path: Path) -> None:
    assert run("replay", rules, tmp_path / "none.bag").returncode == 2
    broken = tmp_path / "broken.mcap"
    broken.write_bytes(b"no mcap at all")
    done = run("replay", rules, broken)
    assert done.returncode == 1
    assert "error[ROSS61" in done.stdout
    assert "Traceback" not in done.stderr


def test_replay_of_rules_with_errors(wrong: Path, tmp_path: Path) -> None:
    (tmp_path / "drive.csv").write_text(DRIVE)
    done = run("replay", wrong, tmp_path / "drive.csv")
    assert done.returncode == 1
    assert "error[ROSS101]" in done.stdout


def test_a_topic_map_leads_elsewhere(rules: Path, tmp_path: Path) -> None:
    recording = tmp_path / "drive.csv"
    recording.write_text(DRIVE.replace("time,on", "time,/bumper.data"))
    done = run("replay", rules, recording, "--topic-map", "/on=/bumper")
    assert done.returncode == 0
    assert "on, true since" in done.stdout


def test_a_defect_of_ours_is_called_that(rules: Path) -> None:
    program = (
        "import rossmarie.driver.analyze as analyze\n"
        "def broken(*a, **k): raise RuntimeError('oh')\n"
        "analyze.analyze_file = broken\n"
        "from rossmarie.cli.main import main\n"
        "main()\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", program, "check", str(rules)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 70
    assert done.stderr.startswith("error[ROSS900]: this is a defect of rossmarie")
