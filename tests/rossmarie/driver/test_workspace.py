"""Files are found and read; what cannot be read is a finding."""

from __future__ import annotations

from pathlib import Path

import pytest

from rossmarie.driver import CheckResult, check_file
from rossmarie.driver.formatting import Formatted, format_file
from rossmarie.driver.workspace import LIBRARY

ACTION = "action stop;\n"
RULE = "input on = topic /on : std_msgs/Bool timeout 1 sec\nrule it: if on then { stop; };\n"


def codes(result: CheckResult) -> list[str]:
    return [found.code for found in result.diagnostics]


def test_imports_are_followed_from_file_to_file(tmp_path: Path) -> None:
    (tmp_path / "library").mkdir()
    (tmp_path / "library" / "actions.ross").write_text(ACTION)
    (tmp_path / "middle.ross").write_text('import "library/actions.ross";')
    main = tmp_path / "main.ross"
    main.write_text(f'import "middle.ross";\n{RULE}')
    result = check_file(main)
    assert codes(result) == []
    assert result.program is not None
    assert [Path(module.file.path).name for module in result.modules] == [
        "actions.ross",
        "middle.ross",
        "main.ross",
    ]


def test_files_that_import_each_other_are_read_once(tmp_path: Path) -> None:
    (tmp_path / "a.ross").write_text(f'import "b.ross";\n{ACTION}')
    (tmp_path / "b.ross").write_text(f'import "a.ross";\nimport "b.ross";\n{RULE}')
    result = check_file(tmp_path / "a.ross")
    assert codes(result) == []
    assert len(result.modules) == 2


def test_a_long_chain_of_imports_is_followed(tmp_path: Path) -> None:
    for number in range(1500):
        (tmp_path / f"{number}.ross").write_text(f'import "{number + 1}.ross";')
    (tmp_path / "1500.ross").write_text(ACTION + RULE)
    assert check_file(tmp_path / "0.ross").program is not None


def test_a_missing_import_is_found_where_it_is_named(tmp_path: Path) -> None:
    (tmp_path / "actions.ross").write_text(ACTION)
    main = tmp_path / "main.ross"
    main.write_text('import "action.ross";\n')
    (found,) = check_file(main).diagnostics
    assert (found.code, found.primary.span.text) == ("ROSS803", '"action.ross"')
    assert found.help == "did you mean `actions.ross`?"


def test_the_system_model_of_a_folder_needs_no_import(tmp_path: Path) -> None:
    (tmp_path / "system.ross").write_text("system s { topic Stop = /on : std_msgs/Bool; }")
    main = tmp_path / "main.ross"
    main.write_text(
        f"{ACTION}input on = topic Stop timeout 1 sec\nrule it: if on then {{ stop; }};"
    )
    assert codes(check_file(main)) == []
    (tmp_path / "system.ross").unlink()
    assert codes(check_file(main)) == ["ROSS110"]


def test_a_named_system_model_is_used(tmp_path: Path) -> None:
    model = tmp_path / "robot.ross"
    model.write_text("system s { topic Stop = /on : std_msgs/Bool; }")
    main = tmp_path / "main.ross"
    main.write_text(
        f"{ACTION}input on = topic Stop timeout 1 sec\nrule it: if on then {{ stop; }};"
    )
    assert codes(check_file(main, systems=[model])) == []


def test_the_main_file_is_last_whatever_imports_it(tmp_path: Path) -> None:
    """The program is named after it."""
    main = tmp_path / "main.ross"
    main.write_text(ACTION + RULE)
    (tmp_path / "system.ross").write_text('import "main.ross";')
    robot = tmp_path / "robot.ross"
    robot.write_text('import "main.ross";')
    result = check_file(main, systems=[robot])
    assert [Path(module.file.path).name for module in result.modules] == [
        "robot.ross",
        "system.ross",
        "main.ross",
    ]
    assert result.program is not None
    assert result.program.name == "main"


