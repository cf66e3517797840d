"""Constructions that work in newer versions of Python, but not in the oldest supported version."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from types import GenericAlias
from typing import Any, get_type_hints

import pytest
import typer

import crosscheck.cli.main
import ezskiros.cli.main
import heron.cli.main
import rossmarie.cli.main

APPS = {
    module.__name__: module.app
    for module in (crosscheck.cli.main, ezskiros.cli.main, heron.cli.main, rossmarie.cli.main)
}


def callbacks_of(app: typer.Typer) -> Iterator[Callable[..., Any]]:
    """The callbacks of all arguments and options of all commands."""
    for command in app.registered_commands:
        for hint in get_type_hints(command.callback, include_extras=True).values():
            for annotation in getattr(hint, "__metadata__", ()):
                if annotation.callback is not None:
                    yield annotation.callback


@pytest.mark.parametrize("app", APPS.values(), ids=APPS)
def test_no_callback_of_a_command_takes_a_plain_list(app: typer.Typer) -> None:
    """In Python 3.10, typer ends with a TypeError if a callback takes `list[Path]`."""
    assert app.registered_commands
    for callback in callbacks_of(app):
        hints = get_type_hints(callback)
        hints.pop("return", None)
        assert not any(isinstance(hint, GenericAlias) for hint in hints.values()), callback


def test_the_callbacks_are_found() -> None:
    assert rossmarie.cli.options._recordings in set(callbacks_of(rossmarie.cli.main.app))
