"""A `package.xml` of ROS as far as a build looks at it: its elements, and where they stand.

Takes the text of a file, of either generation of ROS; gives a `PackageXml`, or a finding at the
place from which on it is no XML.
"""

from __future__ import annotations

import enum
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from xml.parsers import expat

from dslkit.diagnostics import Diagnostic
from dslkit.source import SourceFile, Span
from rossmarie.driver.errors import MalformedPackageXml

PACKAGE_XML = "package.xml"
LARGEST_FILE = 256 << 10
"""Bytes of a `package.xml`."""
DEEPEST = 50
"""The most elements that may lie in each other."""


class Generation(enum.Enum):
    """Whose package it is; the value is what people call it."""

    ROS1 = "ROS 1"
    ROS2 = "ROS 2"


@dataclass(frozen=True)
class Element:
    """An element below the root: `path` is `name` or `export/build_type`; `span` is all of it."""

    path: str
    attributes: Mapping[str, str]
    text: str
    span: Span


class BadPackageXmlError(Exception):
    """A `package.xml` that cannot be read; `diagnostic` says why."""

    def __init__(self, diagnostic: Diagnostic) -> None:
        self.diagnostic = diagnostic
        super().__init__(f"{diagnostic.primary.span}: {diagnostic.title}")


@dataclass(frozen=True)
class PackageXml:
    """The elements of a `package.xml`, in their order."""

    file: SourceFile
    elements: tuple[Element, ...]

    def all(self, path: str) -> Iterator[Element]:
        """The elements with this path."""
        return (each for each in self.elements if each.path == path)

    def first(self, path: str) -> Element | None:
        """The first element with this path, None if there is none."""
        return next(self.all(path), None)

    def build_system(self) -> Element | None:
        """The element that says by which build system the package is built."""
        return self.first("export/build_type") or self.first("buildtool_depend")

    def generation(self) -> Generation | None:
        """The generation of ROS that the package is for; None if its build system does not say."""
        named = self.build_system()
        if named is None:
            return None
        if named.text == "catkin":
            return Generation.ROS1
        return Generation.ROS2 if named.text.startswith("ament") else None


def read_package_xml(path: Path) -> PackageXml:
    """The file at a path. Raises `BadPackageXmlError`, and `OSError` if it cannot be read."""
    with path.open("rb") as opened:
        content = opened.read(LARGEST_FILE + 1)
    if len(content) > LARGEST_FILE:
        reason = f"it is larger than {LARGEST_FILE >> 10} KiB"
        span = Span(SourceFile(str(path), ""), 0, 0)
        raise BadPackageXmlError(MalformedPackageXml(reason=reason).at(span))
    try:
        return parse_package_xml(SourceFile.decoded(str(path), content))
    except UnicodeDecodeError as error:
        text = content[: error.start].decode("utf-8")
        file = SourceFile(str(path), text)
        reason = "from here on this is not UTF-8"
        span = Span(file, len(text), len(text))
        raise BadPackageXmlError(MalformedPackageXml(reason=reason).at(span)) from None


def parse_package_xml(file: SourceFile) -> PackageXml:
    """The elements in a text. Raises `BadPackageXmlError`."""
    reader = _Reader(file)
    try:
        reader.parse()
    except (expat.ExpatError, _TooMuchError) as error:
        offset = reader.offset(reader.parser.CurrentByteIndex)
        reason = (
            expat.ErrorString(error.code) if isinstance(error, expat.ExpatError) else str(error)
        )
        span = Span(file, offset, offset)
        raise BadPackageXmlError(MalformedPackageXml(reason=reason).at(span)) from None
    return PackageXml(file, tuple(reader.elements))


class _TooMuchError(Exception):
    """More than a `package.xml` may have; the text says what."""


@dataclass
class _Open:
    """An element whose end has not come."""

    tag: str
    attributes: Mapping[str, str]
    start: int
    text: str = ""


class _Reader:
    """Collects the elements that expat reports, with their places."""

    def __init__(self, file: SourceFile) -> None:
        self._file = file
        self._bytes = file.text.encode()
        self._open: list[_Open] = []
        self.elements: list[Element] = []
        self.parser = expat.ParserCreate("utf-8")
        self.parser.StartElementHandler = self._begin
        self.parser.EndElementHandler = self._end
        self.parser.CharacterDataHandler = self._characters
        self.parser.EntityDeclHandler = self._entity

    def parse(self) -> None:
        """Read all of the text."""
        self.parser.Parse(self._bytes, True)

    def offset(self, byte: int) -> int:
        """The offset in code points of a byte."""
        return len(self._bytes[: max(byte, 0)].decode("utf-8", errors="ignore"))

    def _entity(self, *_: object) -> None:
        raise _TooMuchError("an entity is declared, which a build does not need")

    def _begin(self, tag: str, attributes: Mapping[str, str]) -> None:
        if len(self._open) == DEEPEST:
            raise _TooMuchError(f"more than {DEEPEST} elements lie in each other")
        self._open.append(_Open(tag, attributes, self.parser.CurrentByteIndex))

    def _characters(self, text: str) -> None:
        self._open[-1].text += text

    def _end(self, _: str) -> None:
        path = "/".join(each.tag for each in self._open[1:])
        closed = self._open.pop()
        if path:
            end = self._bytes.index(b">", self.parser.CurrentByteIndex) + 1
            span = Span(self._file, self.offset(closed.start), self.offset(end))
            self.elements.append(Element(path, closed.attributes, closed.text.strip(), span))
