"""`crosscheck weave`."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from crosscheck.cli.loading import loaded
from crosscheck.cli.output import output
from crosscheck.weaving import text_of, woven


def run_weave(
    rules: Path, out: Path, systems: Sequence[Path], message_folders: Sequence[Path]
) -> None:
    """Write the guards of skills, and report the rules that no skill waits for."""
    output.try_file(out)
    found = woven(loaded(rules, systems, message_folders))
    output.save(out, text_of(found))
    for rule, skills in found.left_out.items():
        output.complain(
            f"{' and '.join(skills)} will not wait for `{rule}`, because it depends on the "
            "running skills"
        )
    output.tell_written(out)