def test_links_that_lead_in_a_circle_cannot_be_read(tmp_path: Path) -> None:
    (tmp_path / "one.ross").symlink_to("other.ross")
    (tmp_path / "other.ross").symlink_to("one.ross")
    assert codes(check_file(tmp_path / "one.ross")) == ["ROSS801"]
    main = tmp_path / "main.ross"
    main.write_text(f'import "one.ross";\n{ACTION}{RULE}')
    assert codes(check_file(main)) == ["ROSS803"]


def test_what_is_not_there_cannot_be_read(tmp_path: Path) -> None:
    assert codes(check_file(tmp_path / "none.ross")) == ["ROSS801"]
    assert codes(check_file(tmp_path)) == ["ROSS801"]


def test_a_folder_is_answered_with_a_rules_file_in_it(tmp_path: Path) -> None:
    (found,) = check_file(tmp_path).diagnostics
    assert found.primary.text == "this is a folder"
    assert found.help == "name one rules file"
    (tmp_path / "b.ross").write_text("")
    (tmp_path / "a.ross").write_text("")
    (found,) = check_file(tmp_path).diagnostics
    assert found.help == f"name one rules file, for example `{tmp_path / 'a.ross'}`"


def test_a_misspelt_file_is_answered_with_the_similar_one(tmp_path: Path) -> None:
    (tmp_path / "rules.ross").write_text("")
    (found,) = check_file(tmp_path / "rulse.ross").diagnostics
    assert found.help == f"did you mean `{tmp_path / 'rules.ross'}`?"


def test_a_path_that_nothing_resembles_is_to_be_checked(tmp_path: Path) -> None:
    for path in (tmp_path / "none.ross", tmp_path / "no_folder" / "none.ross", tmp_path / "a\0b"):
        (found,) = check_file(path).diagnostics
        assert found.help == "check the path and the read permission of the file"


@pytest.mark.parametrize(
    ("content", "line", "column"),
    [
        (b"action stop;\n// caf\xe9\n", 2, 7),
        (b"\xff\xfe", 1, 1),
        ("// ünter\n".encode() + b"\xfc", 2, 1),
    ],
)
def test_text_in_another_encoding_is_located(
    tmp_path: Path, content: bytes, line: int, column: int
) -> None:
    main = tmp_path / "main.ross"
    main.write_bytes(content)
    (found,) = check_file(main).diagnostics
    assert found.code == "ROSS802"
    assert (found.primary.span.begin.line, found.primary.span.begin.column) == (line, column)


def test_binary_files_are_called_that(tmp_path: Path) -> None:
    main = tmp_path / "main.ross"
    main.write_bytes(b"\x7fELF\x02\x01\x01\x00\x00\xff\xff")
    (found,) = check_file(main).diagnostics
    assert "a binary file" in found.notes[0]


@pytest.mark.parametrize(
    ("name", "content", "kind"),
    [
        ("code.py", "import os\n\nos.system('x')\n", "a Python file"),
        ("robot.launch", '<launch>\n  <node name="x"/>\n</launch>\n', "an XML file"),
        ("rules.ross", "\n <!DOCTYPE html>\n<html></html>\n", "a web page"),
        ("rules.ross", '{"rules": []}', "a JSON file"),
        ("rules.txt", "#!/bin/sh\n", "a script"),
        ("nothing.yaml", "", "a YAML file"),
    ],
)
def test_a_file_of_another_kind_is_called_that_and_nothing_else(
    tmp_path: Path, name: str, content: str, kind: str
) -> None:
    main = tmp_path / name
    main.write_text(content)
    (found,) = check_file(main).diagnostics
    assert (found.code, f"is {kind}, not a rules file" in found.title) == ("ROSS810", True)


def test_a_page_that_was_saved_in_the_place_of_rules(tmp_path: Path) -> None:
    (tmp_path / "rules.ross").write_text("<html>\n")
    (found,) = check_file(tmp_path / "rules.ross").diagnostics
    assert found.help is not None
    assert "raw" in found.help


