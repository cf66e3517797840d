"""The parameters of the generated node, for its sources and for `config/parameters.yaml`."""

from __future__ import annotations

import textwrap
from dataclasses import dataclass

from rossmarie.targets.c99.names import string

_WIDTH = 98


@dataclass(frozen=True)
class Number:
    """A number in [low, high]; `about` says its unit, and is a sentence."""

    name: str
    usual: float
    low: float
    high: float
    about: str


@dataclass(frozen=True)
class Text:
    """A text; `example` is one."""

    name: str
    example: str
    about: str


@dataclass(frozen=True)
class Texts:
    """A list of texts; `example` is one, in YAML."""

    name: str
    example: str
    about: str


Parameter = Number | Text | Texts


def parameters(package: str) -> tuple[Parameter, ...]:
    """All that both generations have."""
    return (
        Number(
            *("command_timeout", 0.5, 0.0, 1e6),
            about="A command older than this (s) is not sent again when its bounds change.",
        ),
        Number(
            *("filter_rate", 20.0, 0.1, 1000.0),
            about="How often (Hz) the node sends commands of its own: 0 while nothing may pass, "
            "and along ramps.",
        ),
        Number(
            *("patience", 5.0, 0.0, 1e6),
            about="Until all inputs with a timeout have arrived, rules are not looked at and no "
            "command passes; after this (s) those that are missing count as lost.",
        ),
        Number(
            *("grace_period", 0.0, 0.0, 1e6),
            about="After this (s) commands pass even if inputs have never arrived; 0 is never.",
        ),
        Number(
            *("clock_timeout", 0.0, 0.0, 1e6),
            about="No command passes while ROS time stands still for longer than this (s) by the "
            "wall clock; 0 is the shortest timeout of an input. A simulation that waits for the "
            "node, or for the machine, needs more.",
        ),
        Text(
            *("state_file", f"/var/lib/{package}.latched"),
            about="The file that keeps latched rules over a restart, of this node alone; empty for "
            "a file in ~/.ros with the names of the node and of its latched rules.",
        ),
        Texts(
            *("header_stamps", '["/imu/data"]'),
            about="The input topics of which the stamps in the headers count, not the arrival: a "
            "message whose stamp is old, in the future, or not later than the one before is "
            "refused.",
        ),
    )


def table(package: str) -> str:
    """The rows of the table of parameters in C++."""
    return "\n".join(f"    {{{_row(each)}}}," for each in parameters(package))


def _row(parameter: Parameter) -> str:
    kind = f"ParameterText::{type(parameter).__name__.upper()}"
    match parameter:
        case Number(usual=usual, low=low, high=high):
            numbers = (usual, low, high)
        case Text() | Texts():
            numbers = (0.0, 0.0, 0.0)
    texts = (string(parameter.name), kind, *map(repr, numbers), string(parameter.about))
    return ", ".join(texts)


def yaml(package: str) -> str:
    """The parameters with their usual values, and comments."""
    return "\n\n".join(map(_yaml, parameters(package)))


def _yaml(parameter: Parameter) -> str:
    comment = textwrap.wrap(parameter.about, _WIDTH, initial_indent="# ", subsequent_indent="# ")
    match parameter:
        case Number():
            line = f"{parameter.name}: {parameter.usual}"
        case Text() | Texts():
            line = f"# {parameter.name}: {parameter.example}"
    return "\n".join([*comment, line])
