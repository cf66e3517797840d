"""`rossmarie build`: the files of a target."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import typer

from dslkit.options import Format
from dslkit.ownership import Comment
from dslkit.writing import reason
from rossmarie.cli.output import output
from rossmarie.cli.written import lines_of_written
from rossmarie.driver import RulesError
from rossmarie.driver.build import TARGETS, Built, build_files
from rossmarie.driver.manifest import DescribedManifest, describe
from rossmarie.driver.ownership import ForeignFileError
from rossmarie.driver.package_xml import BadPackageXmlError
from rossmarie.ir import Category
from rossmarie.report.review import render_review
from rossmarie.targets.manifest import OWN_PACKAGE, Maintainer, Placement


@dataclass(frozen=True)
class PackageOptions:
    """The command line options for the package of a node."""

    licenses: tuple[str, ...]
    maintainers: tuple[Maintainer, ...]
    part_of: str | None

    def given(self) -> list[str]:
        """The options that were used."""
        used = {
            "--license": self.licenses,
            "--maintainer": self.maintainers,
            "--part-of": self.part_of,
        }
        return [option for option, value in used.items() if value]


def run_build(
    rules: Path,
    out: Path,
    target: str,
    package: PackageOptions,
    name: str | None,
    sources: Path | None,
    review: Path | None,
    systems: Sequence[Path],
    message_folders: Sequence[Path],
    only: Sequence[Category],
) -> None:
    """Write the files of a target into `out`, and print the next steps."""
    output.try_folder(out)
    for path in (sources, review):
        if path is not None and path.parent.is_dir():
            output.try_file(path)
        elif path is not None:
            output.try_folder(path.parent)
    if review is not None and target == "python":
        output.fail("--review is for targets in C: c99, ros1 and ros2", exit_code=2)
    described, placement = _placement(rules, target, package)
    try:
        with output.writing_to(out):
            built = build_files(
                rules,
                target,
                out,
                systems=systems,
                message_folders=message_folders,
                only=only,
                name=name,
                placement=placement,
                replaces_others=output.permission.is_given,
            )
    except RulesError as error:
        output.reject(error.diagnostics)
    except ForeignFileError as error:
        output.fail(f"{error}; choose another --out, or replace it with --force", exit_code=2)
    if sources is not None:
        _make_folder_of(sources)
        paths = [f"{Path(each.path).absolute()}\n" for each in built.sources]
        output.save(sources, "".join(paths), Comment.HASH)
    _tell(built, described)
    if review is not None:
        _make_folder_of(review)
        output.save(review, render_review(built.sources, built.own_code))
        output.tell_written(review)


def _make_folder_of(path: Path) -> None:
    with output.writing_to(path.parent):
        path.parent.mkdir(parents=True, exist_ok=True)


def _placement(
    rules: Path, target: str, package: PackageOptions
) -> tuple[DescribedManifest | None, Placement]:
    """The place of the node, and the description of its package if it has one of its own."""
    given = package.given()
    if not TARGETS[target].is_package:
        if given:
            output.fail(f"{given[0]} needs --target ros1 or ros2", exit_code=2)
        return None, OWN_PACKAGE
    if package.part_of is not None:
        if given != ["--part-of"]:
            reported = (
                f"leave out {given[0]} with --part-of: edit the package.xml of {package.part_of}"
            )
            output.fail(reported, exit_code=2)
        return None, Placement(part_of=package.part_of)
    try:
        described = describe(rules, package.licenses, package.maintainers)
    except BadPackageXmlError as error:
        output.reject((error.diagnostic,))
    except OSError as error:
        output.fail(f"cannot read {error.filename}: {reason(error)}", exit_code=2)
    return described, Placement(described.manifest)


def _tell(built: Built, described: DescribedManifest | None) -> None:
    """Print the warnings, the written files, the missing package fields, and the next steps."""
    output.print_diagnostics(built.warnings, Format.TEXT, file_count=1)
    for line in lines_of_written(built.written):
        typer.echo(line)
    if built.left_out:
        typer.echo(f"left out: {', '.join(built.left_out)}")
    if described is not None and described.missing:
        options = " and ".join(f"--{field}" for field in described.missing)
        typer.echo(
            f"package.xml names no {' and no '.join(described.missing)}: "
            f"give {options}, or put a complete package.xml next to the rules"
        )
    if built.next_step:
        typer.echo(built.next_step)
