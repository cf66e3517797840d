"""The order of test files in a run."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import groupby
from typing import cast

import pytest
from hypothesis import given
from hypothesis import strategies as st

from support.order import LONG, arranged

FILES = (
    "tests/architecture/test_size.py",
    "tests/live/test_arm.py",
    "tests/live/test_start.py",
    "tests/mutation/test_mutation.py",
    "tests/property/test_bound.py",
    "tests/rossmarie/syntax/test_limits.py",
)


@dataclass(frozen=True)
class Item:
    nodeid: str


def order_of(files: list[str]) -> list[str]:
    """The files of some tests, in the order in which they are run."""
    items = [Item(f"{name}::test_{n}") for name in files for n in range(3)]
    found = arranged(cast("list[pytest.Item]", items))
    assert sorted(item.nodeid for item in found) == sorted(item.nodeid for item in items)
    return [name for name, _ in groupby(item.nodeid.partition("::")[0] for item in found)]


@given(st.lists(st.sampled_from(FILES), unique=True))
def test_no_test_is_lost_and_those_of_a_file_stay_together(files: list[str]) -> None:
    assert sorted(order_of(files)) == sorted(files)


def test_live_tests_are_beside_what_takes_long() -> None:
    assert order_of(list(FILES)) == [
        "tests/live/test_arm.py",
        "tests/property/test_bound.py",
        "tests/live/test_start.py",
        "tests/mutation/test_mutation.py",
        "tests/architecture/test_size.py",
        "tests/rossmarie/syntax/test_limits.py",
    ]


def test_what_takes_long_is_there(pytestconfig: pytest.Config) -> None:
    assert [name for name in LONG if not (pytestconfig.rootpath / name).exists()] == []
