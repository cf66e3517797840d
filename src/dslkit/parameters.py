"""Fast conversion of valid parameters of commands, without the modules that typer loads to check
them.

Typer checks each value of a command, including defaults, with pydantic, whose import takes as long
as the import of typer. A value that is a string, a path, or one of some words does not need it. Any
other value goes to typer, which then reports the error.
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
"""The beginnings of pydantic's messages about text that is not a number, with the kind of number.
"""


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
    """Wrap the parameters of a command, including the option `--help`, which typer makes when it
    reads the parameters.
    """
    typers = command.get_params

    def get_params(ctx: Any) -> list[Any]:
        found: list[Any] = typers(ctx)
        for parameter in found:
            parameter.get_runtime_param = _Plain(parameter).itself
        return found

    command.get_params = get_params


class _NotPlainError(ValueError):
    """Signals that typer has to convert this value or report its error."""


class _Plain:
    """Converts the typed text to the value for the command, in place of typer's own conversion."""

    def __init__(self, parameter: Any) -> None:
        self._parameter = parameter

    def itself(self) -> _Plain:
        """Return itself: typer requires an object with the method `coerce` for each parameter."""
        return self

    def coerce(self, value: Any, **rest: Any) -> Any:
        """The value for the command; for a value that is not plain, typer's own result, or its
        error.
        """
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
            return f"`{value}` is not a {kind}"
    return message.removeprefix("Value error, ").replace("Input should be", "it has to be")


def _path(value: str | Path, declared: Any) -> Path:
    """The path, if it fits its declaration."""
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
