"""`crosscheck weave`."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import typer

from crosscheck.cli.loading import loaded
from crosscheck.cli.output import output
from crosscheck.weaving import FORMAT, is_own, text_of, woven


def run_weave(
    rules: Path, out: Path, systems: Sequence[Path], message_folders: Sequence[Path]
) -> None:
    """Write the guards of skills, and report the rules that no skill waits for."""
    _refuse_foreign(out)
    output.try_file(out)
    found = woven(loaded(rules, systems, message_folders))
    output.save(out, text_of(found))
    for rule, skills in found.left_out.items():
        output.complain(
            f"{' and '.join(skills)} will not wait for `{rule}`: it asks about skills itself"
        )
    typer.echo(f"wrote {out}")


def _refuse_foreign(path: Path) -> None:
    if not path.is_file():
        return
    with output.writing(path), path.open("rb") as opened:
        start = opened.read(len(FORMAT) + 100)
    if not is_own(start):
        output.fail(
            f"{path} is not overwritten: `crosscheck weave` has not written it", exit_code=2
        )
