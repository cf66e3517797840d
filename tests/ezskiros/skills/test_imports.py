"""Modules that are imported to be checked: what they do, how long they take, where they are."""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros.driver import check_paths
from ezskiros.skills import load
from support.skill_files import (
    HEADER,
    SKILL,
    TYPO,
    VENDOR,
    WRONG,
    check_folder,
    checked,
    found,
    skill,
    warned,
)

pytestmark = pytest.mark.usefixtures("hall")


@pytest.mark.parametrize(
    ("line", "place"),
    [
        ("open('made', 'w').write('x')", "open('made', 'w')"),
        ("import subprocess as s; s.check_output(['true']) + b'x'", "s.check_output(['true'])"),
        ("import socket; socket.create_connection(('h', 1)).send(b'')",
         "socket.create_connection(('h', 1))"),
        ("import os; os.makedirs('made')", "os.makedirs('made')"),
        ("import time; time.sleep(100)", "time.sleep(100)"),
        ("import threading as t; t.Thread(target=print).start()", "t.Thread(target=print).start()"),
        ("class Port:\n    def __init__(self):\n        self.file = open('/dev/null')\nPort()",
         "open('/dev/null')"),
    ],
)  # fmt: skip
def test_a_module_does_nothing_when_it_is_imported(
    line: str, place: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    result = check_folder(tmp_path, skills=f"{line}\n{skill(WRONG)}")
    assert (warned(result), found(result)) == ([("EZS231", place)], [TYPO])
    assert [each.name for each in tmp_path.iterdir()] == ["own"]


def test_a_module_may_read_files_and_its_environment(tmp_path: Path) -> None:
    (tmp_path / "limits.json").write_text('{"heavy": 3.0}')
    text = (
        "import json, os\nfrom pathlib import Path\n"
        "os.environ['EZSKIROS_TEST'] = '1'\ndel os.environ['EZSKIROS_TEST']\n"
        "HERE = Path(__file__).parents[1]\nassert list(HERE.iterdir())\n"
        "HEAVY = json.loads((HERE / 'limits.json').read_text())['heavy']\n"
    )
    line = "self.pre_conditions += Object.Weight < HEAVY; self.pre_conditions += specified(Place)"
    result = check_folder(tmp_path, skills=text + skill(line))
    assert [(each.code, each.title) for each in result.diagnostics] == []


def test_what_other_modules_do_first_is_reported_as_well(tmp_path: Path) -> None:
    first = f"import time, serial\ntime.sleep(3)\n{HEADER}\nworld.skirso\n"
    result = check_folder(tmp_path, a="import b\nopen('made', 'w')\n", b=first)
    reported = [(each.code, each.primary.span.text) for each in result.diagnostics]
    assert sorted(reported) == [
        ("EZS004", "serial"),
        ("EZS110", "world.skirso"),
        ("EZS231", "open('made', 'w')"),
        ("EZS231", "time.sleep(3)"),
    ]


def test_a_namespace_that_is_not_there_is_shown_with_the_conditions_that_use_it() -> None:
    uses = SKILL.format(line="self.pre_conditions += skirs.at(Object, Place)")
    result = checked(f"{HEADER}\nskirs = world.skirs\n{uses}")
    (wrong,) = result.diagnostics
    assert (wrong.code, wrong.primary.span.text) == ("EZS110", "world.skirs")
    assert [(each.span.begin.line, each.span.text) for each in wrong.labels] == [(13, "skirs")]


def test_a_side_effect_that_cannot_be_replaced_is_an_error(tmp_path: Path) -> None:
    result = check_folder(
        tmp_path, a="for line in [1]:\n    exec('open(1, \"w\")')\n", b=skill(WRONG)
    )
    assert [code for code, _ in found(result)] == ["EZS003", "EZS301"]
    assert result.diagnostics[0].title.endswith("it opens a file")


def test_objects_of_drivers_are_replaced_by_what_their_classes_say(
    library: Path, tmp_path: Path
) -> None:
    (library / "vendor.py").write_text(VENDOR)
    text = "import vendor\narm = vendor.Arm('192.168.0.1')\nassert isinstance(arm, vendor.Arm)\n"
    fast = SKILL.format(line="if arm.speed() > 3: self.pre_conditions += Object.Weight")
    wrong = SKILL.format(line="arm.pose, arm.sped()").replace("Skill(", "Typo(")
    result = check_folder(tmp_path, skills=text + HEADER + fast + wrong)
    assert warned(result)[0] == ("EZS231", "vendor.Arm('192.168.0.1')")
    assert found(result) == [("EZS225", "arm.speed() > 3"), ("EZS220", "arm.sped")]


def test_clients_of_ros_are_not_used_even_if_they_are_installed(
    library: Path, tmp_path: Path
) -> None:
    (library / "rclpy.py").write_text("raise SystemExit('this is the real one')\n")
    (library / "planner.py").write_text("import rclpy\nrclpy.init()\n")
    text = f"import planner\nimport rclpy\nnode = rclpy.create_node('x')\n{skill(WRONG)}"
    result = check_folder(tmp_path, skills=text)
    assert (warned(result), found(result)) == ([("EZS233", "import planner")], [TYPO])


def waiting(seconds: str) -> str:
    """A module that waits in a call that nobody intercepts, and uses no processor."""
    return f"import select\nselect.select([], [], [], {seconds})\n"


def test_a_busy_machine_makes_no_import_endless(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(load, "SECONDS", 0.5)
    result = check_folder(tmp_path, a=waiting("1.0") + skill(WRONG))
    assert [each.code for each in result.diagnostics] == ["EZS301"]


def test_an_import_that_only_waits_comes_to_an_end(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(load, "SECONDS", 0.1)
    result = check_folder(tmp_path, a=waiting("None") + skill(WRONG))
    assert [each.code for each in result.diagnostics] == ["EZS232"]


def test_an_import_that_does_not_end_hides_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(load, "SECONDS", 0.3)
    loops = "while True:\n    try:\n        x = 1\n    except:\n        pass\n"
    result = check_folder(
        tmp_path, a="import loops\n", b=skill(WRONG), c="import loops\n", loops=loops
    )
    reported = [(Path(each.primary.span.file.path).stem, each) for each in result.diagnostics]
    codes = sorted((name, each.code) for name, each in reported)
    assert codes == [("b", "EZS301"), ("c", "EZS003"), ("loops", "EZS232")]
    assert dict(reported)["c"].primary.text == "the import of `loops` does not end"


# --- packages --------------------------------------------------------------------------------


def test_a_package_is_named_as_python_does(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "hall_skills" / "moving").mkdir(parents=True)
    for folder in ("hall_skills", "hall_skills/moving"):
        (tmp_path / folder / "__init__.py").write_text("raise ValueError('not run to find others')")
    (tmp_path / "hall_skills" / "moving" / "pick.py").write_text(skill(WRONG))
    (tmp_path / "lone_skills.py").write_text(skill(WRONG))
    monkeypatch.chdir(tmp_path)
    files = {
        name: [each.relative_to(tmp_path).as_posix() for each in load.module_files([Path(name)])]
        for name in ("hall_skills.moving.pick", "hall_skills.moving", "lone_skills", "no_skills")
    }
    assert files == {
        "hall_skills.moving.pick": ["hall_skills/moving/pick.py"],
        "hall_skills.moving": ["hall_skills/moving/__init__.py", "hall_skills/moving/pick.py"],
        "lone_skills": ["lone_skills.py"],
        "no_skills": [],
    }
    assert found(check_paths([Path("lone_skills")])) == [TYPO]


def test_nothing_of_python_itself_is_checked() -> None:
    assert load.module_files([Path("json"), Path("json.decoder")]) == []


@pytest.mark.parametrize(
    ("name", "has_help"), [("no_skills.pick", True), ("no_skills.py", False), ("a/b", False)]
)
def test_a_package_that_is_nowhere_is_reported(name: str, has_help: bool) -> None:
    (one,) = check_paths([Path(name)]).diagnostics
    assert (one.code, one.title) == ("EZS001", f"there is no file {name}")
    assert bool(one.help) == has_help


def test_skills_that_are_installed_do_nothing_either(
    library: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package = library / "hall_skills"
    package.mkdir()
    (package / "__init__.py").write_text("open('made', 'w')\n")
    (package / "tools.py").write_text("def wait():\n    open('made', 'w')\n")
    (package / "pick.py").write_text(
        f"from hall_skills import tools\n{skill(f'tools.wait(); {WRONG}')}"
    )
    monkeypatch.chdir(tmp_path)
    result = check_paths([Path("hall_skills.pick")])
    assert warned(result) == [("EZS231", "open('made', 'w')")]
    assert sorted(found(result)) == [("EZS221", "open('made', 'w')"), TYPO]
    assert not (tmp_path / "made").exists()
