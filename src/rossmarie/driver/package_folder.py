"""A check whether a package may be generated into a folder that already contains a package."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from dslkit.diagnostics import Diagnostic
from dslkit.source import SourceFile, Span
from rossmarie.driver.errors import OtherGeneration, OtherPackage
from rossmarie.driver.ownership import is_of
from rossmarie.driver.package_xml import (
    PACKAGE_XML,
    BadPackageXmlError,
    PackageXml,
    XmlElement,
    parse_package_xml,
    read_package_xml,
)


def check_package_folder(folder: Path, files: Mapping[str, str], rules: Path) -> Diagnostic | None:
    """The finding on a folder into which `files`, generated from `rules`, must not be written: the
    folder contains another package, or the same package for another generation of ROS. None if
    there is no such problem.
    """
    path = folder / PACKAGE_XML
    if PACKAGE_XML not in files or not path.exists():
        return None
    try:
        present = read_package_xml(path)
    except BadPackageXmlError as error:
        return error.diagnostic
    text = files[PACKAGE_XML]
    wanted = parse_package_xml(SourceFile(PACKAGE_XML, text))
    generations = (present.generation(), wanted.generation())
    if None not in generations and len(set(generations)) > 1:
        return _other_generation(folder, present, wanted)
    if not is_of(present.file.text, text, rules):
        return _other_package(folder, present, rules)
    return None


def _other_generation(folder: Path, present: PackageXml, wanted: PackageXml) -> Diagnostic:
    found, own = present.generation(), wanted.generation()
    assert found is not None, "only a known generation is another one"
    assert own is not None, "only a known generation is another one"
    finding = OtherGeneration(folder=str(folder), found=found.value, wanted=own.value)
    return finding.at(_place(present, present.build_system()))


def _other_package(folder: Path, present: PackageXml, rules: Path) -> Diagnostic:
    name = present.first("name")
    called = name.text if name is not None else folder.name
    finding = OtherPackage(folder=str(folder), package=called, rules=rules.name)
    return finding.at(_place(present, name))


def _place(present: PackageXml, element: XmlElement | None) -> Span:
    """An element, or the start of the file if there is none."""
    return Span(present.file, 0, 0) if element is None else element.span
