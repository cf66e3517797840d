"""Licence, maintainers and version of a generated package. They come from options, or else from the
package that contains the rules.

The package of the rules is the first `package.xml` in their folder or in a folder above, up to the
root of their workspace or repository. A generated `package.xml` does not count, because it is not a
source.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from rossmarie.driver.errors import BadPackageField
from rossmarie.driver.ownership import origins
from rossmarie.driver.package_xml import (
    PACKAGE_XML,
    BadPackageXmlError,
    PackageXml,
    XmlElement,
    read_package_xml,
)
from rossmarie.targets.manifest import (
    BadFieldError,
    Maintainer,
    Manifest,
    parse_license,
    parse_maintainer,
)

_ROOTS = (".git", ".catkin_workspace", ".catkin_tools", "install/.colcon_install_layout")
_VERSION = re.compile(r"\d+\.\d+\.\d+")


@dataclass(frozen=True)
class DescribedManifest:
    """A manifest, and the fields without a value, in words."""

    manifest: Manifest
    missing: tuple[str, ...]


def describe(
    rules: Path, licenses: Sequence[str], maintainers: Sequence[Maintainer]
) -> DescribedManifest:
    """The manifest of the package of some rules. Values from options are not searched for.

    Raises `BadPackageXmlError` if the package of the rules cannot be read or has a field that is
    not valid here, and `OSError`.
    """
    found = _package_of(rules)
    manifest = Manifest(
        version=None if found is None else _version(found),
        licenses=tuple(licenses) or _licenses(found),
        maintainers=tuple(maintainers) or _maintainers(found),
    )
    fields = (("license", manifest.licenses), ("maintainer", manifest.maintainers))
    return DescribedManifest(manifest, tuple(name for name, value in fields if not value))


def _package_of(rules: Path) -> PackageXml | None:
    """The package that contains the rules; None if there is none."""
    for folder in _folders_around(rules):
        path = folder / PACKAGE_XML
        if path.is_file():
            found = read_package_xml(path)
            if not origins(found.file.text):
                return found
    return None


def _folders_around(rules: Path) -> Iterator[Path]:
    """The folder of the rules and the folders above it, up to a root."""
    for folder in rules.absolute().parents:
        yield folder
        if any((folder / root).exists() for root in _ROOTS):
            return


def _version(package: PackageXml) -> str | None:
    element = package.first("version")
    if element is None:
        return None
    if not _VERSION.fullmatch(element.text):
        raise _bad(element, "version", "a version has three numbers, such as `1.2.0`")
    return element.text


def _licenses(package: PackageXml | None) -> tuple[str, ...]:
    elements = () if package is None else package.all("license")
    return tuple(_license(each) for each in elements)


def _license(element: XmlElement) -> str:
    try:
        return parse_license(element.text)
    except BadFieldError as error:
        raise _bad(element, "license", str(error)) from None


def _maintainers(package: PackageXml | None) -> tuple[Maintainer, ...]:
    elements = () if package is None else package.all("maintainer")
    return tuple(_maintainer(each) for each in elements)


def _maintainer(element: XmlElement) -> Maintainer:
    mail = element.attributes.get("email", "")
    try:
        return parse_maintainer(f"{element.text} <{mail}>")
    except BadFieldError:
        form = '`<maintainer email="name@example.org">Name</maintainer>`'
        form = f"a maintainer has a name and a mail address: {form}"
        raise _bad(element, "maintainer", form) from None


def _bad(element: XmlElement, field: str, form: str) -> BadPackageXmlError:
    return BadPackageXmlError(BadPackageField(field=field, form=form).at(element.span))
