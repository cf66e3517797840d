"""The parts of a ROS `package.xml` that a build needs: its elements, and their places.

The input is the text of a file, for either generation of ROS. The result is a `PackageXml`, or a
finding at the place of the first XML error.
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
"""The largest size of a `package.xml` in bytes."""
DEEPEST = 50
"""The greatest depth of nested elements."""


class Generation(enum.Enum):
    """The generation of ROS. The value is its usual name."""

    ROS1 = "ROS 1"
    ROS2 = "ROS 2"


@dataclass(frozen=True)
class XmlElement:
    """An element below the root. `path` is `name` or `export/build_type`; `span` covers the whole
    element.
    """

    path: str
    attributes: Mapping[str, str]
    text: str
    span: Span


class BadPackageXmlError(Exception):
    """A `package.xml` that cannot be read. `diagnostic` gives the reason."""

    def __init__(self, diagnostic: Diagnostic) -> None:
        self.diagnostic = diagnostic
        super().__init__(f"{diagnostic.primary.span}: {diagnostic.title}")


@dataclass(frozen=True)
class PackageXml:
    """The elements of a `package.xml`, in order."""

    file: SourceFile
    elements: tuple[XmlElement, ...]

    def all(self, path: str) -> Iterator[XmlElement]:
        """The elements with this path."""
        return (each for each in self.elements if each.path == path)

    def first(self, path: str) -> XmlElement | None:
        """The first element with this path, None if there is none."""
        return next(self.all(path), None)

    def build_system(self) -> XmlElement | None:
        """The element with the build system of the package."""
        return self.first("export/build_type") or self.first("buildtool_depend")

    def generation(self) -> Generation | None:
        """The generation of ROS of the package; None if its build system does not determine it."""
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
    """A `package.xml` that exceeds a limit. The text names the limit."""


@dataclass
class _Open:
    """An element whose end has not been read yet."""

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
        self.elements: list[XmlElement] = []
        self.parser = expat.ParserCreate("utf-8")
        self.parser.StartElementHandler = self._begin
        self.parser.EndElementHandler = self._end
        self.parser.CharacterDataHandler = self._characters
        self.parser.EntityDeclHandler = self._entity

    def parse(self) -> None:
        """Parse the whole text."""
        self.parser.Parse(self._bytes, True)

    def offset(self, byte: int) -> int:
        """The offset in code points for an offset in bytes."""
        return len(self._bytes[: max(byte, 0)].decode("utf-8", errors="ignore"))

    def _entity(self, *_: object) -> None:
        raise _TooMuchError("it declares an entity, which is not supported")

    def _begin(self, tag: str, attributes: Mapping[str, str]) -> None:
        if len(self._open) == DEEPEST:
            raise _TooMuchError(f"elements are nested more than {DEEPEST} deep")
        self._open.append(_Open(tag, attributes, self.parser.CurrentByteIndex))

    def _characters(self, text: str) -> None:
        self._open[-1].text += text

    def _end(self, _: str) -> None:
        path = "/".join(each.tag for each in self._open[1:])
        closed = self._open.pop()
        if path:
            end = self._bytes.index(b">", self.parser.CurrentByteIndex) + 1
            span = Span(self._file, self.offset(closed.start), self.offset(end))
            self.elements.append(XmlElement(path, closed.attributes, closed.text.strip(), span))
