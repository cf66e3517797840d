"""Users' texts inside the comments of generated files, with one function for each language."""

from __future__ import annotations

import unicodedata
from pathlib import PurePath
from xml.sax.saxutils import escape

from rossmarie import ir


def rules_files(machine: ir.Machine) -> str:
    """The names of the rules files, without folders, which differ from computer to computer."""
    found = {PurePath(rule.span.file.path).name for rule in machine.rules}
    return ", ".join(sorted(found)) or machine.name


def in_c(text: str) -> str:
    """A text in a comment of C or C++, of either kind."""
    safe = _line(text).replace("*/", "* /").replace("/*", "/ *").replace("??", "? ?")
    return f"{safe}." if safe.endswith("\\") else safe  # a backslash would join the next line


def after_hash(text: str) -> str:
    """A text in a comment that begins with #, as in CMake, Python, YAML and ROS message files."""
    return _line(text)


def in_xml(text: str) -> str:
    """A text anywhere in XML or Markdown, in comments and attributes as well."""
    return escape(_line(text), {'"': "&quot;"}).replace("--", "- -")


def inside(path: str, text: str) -> str:
    """A text in a comment of a file with this path."""
    return _LANGUAGES[PurePath(path).suffix](text)


def _line(text: str) -> str:
    """The text on one line. Unprintable characters are replaced by question marks."""
    joined = " ".join(text.split())
    return "".join("?" if unicodedata.category(x)[0] == "C" else x for x in joined)


_LANGUAGES = {
    **dict.fromkeys((".c", ".cpp", ".h"), in_c),
    **dict.fromkeys((".cmake", ".msg", ".py", ".srv", ".txt", ".yaml"), after_hash),
    **dict.fromkeys((".launch", ".md", ".xml"), in_xml),
}
