"""Files of other kinds, given in the place of rules: a script, a web page, a launch file.

Each would be a long list of syntax errors; instead it is called by its kind.
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
"""Beginnings that no rules file has."""

_LONGEST = max(map(len, _BEGUN))


def foreign_kind(path: Path, text: str) -> str | None:
    """The kind of a file that is not rules, by its name or its first signs; None if it may be."""
    begin = text.lstrip()[:_LONGEST].lower()
    found = next((kind for sign, kind in _BEGUN.items() if begin.startswith(sign)), None)
    return found or _BY_ENDING.get(path.suffix.lower())
