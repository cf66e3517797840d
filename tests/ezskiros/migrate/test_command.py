"""`ezskiros migrate`, as a shell calls it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from ezskiros.cli.main import app
from ezskiros.migrate.files import migrate_paths
from support.golden import assert_golden

HERE = Path(__file__).parent
GOOD = """\
from skiros2_skill.core.skill import SkillDescription
from skiros2_common.core.params import ParamTypes


class Wait(SkillDescription):
    def createDescription(self):
        self.addParam("Duration", 0.0, ParamTypes.Required)
"""
LEFT = GOOD.replace("0.0", "dict")
DONE = """\
from ezskiros import SkillDescription


class Wait(SkillDescription):
    def description(self, Duration: float = 0.0):
        pass
"""


def migrate(*arguments: str | Path) -> Result:
    return CliRunner().invoke(app, ["migrate", *map(str, arguments)])


def written(path: Path, text: str | bytes) -> Path:
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def test_without_options_nothing_is_written(tmp_path: Path) -> None:
    path = written(tmp_path / "wait.py", GOOD)
    result = migrate(path)
    assert result.stdout == (
        "1 description: 1 translated, 0 left as they are; 1 file to be written\n"
    )
    assert result.exit_code == 0
    assert path.read_text() == GOOD


def test_files_are_written(tmp_path: Path) -> None:
    good, left = written(tmp_path / "a.py", GOOD), written(tmp_path / "b.py", LEFT)
    other = written(tmp_path / "c.py", "x = 1\n")
    result = migrate(tmp_path, "--write")
    assert result.exit_code == 1
    assert result.stdout.splitlines()[-1] == (
        "2 descriptions: 1 translated, 1 left as they are; 2 files written"
    )
    assert "error[EZS704]: the parameter `Duration` is a dict" in result.stdout
    assert good.read_text() == DONE
    assert "        # EZS704: the parameter `Duration` is a dict" in left.read_text()
    assert other.read_text() == "x = 1\n"
    assert "0 files written" in migrate(tmp_path, "--write").stdout


def test_what_is_repaired_is_translated_the_next_time(tmp_path: Path) -> None:
    path = written(tmp_path / "wait.py", LEFT)
    migrate(path, "--write")
    path.write_text(path.read_text().replace("dict,", "0.0,"))
    assert migrate(path, "--write").exit_code == 0
    assert path.read_text() == DONE


def test_a_diff_is_one_that_patch_takes(tmp_path: Path, bless: bool) -> None:
    text = (HERE / "before" / "fetch.txt").read_text()
    path = written(tmp_path / "fetch.py", text)
    result = migrate(path, "--diff")
    assert result.exit_code == 0
    assert path.read_text() == text
    assert "3 translated" in result.stderr
    subprocess.run(["patch", "--quiet", path], input=result.stdout, text=True, check=True)
    assert path.read_text() == (HERE / "after" / "fetch.txt").read_text()
    shown = result.stdout.replace(path.as_posix().lstrip("/"), "fetch.py")
    assert_golden(HERE / "after" / "fetch.diff", shown, bless=bless)


def test_a_file_without_an_end_of_line_has_a_diff(tmp_path: Path) -> None:
    path = written(tmp_path / "wait.py", GOOD.rstrip())
    subprocess.run(
        ["patch", "--quiet", path], input=migrate(path, "--diff").stdout, text=True, check=True
    )
    assert path.read_text() == migrate_text_of(GOOD.rstrip(), tmp_path)


def migrate_text_of(text: str, folder: Path) -> str:
    (file,) = migrate_paths([written(folder / "other.py", text)]).files
    return file.migrated.text


def test_the_world_has_a_name(tmp_path: Path) -> None:
    path = written(tmp_path / "fetch.py", (HERE / "before" / "fetch.txt").read_bytes())
    migrate(path, "--write", "--world", "..hall.world")
    assert "\nfrom ..hall.world import rparts, skiros, sumo\n" in path.read_text()


def test_an_ontology_says_which_names_are_ambiguous(tmp_path: Path) -> None:
    for name in ("skiros", "store"):
        written(
            tmp_path / f"{name}.ttl",
            f"@prefix : <http://example.org/{name}.owl#> .\n"
            "@prefix owl: <http://www.w3.org/2002/07/owl#> .\n"
            ":at a owl:ObjectProperty . :Location a owl:Class .\n",
        )
    place = 'self.addParam("Place", Element("skiros:Location"), ParamTypes.Required)'
    at = 'self.addPreCondition(self.getRelationCond("", "skiros:at", "Place", "Place", True))'
    path = written(tmp_path / "wait.py", f"{GOOD}        {place}\n        {at}\n")
    assert "+= Place.at(Place)\n" in migrate(path, "--diff").stdout
    one = tmp_path / "skiros.ttl"
    assert "+= Place.at(Place)\n" in migrate(path, "--diff", "--ontology", one).stdout
    result = migrate(path, "--diff", "--ontology", tmp_path)
    assert "+= skiros.at(Place, Place)\n" in result.stdout
    assert result.exit_code == 0


def test_an_ontology_that_cannot_be_read(tmp_path: Path) -> None:
    path = written(tmp_path / "wait.py", GOOD)
    broken = written(tmp_path / "broken.ttl", "broken")
    result = migrate(path, "--write", "--ontology", broken)
    assert result.exit_code == 1
    assert "error[EZS10" in result.stdout
    assert migrate(path, "--write", "--ontology", tmp_path / "nowhere").exit_code == 2
    assert path.read_text() == GOOD


@pytest.mark.parametrize("world", ["", ".", "my world", "a..b", "class"])
def test_a_world_that_is_no_module_is_refused(world: str, tmp_path: Path) -> None:
    path = written(tmp_path / "wait.py", GOOD)
    result = migrate(path, "--world", world, "--write")
    if world == ".":
        assert result.exit_code == 0  # the package that the skills are in
        return
    assert result.exit_code == 2
    assert "is not the name of a Python module" in result.stderr
    assert path.read_text() == GOOD


def test_write_and_diff_exclude_each_other(tmp_path: Path) -> None:
    path = written(tmp_path / "wait.py", GOOD)
    assert migrate(path, "--write", "--diff").exit_code == 2
    assert path.read_text() == GOOD


def test_line_ends_and_encodings_stay(tmp_path: Path) -> None:
    text = "# -*- coding: latin-1 -*-\n# Größe\n" + GOOD
    path = written(tmp_path / "wait.py", text.replace("\n", "\r\n").encode("latin-1"))
    assert migrate(path, "--write").exit_code == 0
    after = "# -*- coding: latin-1 -*-\n# Größe\n" + DONE
    assert path.read_bytes() == after.replace("\n", "\r\n").encode("latin-1")


def test_a_byte_order_mark_stays(tmp_path: Path) -> None:
    path = written(tmp_path / "wait.py", GOOD.encode("utf-8-sig"))
    assert migrate(path, "--write").exit_code == 0
    assert path.read_bytes() == DONE.encode("utf-8-sig")


def test_files_indent_as_they_do(tmp_path: Path) -> None:
    path = written(tmp_path / "wait.py", GOOD.replace("    ", "\t"))
    assert migrate(path, "--write").exit_code == 0
    assert path.read_text() == DONE.replace("    ", "\t")


@pytest.mark.parametrize(
    "content", [b"def broken(:\n", b"print 'two'\n", b"# \xff\n", b"x = \x00\n"]
)
def test_what_cannot_be_read_does_not_hide_the_rest(content: bytes, tmp_path: Path) -> None:
    broken, good = written(tmp_path / "a.py", content), written(tmp_path / "b.py", GOOD)
    result = migrate(tmp_path, "--write")
    assert result.exit_code == 1
    assert "error[EZS701]" in result.stdout
    assert result.stdout.endswith("; 1 file written; 1 file cannot be read\n")
    assert broken.read_bytes() == content
    assert good.read_text() == DONE


def test_a_description_that_another_file_builds_on_is_left(tmp_path: Path) -> None:
    written(tmp_path / "a.py", GOOD)
    derived = GOOD.replace("Wait(SkillDescription)", "Rest(Wait)")
    written(tmp_path / "b.py", f"from .a import Wait\n{derived}")
    result = migrate(tmp_path)
    assert "`Wait` is the base of a description elsewhere" in result.stdout
    assert "2 descriptions: 0 translated, 2 left as they are" in result.stdout


def test_a_path_that_leads_nowhere(tmp_path: Path) -> None:
    result = migrate(tmp_path / "nowhere.py")
    assert result.exit_code == 2
    assert "error[EZS001]" in result.stdout


def test_a_file_that_cannot_be_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = written(tmp_path / "wait.py", GOOD)

    def refuse(*_arguments: object) -> int:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(os, "fsync", refuse)
    result = migrate(path, "--write")
    assert result.exit_code == 2
    assert f"cannot write {path}: permission denied" in result.stderr


def test_other_commands_do_without_libcst() -> None:
    code = "import sys, ezskiros.cli.main, ezskiros.catalog; sys.exit('libcst' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