def test_rules_may_have_any_other_name(tmp_path: Path) -> None:
    (tmp_path / "rules.txt").write_text(ACTION + RULE)
    assert codes(check_file(tmp_path / "rules.txt")) == []


def test_a_byte_order_mark_does_no_harm(tmp_path: Path) -> None:
    main = tmp_path / "main.ross"
    main.write_bytes(b"\xef\xbb\xbf" + (ACTION + RULE).encode())
    assert codes(check_file(main)) == []


def test_a_huge_file_is_refused_by_its_size(tmp_path: Path) -> None:
    main = tmp_path / "main.ross"
    main.write_text("// " + "ä" * 3_000_000)
    result = check_file(main)
    assert len(result.diagnostics) == 1
    assert result.program is None
    assert len(result.modules[-1].file.text) < 2_000_000


def test_the_library_is_found_anywhere(tmp_path: Path) -> None:
    main = tmp_path / "main.ross"
    main.write_text(f'import "rossmarie/deros.ross";\n{RULE}')
    result = check_file(main)
    assert codes(result) == []
    assert Path(result.modules[0].file.path) == LIBRARY / "deros.ross"


def test_a_file_of_ones_own_takes_the_place_of_the_library(tmp_path: Path) -> None:
    (tmp_path / "rossmarie").mkdir()
    own = tmp_path / "rossmarie" / "deros.ross"
    own.write_text(ACTION)
    main = tmp_path / "main.ross"
    main.write_text(f'import "rossmarie/deros.ross";\n{RULE}')
    result = check_file(main)
    assert codes(result) == []
    assert Path(result.modules[0].file.path) == own


def test_nothing_beside_the_library_is_found_by_its_name(tmp_path: Path) -> None:
    main = tmp_path / "main.ross"
    main.write_text('import "rossmarie/../rossmarie/deros.ross";\nimport "rossmarie/derso.ross";\n')
    result = check_file(main)
    assert codes(result)[:2] == ["ROSS803", "ROSS803"]
    assert result.diagnostics[1].help == "did you mean `deros.ross`?"


def test_folders_of_the_library_are_found(tmp_path: Path) -> None:
    main = tmp_path / "main.ross"
    main.write_text('import "rossmarie/base/tilt.ross";\n')
    result = check_file(main)
    assert codes(result) == []
    assert [Path(module.file.path) for module in result.modules[:-1]] == [
        LIBRARY / "deros.ross",
        LIBRARY / "base" / "tilt.ross",
    ]


def test_a_name_beside_one_in_a_folder_of_the_library_is_proposed(tmp_path: Path) -> None:
    main = tmp_path / "main.ross"
    main.write_text('import "rossmarie/base/tlit.ross";\nimport "rossmarie/base/../tilt.ross";\n')
    result = check_file(main)
    assert codes(result) == ["ROSS803", "ROSS803"]
    assert result.diagnostics[0].help == "did you mean `tilt.ross`?"


def test_the_library_uses_a_copy_of_its_own_files_beside_the_rules(tmp_path: Path) -> None:
    (tmp_path / "rossmarie").mkdir()
    own = tmp_path / "rossmarie" / "deros.ross"
    own.write_text((LIBRARY / "deros.ross").read_text().replace("/cmd_vel", "/robot/cmd_vel"))
    main = tmp_path / "main.ross"
    main.write_text('import "rossmarie/base/tilt.ross";\n')
    result = check_file(main)
    assert codes(result) == []
    assert Path(result.modules[0].file.path) == own


@pytest.mark.parametrize(
    "path",
    sorted(LIBRARY.rglob("*.ross")),
    ids=lambda path: path.relative_to(LIBRARY).as_posix(),
)
def test_the_library_is_in_the_one_layout(path: Path) -> None:
    formatted = format_file(path)
    assert isinstance(formatted, Formatted)
    assert not formatted.has_changed
