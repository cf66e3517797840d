"""Files that are nearly right: examples and fixtures of this project, damaged at random."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence

_PIECES = [
    *b"()[]{};:,.=<>+-*/'\"\n\t\0\xff",
    *[b"'''", b"//", b" and ", b" or ", b" not ", b" in ", b" for ", b" if ", b" then ", b"rule "],
    *[
        b"input ",
        b"topic ",
        b"const ",
        b"entity ",
        b"system ",
        b"import ",
        b" m/s",
        b"1e308 ",
        b"9",
    ],
    *[b'<!ENTITY a "&b;">', b"<![CDATA[", b"xmlns:a='b' ", b" a owl:Class .", b"[ ", b"@prefix "],
    *[b"<<( ", b"^^xsd:int", b"&a", b"*a", b"<<: ", b"\xff" * 4, b"\0" * 8, b"\x7f" + b"\xff" * 7],
    *[
        b"oscillates(",
        b" times",
        b"count(edges of ",
        b" within ",
        b"clear when ",
        b"latched until reset",
        *[b"any(p in ", b"all(", b"max(", b"count(", b": true)", b"p.x", b" up to 64", b".points "],
        *[b" since ", b"once ", b"after ", b"changed(", b"median(", b"mean(", b"low_pass("],
        *[b"rate(", b"previous(", b"age(", b"names [", b"abs(", b"norm("],
        b"\xe2\x80\xae",
        b"\r\n",
    ],
]
PIECES = [piece if isinstance(piece, bytes) else bytes([piece]) for piece in _PIECES]


def mutate(content: bytes, others: Sequence[bytes], chance: random.Random) -> bytes:
    """`content` with up to eight random changes; now and then of a size that hurts."""
    for _ in range(chance.randint(1, 8)):
        content = chance.choice(_CHANGES)(content, others, chance)
    return content


def _cut(content: bytes, others: Sequence[bytes], chance: random.Random) -> bytes:
    start, end = _stretch(content, chance)
    return content[:start] + content[end:]


def _double(content: bytes, others: Sequence[bytes], chance: random.Random) -> bytes:
    start, end = _stretch(content, chance)
    return content[:end] + content[start:end] + content[end:]


def _insert(content: bytes, others: Sequence[bytes], chance: random.Random) -> bytes:
    at = chance.randint(0, len(content))
    return content[:at] + chance.choice(PIECES) + content[at:]


def _repeat(content: bytes, others: Sequence[bytes], chance: random.Random) -> bytes:
    at = chance.randint(0, len(content))
    return content[:at] + chance.choice(PIECES) * chance.choice((3, 70, 2000)) + content[at:]


def _flip(content: bytes, others: Sequence[bytes], chance: random.Random) -> bytes:
    if not content:
        return b"\0"
    at = chance.randrange(len(content))
    return content[:at] + bytes([chance.randrange(256)]) + content[at + 1 :]


def _splice(content: bytes, others: Sequence[bytes], chance: random.Random) -> bytes:
    other = chance.choice(others)
    start, end = _stretch(other, chance)
    at = chance.randint(0, len(content))
    return content[:at] + other[start:end] + content[at:]


def _stretch(content: bytes, chance: random.Random) -> tuple[int, int]:
    start = chance.randint(0, len(content))
    return start, min(len(content), start + chance.choice((1, 4, 30, 300)))


_CHANGES: Sequence[Callable[[bytes, Sequence[bytes], random.Random], bytes]] = (
    _cut,
    _double,
    _insert,
    _repeat,
    _flip,
    _splice,
)
