"""A proposed change of rules or skills cannot read other files of the machine that checks it.
Messages quote no file of another kind.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from support import command_line
from support.skills import ONTOLOGY

SECRET = "admin:hunter2:19000:0:99999:7:::\ndaemon:hunter2:1:\n"
RULES = "action stop;\ninput on = topic /on : std_msgs/Bool timeout 1 sec\n"
SKILL = "from ezskiros import SkillDescription\n\nclass A(SkillDescription):\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "shadow").write_text(SECRET)
    return tmp_path


def is_reported(folder: Path, *command: str, code: str) -> bool:
    """Say whether a command reports the mistake and prints none of the secret text."""
    done = command_line.run(*command, folder=folder)
    said = done.stdout + done.stderr
    assert done.returncode in (1, 2)
    assert "hunter2" not in said
    assert "admin" not in said
    assert "daemon" not in said
    return f"error[{code}]" in said


def test_rules_that_import_another_file(folder: Path) -> None:
    (folder / "rules.ross").write_text(f'import "shadow";\n{RULES}')
    assert is_reported(folder, "rossmarie", "check", "rules.ross", code="ROSS809")


@pytest.mark.parametrize("name", ["system.ross", "imported.ross", "rules.ross"])
def test_rules_that_are_a_link_to_another_file(folder: Path, name: str) -> None:
    (folder / "rules.ross").write_text(f'import "imported.ross";\n{RULES}')
    (folder / "imported.ross").write_text("action go;\n")
    (folder / name).unlink(missing_ok=True)
    (folder / name).symlink_to(folder / "shadow")
    assert is_reported(folder, "rossmarie", "check", "rules.ross", code="ROSS809")


def test_a_system_model_that_is_none(folder: Path) -> None:
    (folder / "rules.ross").write_text(RULES)
    words = ("check", "rules.ross", "--system", "shadow")
    assert is_reported(folder, "rossmarie", *words, code="ROSS809")


def test_rules_may_be_links_to_rules(folder: Path) -> None:
    (folder / "rules.ross").write_text(RULES + "rule it: if on then { stop; };\n")
    (folder / "link.ross").symlink_to(folder / "rules.ross")
    assert command_line.run("rossmarie", "check", "link.ross", folder=folder).returncode == 0


@pytest.mark.parametrize("suffix", [".csv", ".mcap", ".bag", ".db3"])
def test_a_recording_that_is_a_link_to_another_file(folder: Path, suffix: str) -> None:
    (folder / "rules.ross").write_text(RULES + "rule it: if on then { stop; };\n")
    (folder / f"drive{suffix}").symlink_to(folder / "shadow")
    code = "ROSS620" if suffix == ".csv" else "ROSS614"
    words = ("replay", "rules.ross", f"drive{suffix}")
    assert is_reported(folder, "rossmarie", *words, code=code)


def test_a_message_definition_that_is_a_link_to_another_file(folder: Path) -> None:
    message = folder / "messages" / "secret_msgs" / "msg" / "X.msg"
    message.parent.mkdir(parents=True)
    message.symlink_to(folder / "shadow")
    (folder / "rules.ross").write_text(
        "action stop;\ninput on = topic /on : secret_msgs/X .data timeout 1 sec\n"
        "rule it: if on then { stop; };\n"
    )
    words = ("check", "rules.ross", "--messages", "messages")
    assert is_reported(folder, "rossmarie", *words, code="ROSS116")


def test_a_package_xml_that_is_a_link_to_another_file(folder: Path) -> None:
    (folder / "rules.ross").write_text(
        RULES.replace("stop;", "stop { log error 'x'; }") + "rule it: if on then { stop; };\n"
    )
    (folder / "package.xml").symlink_to(folder / "shadow")
    words = ("build", "rules.ross", "--target", "ros2", "--out", "made")
    assert is_reported(folder, "rossmarie", *words, code="ROSS807")


@pytest.mark.parametrize("kind", ["coverage", "verification"])
def test_a_report_that_is_none(folder: Path, kind: str) -> None:
    (folder / "rules.ross").write_text(RULES + "rule it: if on then { stop; };\n")
    words = ("report", "rules.ross", f"--{kind}", "shadow")
    assert is_reported(folder, "rossmarie", *words, code="ROSS781")


@pytest.mark.parametrize("name", ["shadow", "world.ttl", "world.owl", "world.jsonld"])
def test_an_ontology_that_is_another_file(folder: Path, name: str) -> None:
    if name != "shadow":
        (folder / name).symlink_to(folder / "shadow")
    words = ("stubs", "--ontology", name, "--out", "world.pyi")
    assert is_reported(folder, "ezskiros", *words, code="EZS101")


def test_a_scene_that_is_a_link_to_another_file(folder: Path) -> None:
    (folder / "lab.turtle").symlink_to(folder / "shadow")
    (folder / "skills.py").write_text(f"{SKILL}    def description(self): pass\n")
    words = ("check", "skills.py", "lab.turtle", "--ontology", str(ONTOLOGY))
    assert is_reported(folder, "ezskiros", *words, code="EZS101")


@pytest.mark.parametrize("name", ["shadow", "link.py"])
def test_skills_that_are_another_file(folder: Path, name: str) -> None:
    (folder / "link.py").symlink_to(folder / "shadow")
    assert is_reported(folder, "ezskiros", "check", name, code="EZS003")


@pytest.mark.parametrize("name", ["shadow", "values.yaml"])
def test_values_that_are_another_file(folder: Path, name: str) -> None:
    (folder / "values.yaml").symlink_to(folder / "shadow")
    (folder / "skills.py").write_text(f"{SKILL}    def description(self): pass\n")
    words = ("check", "skills.py", "--config", name)
    assert is_reported(folder, "ezskiros", *words, code="EZS511")
