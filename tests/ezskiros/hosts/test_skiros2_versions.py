"""The host names a version of rdflib with which SkiROS2 does not work."""

from __future__ import annotations

from importlib import metadata

import pytest

from ezskiros.hosts.skiros2_versions import unfit


@pytest.mark.parametrize(
    ("version", "fault"),
    [
        ("6.1.1", "finds no relations of individuals"),
        ("6.2.0", None),
        ("6.3.2", None),
        ("7.0.0", "cannot load its ontologies"),
        ("10.1", "cannot load its ontologies"),
    ],
)
def test_an_unfit_rdflib_is_named_with_what_to_install(
    monkeypatch: pytest.MonkeyPatch, version: str, fault: str | None
) -> None:
    monkeypatch.setattr(metadata, "version", lambda _name: version)
    remedy = 'pip install "rdflib>=6.2,<7"'
    assert unfit() == (fault and f"SkiROS2 {fault} with rdflib {version}: {remedy}")
