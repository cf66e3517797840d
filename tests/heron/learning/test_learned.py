"""Files of what was learned: what they hold is used, and what is something else is refused."""

from __future__ import annotations

import io
import json
import os
import zipfile
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support.parts import MUJOCO, require

require(MUJOCO)

from heron.learning.environment import GREATEST, LEAST, MOVES
from heron.learning.insertion import FIELDS
from heron.learning.learned import read_learned
from heron.learning.policy import INPUTS, Policy
from heron.learning.tree import RANGES
from heron.variants import Formulation

SEEN = np.linspace(-1.0, 1.0, len(FIELDS))
BOUNDS = (LEAST.tolist(), GREATEST.tolist())
NUMBERS = {name: least for name, (least, _) in RANGES.items()} | {"AsideX": 0.0, "AsideY": 0.0}


def network(outputs: int, bounds: Any) -> Policy:
    chance = np.random.default_rng(1)
    sizes = [(INPUTS, 8), (8, outputs)]
    layers = [(chance.normal(size=size), chance.normal(size=size[1])) for size in sizes]
    return Policy(layers, bounds, is_squashed=True)


@pytest.mark.parametrize(
    ("policy", "formulation"),
    [
        (network(len(LEAST), BOUNDS), Formulation.STEPS),
        (network(len(MOVES), ([], [])), Formulation.MOVES),
    ],
)
def test_a_policy_is_read_with_its_formulation(
    policy: Policy, formulation: Formulation, tmp_path: Path
) -> None:
    path = tmp_path / "policy.npz"
    path.write_bytes(policy.file())
    found = read_learned(path)
    assert found.formulation is formulation
    assert np.array_equal(found.begin()(SEEN), policy(SEEN))


def test_a_tree_begins_anew_in_each_episode(tmp_path: Path) -> None:
    path = tmp_path / "numbers.json"
    path.write_text(json.dumps(NUMBERS), encoding="utf-8")
    found = read_learned(path)
    assert found.formulation is Formulation.TREE
    act = found.begin()
    above, far = (np.array([-0.6, 0.0, z, *[0.0] * 8]) for z in (0.7075, 0.9))
    assert act(above)[3] < 0.0, "it is above the hole, and begins to search"
    assert act(far)[3] < 0.0, "it goes on"
    assert found.begin()(far)[3] == 0.0


def saved(**arrays: Any) -> bytes:
    file = io.BytesIO()
    np.savez(file, **arrays)
    return file.getvalue()


def arrays_of(policy: Policy) -> dict[str, Any]:
    with np.load(io.BytesIO(policy.file())) as found:
        return {name: found[name] for name in found.files}


GOOD = arrays_of(network(len(LEAST), BOUNDS))
DAMAGED: Mapping[str, bytes] = {
    "empty": b"",
    "text": b"no zip",
    "one array": saved(a=np.zeros(3)),
    "pickled": saved(**GOOD | {"bias1": np.array([None] * 4)}),
    "words": saved(**GOOD | {"bias1": np.array(["a"] * 4)}),
    "nan": saved(**GOOD | {"bias1": np.full(4, np.nan)}),
    "overflowing": saved(**GOOD | {"weights0": np.full((INPUTS, 8), 1e300)}),
    "flat bounds": saved(**GOOD | {"bounds": np.zeros(2)}),
    "three outputs": network(3, ([-1.0] * 3, [1.0] * 3)).file(),
    "other inputs": saved(**GOOD | {"weights0": np.zeros((INPUTS + 1, 8))}),
    "broadcast": saved(**GOOD | {"bias0": np.zeros((8, 1))}),
    "too many moves": network(len(MOVES) + 1, ([], [])).file(),
}


@pytest.mark.parametrize("kind", DAMAGED)
def test_what_is_no_policy_is_refused(kind: str, tmp_path: Path) -> None:
    path = tmp_path / "policy.npz"
    path.write_bytes(DAMAGED[kind])
    with pytest.raises(ValueError, match=r"policy\.npz is not a policy of this task"):
        read_learned(path)


def test_what_unpacks_to_too_much_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "policy.npz"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as parts:
        parts.writestr("weights0.npy", bytes(2**25))
    with pytest.raises(ValueError, match="is not a policy of this task"):
        read_learned(path)


@given(place=st.integers(0, 10_000), value=st.integers(0, 255))
def test_damage_is_refused_or_harmless(
    place: int, value: int, tmp_path_factory: pytest.TempPathFactory
) -> None:
    content = bytearray(saved(**GOOD))
    content[place % len(content)] = value
    path = tmp_path_factory.getbasetemp() / "damaged.npz"
    path.write_bytes(content)
    with suppress(ValueError):
        assert np.isfinite(read_learned(path).begin()(SEEN)).all()


@pytest.mark.parametrize(
    "text",
    [
        *("", "[", "[" * 100_000, "[]", "{}", "null", '{"Height": 1}'),
        json.dumps(NUMBERS | {"Speed": float("nan")}),
        json.dumps(NUMBERS | {"Speed": float("inf")}),
        json.dumps(NUMBERS | {"Speed": 10**400}),
        json.dumps(NUMBERS | {"Speed": "fast"}),
        json.dumps(NUMBERS | {"Speed": None}),
    ],
)
def test_what_are_no_numbers_is_refused(text: str, tmp_path: Path) -> None:
    path = tmp_path / "numbers.json"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ValueError, match="does not contain the numbers of the tree"):
        read_learned(path)


def test_only_files_are_read(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.npz")
    for path in (tmp_path, tmp_path / "pipe.npz", Path("/dev/zero")):
        with pytest.raises(ValueError, match="is not a file"):
            read_learned(path)
    large = tmp_path / "large.json"
    with large.open("wb") as file:
        file.truncate(2**24 + 1)
    with pytest.raises(ValueError, match="is larger than 16 MiB"):
        read_learned(large)
    with pytest.raises(FileNotFoundError):
        read_learned(tmp_path / "lacking.npz")
