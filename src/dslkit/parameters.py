"""Parameters of commands whose values are plainly right, without what typer loads to check them.

Typer checks each value of a command, its defaults included, with pydantic: to import that takes
as long as to import typer. A value that is a string, a path, or one of some words needs no such
thing. Whatever is not plainly right goes to typer, which then says what is wrong.
"""

from __future__ import annotations

import os
from enum import Enum
from pathlib import Path
from typing import Any, get_args

from typer import BadParameter
from typer.core import TyperGroup

_KINDS = {
    "Input should be a valid integer": "whole number",
    "Input should be a valid number": "number",
}
"""The beginnings of pydantic's messages about text that is no number, and the kind of number."""


class Group(TyperGroup):
    """The commands of a program: `typer.Typer(cls=Group)`."""

    def __init__(self, **declared: Any) -> None:
        super().__init__(**declared)
        _look_first_at_values_of(self)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """The command with this name."""
        command = super().get_command(ctx, cmd_name)
        if command is not None:
            _look_first_at_values_of(command)
        return command


def _look_first_at_values_of(command: Any) -> None:
    """Also at the option `--help`, which typer makes when it is asked for the parameters."""
    typers = command.get_params

    def get_params(ctx: Any) -> list[Any]:
        found: list[Any] = typers(ctx)
        for parameter in found:
            parameter.get_runtime_param = _Plain(parameter).itself
        return found

    command.get_params = get_params


class _NotPlainError(ValueError):
    """Typer has to say what a value means, or what is wrong with it."""


class _Plain:
    """Makes of what was typed what the command takes; in the place of typer's own."""

    def __init__(self, parameter: Any) -> None:
        self._parameter = parameter

    def itself(self) -> _Plain:
        """Itself: typer asks each parameter for an object with the method `coerce`."""
        return self

    def coerce(self, value: Any, **rest: Any) -> Any:
        """The value that the command gets; typer's own, with its errors, if it is not plain."""
        try:
            return self._of(value)
        except ValueError:
            typers = type(self._parameter).get_runtime_param(self._parameter)
            try:
                return typers.coerce(value, **rest)
            except BadParameter as error:
                error.message = _plain_words(error.message, value)
                raise

    def _of(self, value: Any) -> Any:
        is_list = self._parameter.multiple or self._parameter.nargs == -1
        if value is None:
            return () if is_list else None
        kind = self._parameter.type_descriptor.annotation
        if not is_list:
            return self._one(kind, value)
        if not isinstance(value, (list, tuple)):
            raise _NotPlainError
        (kind,) = get_args(kind)
        return [self._one(kind, each) for each in value]

    def _one(self, kind: Any, value: Any) -> Any:
        declared = self._parameter.type_descriptor.parameter_info
        if declared.parser is not None:
            return declared.parser(value)
        if kind is str and isinstance(value, str):
            return value
        if kind is Path and isinstance(value, (str, Path)):
            return _path(value, declared)
        if isinstance(kind, type) and issubclass(kind, Enum):
            return kind(value)
        if kind is float and value == self._parameter.default:
            return value
        raise _NotPlainError


def _plain_words(message: str, value: object) -> str:
    """A message of pydantic in the words of a user."""
    for begin, kind in _KINDS.items():
        if message.startswith(begin):
            return f"`{value}` is no {kind}"
    return message.removeprefix("Value error, ").replace("Input should be", "it has to be")


def _path(value: str | Path, declared: Any) -> Path:
    """The path, if it is what was declared."""
    path = Path(value)
    doubts = (
        declared.resolve_path or declared.allow_dash or declared.writable,
        declared.exists and not path.exists(),
        not declared.file_okay and path.is_file(),
        not declared.dir_okay and path.is_dir(),
        declared.readable and path.exists() and not os.access(path, os.R_OK),
    )
    if any(doubts):
        raise _NotPlainError
    return path
