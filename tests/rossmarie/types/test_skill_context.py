"""The messages of skills are known without files, and are those of the packages in `ros`."""

from __future__ import annotations

from pathlib import Path

import pytest

from dslkit.source import SourceFile
from rossmarie.types import MessageCatalog
from rossmarie.types.definitions import own_texts, parse_file, read_stored

ROS = Path(__file__).parents[3] / "ros"
NAMES = (
    "RunningSkill", "SkillAhead", "SkillArgument", "SkillContext", "SkillPermission",
    "SkillProperty",
)  # fmt: skip


@pytest.mark.parametrize("generation", ["ros1", "ros2"])
def test_packages_have_the_messages_that_are_known(generation: str) -> None:
    folder = ROS / generation / "skill_context_msgs" / "msg"
    assert sorted(path.stem for path in folder.iterdir()) == sorted(NAMES)
    for name in NAMES:
        full = f"skill_context_msgs/{name}"
        path = folder / f"{name}.msg"
        source = SourceFile(str(path), path.read_text(encoding="utf-8"))
        assert parse_file(source, full) == read_stored(full)
        assert list(parse_file(source, full).fields) == _fields_of(full)


def _fields_of(name: str) -> list[str]:
    return [line.split()[1] for line in own_texts()[name].splitlines()]


def test_rules_need_no_messages_item() -> None:
    context = MessageCatalog().find("skill_context_msgs/SkillContext")
    assert context is not None
    assert set(context.fields) == {"header", "digest", "running", "ahead", "is_ahead_known"}


def test_no_field_is_a_word_of_a_language() -> None:
    """A generator of C++ or Python would have to call it otherwise."""
    words = {"export", "with", "class", "default", "from", "template", "import", "operator"}
    assert not words & {field for name in own_texts() for field in _fields_of(name)}
