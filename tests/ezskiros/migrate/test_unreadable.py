"""Texts that the parser of the migration takes, and Python does not."""

from __future__ import annotations

import pytest

from ezskiros.migrate.module import migrate_text

SKILL = """\
class Wait(SkillDescription):
    def createDescription(self):
        self.addParam({key}, 0.5, ParamTypes.Required)
"""


@pytest.mark.parametrize(
    ("key", "said", "place"),
    [
        ('"Wait\0"', "a byte is 0", "\0"),
        ('"Wait\\x"', "(unicode error) 'unicodeescape' codec can't decode bytes", "self.addP"),
        ('"\\N{NO NAME}"', "(unicode error) 'unicodeescape' codec can't decode bytes", "self.addP"),
    ],
    ids=["a byte that is 0", "half an escape", "a name of no character"],
)
def test_a_text_that_python_refuses_is_left(key: str, said: str, place: str) -> None:
    text = SKILL.format(key=key)
    found = migrate_text("skills.py", text)
    (only,) = found.diagnostics
    assert (only.code, found.text) == ("EZS701", text)
    assert said in only.title
    assert only.primary.span.text.startswith(place)
