"""Files of other types in place of rules: a script, a web page, a launch file.

Instead of a long list of syntax errors, one finding names the type of the file.
"""

from __future__ import annotations

from pathlib import Path

WEB_PAGE = "a web page"

_NAMED = {
    "a Python file": (".py", ".pyi", ".ipynb"),
    "a C or C++ file": (".c", ".cc", ".cpp", ".cxx", ".h", ".hh", ".hpp"),
    "a script": (".sh", ".bash", ".lua"),
    "a YAML file": (".yaml", ".yml"),
    "a JSON file": (".json",),
    "an XML file": (".xml", ".launch", ".urdf", ".xacro", ".srdf", ".sdf", ".world"),
    WEB_PAGE: (".html", ".htm"),
    "a page of text": (".md", ".rst"),
    "a definition of messages": (".msg", ".srv", ".action", ".idl"),
    "an ontology": (".owl", ".rdf", ".ttl", ".turtle"),
}
_BY_ENDING = {ending: kind for kind, endings in _NAMED.items() for ending in endings}
_BEGUN = {
    "<!doctype html": WEB_PAGE,
    "<html": WEB_PAGE,
    "<": "an XML file",
    "#!": "a script",
    "{": "a JSON file",
}
"""Texts at the beginning of a file. No rules file begins with them."""

_LONGEST = max(map(len, _BEGUN))


def foreign_kind(path: Path, text: str) -> str | None:
    """The type of a file that is not a rules file, by its name or its first characters; None if the
    file may be a rules file.
    """
    begin = text.lstrip()[:_LONGEST].lower()
    found = next((kind for sign, kind in _BEGUN.items() if begin.startswith(sign)), None)
    return found or _BY_ENDING.get(path.suffix.lower())
