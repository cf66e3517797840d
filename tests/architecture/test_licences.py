"""Dependencies have acceptable licences, and NOTICE lists them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from pathlib import Path
from typing import Any

import pytest
from packaging.licenses import canonicalize_license_expression
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from support.packages import projects

PROJECT = Path(__file__).parents[2]
PERMISSIVE = frozenset(
    {
        *("0BSD", "any-OSI", "Apache-2.0", "BSD-2-Clause", "BSD-3-Clause", "CC0-1.0", "ISC"),
        *("MIT", "MIT-0", "MIT-CMU", "PSF-2.0", "Zlib"),
    }
)
"""These licences require only that users and distributors keep a notice."""
UNCHANGED = PERMISSIVE | {"MPL-2.0"}
"""Licences for tools of this project and for training. A distributor of a changed file must publish
the change.
"""
PROGRAMS = frozenset({"fast-downward-translate", "up-fast-downward"})
"""Run as programs of their own, and never imported (tests/ezskiros/planning): any licence."""
ALL = ("ezskiros[all]", "heron-robot[all]", "rossmarie[all]")
WITHOUT_LEARNING = ("ezskiros[all]", "heron-robot[gym,ray]", "rossmarie[all]")
ADVICE = (
    "replace the package, or run it as a program of its own and enter it in PROGRAMS; "
    "docs/decisions/0035-licences-are-checked.md says why"
)
WORDS = {
    "3-Clause BSD License": {"BSD-3-Clause"},
    "Apache 2.0": {"Apache-2.0"},
    "Apache License Version 2.0, January 2004": {"Apache-2.0"},
    "Apache Software License": {"Apache-2.0"},
    "BSD": {"BSD-2-Clause", "BSD-3-Clause"},
    "BSD 2-Clause License": {"BSD-2-Clause"},
    "BSD 3-Clause License": {"BSD-3-Clause"},
    "BSD License": {"BSD-2-Clause", "BSD-3-Clause"},
    "ISC License": {"ISC"},
    "ISC License (ISCL)": {"ISC"},
    "MIT License": {"MIT"},
    "Mozilla Public License 2.0 (MPL 2.0)": {"MPL-2.0"},
    "Python Software Foundation License": {"PSF-2.0"},
}
"""Texts in metadata that are not SPDX expressions, with their licences."""


def locked() -> set[str]:
    """The packages of the lock."""
    lines = (PROJECT / "constraints.txt").read_text(encoding="utf-8").splitlines()
    return {canonicalize_name(line.split("==")[0].strip()) for line in lines if "==" in line}


def noticed() -> Mapping[str, str]:
    """The packages of NOTICE with their licences."""
    text = (PROJECT / "NOTICE").read_text(encoding="utf-8")
    return dict(re.findall(r"^    (\S+) +(\S.*)$", text, re.MULTILINE))


@cache
def installed(name: str) -> Distribution | None:
    """The distribution that is installed under a name."""
    try:
        return distribution(name)
    except PackageNotFoundError:
        return None


def reported(metadata: Distribution) -> set[str]:
    """The licences that an installed package may have, as far as its metadata say it; where they
    say nothing, as its own file says in its first lines.
    """
    fields: Mapping[str, Any] = metadata.metadata.json
    if "license_expression" in fields:
        return identifiers(fields["license_expression"])
    classifiers: Sequence[str] = fields.get("classifier", ())
    words = [each.rpartition(" :: ")[2] for each in classifiers if each.startswith("License")]
    words += fields.get("license", "").splitlines()[:1]
    if not words:
        words = [_first_lines(metadata)]
    return {found for each in words for found in WORDS.get(each, identifiers(each))}


def _first_lines(metadata: Distribution) -> str:
    """The first two lines of the licence that a package brings, in one; empty if it brings none."""
    texts = (file.read_text() for file in metadata.files or () if file.name == "LICENSE")
    lines = (line.strip() for line in next(texts, "").splitlines())
    return " ".join([line for line in lines if line][:2])


def identifiers(expression: str) -> set[str]:
    """The licences of an SPDX expression; none if it is no such expression."""
    try:
        return set(re.findall(r"[\w.-]+", canonicalize_license_expression(expression))) - {
            *("AND", "OR", "WITH")
        }
    except ValueError:
        return set()


def is_allowed(expression: str, allowed: frozenset[str]) -> bool:
    """Say whether an SPDX expression without brackets leaves a choice of allowed licences."""
    return all(set(part.split(" OR ")) & allowed for part in expression.split(" AND "))


def needed(*requirements: str) -> set[str]:
    """The installed packages that users have who install these, such as `heron-robot[ray]`."""
    found: set[str] = set()
    asked = list(map(Requirement, requirements))
    left = [(each.name, extra) for each in asked for extra in ("", *each.extras)]
    while left:
        name, extra = left.pop()
        for required in _requirements(name, extra):
            called = canonicalize_name(required.name)
            if called not in found and installed(called):
                found.add(called)
                left += [(called, each) for each in ("", *required.extras)]
    return found


def _requirements(name: str, extra: str) -> Iterator[Requirement]:
    metadata = installed(name)
    for line in (metadata and metadata.requires) or []:
        required = Requirement(line)
        if required.marker is None or required.marker.evaluate({"extra": extra}):
            yield required


def test_notice_lists_the_lock() -> None:
    missing, left = locked() - {*noticed()}, {*noticed()} - locked()
    assert not missing, f"NOTICE lacks these packages of constraints.txt: {sorted(missing)}"
    assert not left, f"NOTICE has packages that constraints.txt lacks: {sorted(left)}"


def test_what_users_install_is_locked() -> None:
    left = needed(*ALL) - locked() - set(projects())
    assert not left, f"these packages are needed, and constraints.txt lacks them: {sorted(left)}"


@pytest.mark.parametrize("name", sorted(noticed()))
def test_the_licence_is_the_one_in_notice_and_allowed(name: str) -> None:
    expression = noticed()[name]
    metadata = installed(name)
    if metadata is not None:
        said = reported(metadata)
        assert said, f"the metadata of {name} say no licence that is known here: add it to WORDS"
        assert said & identifiers(expression), (
            f"NOTICE says that {name} is under {expression}, and its metadata say {sorted(said)}: "
            "read its licence, and correct NOTICE"
        )
    is_users = name in needed(*WITHOUT_LEARNING)
    allowed = PERMISSIVE if is_users else UNCHANGED
    assert name in PROGRAMS or is_allowed(expression, allowed), (
        f"{name} is under {expression}: {ADVICE}"
    )


def test_every_package_in_notice_has_an_spdx_expression() -> None:
    assert [each for each in noticed().values() if not identifiers(each)] == []


@pytest.mark.parametrize(
    ("expression", "is_fine"),
    [
        ("MIT", True),
        ("GPL-3.0-only OR MIT", True),
        ("GPL-3.0-only AND MIT", False),
        ("LGPL-3.0-or-later", False),
        ("MPL-2.0", False),
    ],
)
def test_of_several_licences_one_can_be_chosen(expression: str, is_fine: bool) -> None:
    assert is_allowed(expression, PERMISSIVE) == is_fine
