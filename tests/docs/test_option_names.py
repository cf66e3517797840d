"""One option name has one meaning in all programs: `docs/reference/options.md` lists the names."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import typer

import crosscheck.cli.main
import ezskiros.cli.main
import heron.cli.main
import rossmarie.cli.main

PAGE = Path(__file__).parents[2] / "docs" / "reference" / "options.md"
APPS = {
    "rossmarie": rossmarie.cli.main.app,
    "ezskiros": ezskiros.cli.main.app,
    "crosscheck": crosscheck.cli.main.app,
    "heron": heron.cli.main.app,
}
ROW = re.compile(
    r"\| (?P<names>`-[^|]+) \| (?P<value>[^|]*) \| (?P<meaning>[^|]*) \| (?P<users>.*) \|"
)


def commands(app: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """All commands of a program, those of groups as well, with their names."""
    for name, command in app.commands.items():
        if hasattr(command, "commands"):
            yield from commands(command, f"{path}{name} ")
        else:
            yield f"{path}{name}", command


def value_of(option: Any) -> str:
    """The kind of the value of an option, in a word."""
    if option.is_flag:
        return ""
    if option.metavar and "|" not in option.metavar:
        return f"`{option.metavar}`"
    return "a number" if option.type_descriptor.annotation in (int, float) else "a word"


def used() -> dict[str, tuple[set[str], str]]:
    """The options by their names: the kinds of their values, and the commands."""
    kinds: dict[str, set[str]] = {}
    users: dict[str, dict[str, list[str]]] = {}
    for program, app in APPS.items():
        for name, command in commands(typer.main.get_command(app)):
            for option in command.params:
                if option.param_type_name == "option" and "--help" not in option.opts:
                    spelt = sorted([*option.opts, *option.secondary_opts], key=len)
                    names = ", ".join(f"`{each}`" for each in spelt)
                    kinds.setdefault(names, set()).add(value_of(option))
                    users.setdefault(names, {}).setdefault(program, []).append(name)
    return {
        names: (
            kinds[names],
            "; ".join(f"{program}: {', '.join(each)}" for program, each in users[names].items()),
        )
        for names in sorted(kinds, key=lambda names: names.lstrip("`-"))
    }


def described() -> dict[str, re.Match[str]]:
    """The rows of the page."""
    lines = PAGE.read_text(encoding="utf-8").splitlines()
    return {row["names"]: row for row in filter(None, map(ROW.fullmatch, lines))}


def test_the_page_lists_all_options_and_their_commands(bless: bool) -> None:
    rows = described()
    meanings = {names: row["meaning"] for names, row in rows.items()}
    table = [
        f"| {names} | {' or '.join(sorted(kinds))} | {meanings.get(names, '')} | {users} |"
        for names, (kinds, users) in used().items()
    ]
    text = PAGE.read_text(encoding="utf-8")
    head, rule, _ = text.partition("| --- | --- | --- | --- |\n")
    wanted = f"{head}{rule}" + "\n".join(table) + "\n"
    if bless:
        PAGE.write_text(wanted, encoding="utf-8")
        return
    assert text == wanted
    assert all(meanings.values())


@pytest.mark.parametrize("names", [names for names in used() if "`--out`" not in names])
def test_an_option_takes_one_kind_of_value(names: str) -> None:
    kinds, _ = used()[names]
    assert len(kinds) == 1


@pytest.mark.parametrize("program", APPS)
def test_out_is_short_everywhere(program: str) -> None:
    for _, command in commands(typer.main.get_command(APPS[program])):
        for option in command.params:
            assert ("--out" in option.opts) == ("-o" in option.opts)


def test_no_retired_name_comes_back() -> None:
    retired = {"--json", "--svg", "--btcpp", "--save", "--seconds", "--terrain", "--table"}
    retired |= {"--person", "--encounter", "--passage", "--blockage", "--trouble"}
    assert not retired & {name.strip("`") for names in used() for name in names.split(", ")}
