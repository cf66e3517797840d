"""Reads one line of a .msg file: a field, a constant, or neither.

The grammar is the grammar of https://wiki.ros.org/msg and of ROS 2 (bounds, defaults, annotations).
rosbags reads the same lines but needs NumPy, and a check of rules works without NumPy. A test
compares the two readers.
"""

from __future__ import annotations

import re
from math import isfinite
from typing import NamedTuple

_BASES = r"(?:bool|byte|char|float(?:32|64)|u?int(?:8|16|32|64)|w?string)"
_NAME = r"[A-Za-z][A-Za-z0-9_]*"
_BOUND = r"(?:<=[0-9]+)"
_LINE = re.compile(
    rf"""
    (?:[ \t]*@[a-z]+(?=[ \t]|$))* [ \t]*
    (?P<type> {_BASES}{_BOUND}?(?![\w/]) | (?:[a-z](?:_?[a-z0-9]+)*/)*[A-Za-z](?:_?[A-Za-z0-9]+)* )
    (?P<array> \[ (?:<=)? [0-9]* \] )?
    [ \t]+ (?P<name>{_NAME})
    (?: [ \t]* = [ \t]* (?P<value>[^ \t].*?) | [ \t]+ (?P<default>[^#= \t].*?) )?
    [ \t]* (?:\#.*)?
    """,
    re.VERBOSE | re.ASCII,
)
_ONLY_ANNOTATIONS = re.compile(r"(?:[ \t]*@[a-z]+(?=[ \t]|$))*[ \t]*(?:#.*)?")
_QUOTED = re.compile(r"""'((?:\\.|[^'\\])*)'|"((?:\\.|[^"\\])*)\"""")
_OCTAL = re.compile(r"[-+]?0[0-7]{1,32}")
_WHOLE = re.compile(r"[-+]?0(x[0-9a-f]{1,32}|b[01]{1,128}|o[0-7]{1,33})")
_MEANT = {
    "time": "builtin_interfaces/Time",
    "duration": "builtin_interfaces/Duration",
    "Header": "std_msgs/Header",
}
_TRUTHS = {"true": 1.0, "false": 0.0}


class Line(NamedTuple):
    """A field or a constant: its full type (`float32`, `geometry_msgs/msg/Point`), and the value of
    a constant; None for a field.
    """

    name: str
    base: str
    is_array: bool
    value: float | str | None


def read_line(text: str, package: str) -> Line | None:
    """The field or the constant of a line; None if the line has neither. A type without a package
    belongs to `package`. Raises `ValueError` if the line is malformed.
    """
    if _ONLY_ANNOTATIONS.fullmatch(text):
        return None
    match = _LINE.fullmatch(text)
    if match is None:
        raise ValueError(text)
    written = match["type"].partition("<=")[0]
    is_base = re.fullmatch(_BASES, written) is not None
    base = written if is_base else _MEANT.get(written, written)
    if not is_base and "/" not in base:
        base = f"{package}/{base}"
    if match["value"] is None:
        return Line(match["name"], base, match["array"] is not None, None)
    if not is_base or match["array"] or "<=" in match["type"] or not match["name"].isupper():
        raise ValueError(text)
    # The value of a text is the rest of the line, including a comment.
    value = _text(text.partition("=")[2].strip()) if "string" in base else _number(match["value"])
    return Line(match["name"], base, is_array=False, value=value)


def _text(written: str) -> str:
    quoted = _QUOTED.match(written)
    return written if quoted is None else quoted[1] or quoted[2] or ""


def _number(written: str) -> float:
    """The number of a constant. Raises `ValueError` if it is not a number."""
    word = written.lower()
    if word in _TRUTHS:
        return _TRUTHS[word]
    if _OCTAL.fullmatch(word):
        word = word.replace("0", "0o", 1)
    number = float(int(word, 0)) if _WHOLE.fullmatch(word) else float(word)
    if not isfinite(number):
        raise ValueError(written)
    return number
