"""The points that a node takes of a cloud are those that Python takes, whatever the cloud says."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from random import Random
from types import SimpleNamespace

import rossmarie
from rossmarie.ir.clouds import UnreadableCloudError, columns
from support.c_compiler import run
from support.clouds import LIES, MOST, READ, random_cloud, truthful
from support.parts import GXX, needs

HERE = Path(__file__).parent
RUNTIME = Path(rossmarie.__file__).parent / "runtime" / "ros"
OPTIONS = ("-std=c++20", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror", "-g",
           "-fsanitize=address,undefined", "-fno-sanitize-recover=undefined")  # fmt: skip
SEEDS = 400
UNKNOWN = 2**64 - 1


def line_of(cloud: SimpleNamespace) -> str:
    fields = [f"{each.name} {each.offset} {each.datatype} {each.count}" for each in cloud.fields]
    numbers = (cloud.height, cloud.width, int(cloud.is_bigendian), cloud.point_step, cloud.row_step)
    return " ".join(map(str, (*numbers, len(fields), *fields, len(cloud.data), *cloud.data)))


def numbers_of(cloud: SimpleNamespace) -> list[str]:
    """The count and the columns that Python has, as the program prints them."""
    try:
        found = columns(cloud, READ, MOST)
    except UnreadableCloudError:
        return [str(UNKNOWN)]
    texts = (f"{number:.17g}" for column in found for number in column)
    return [str(len(found[0])), *texts]


def clouds() -> Iterator[SimpleNamespace]:
    yield from (random_cloud(Random(seed)).cloud for seed in range(SEEDS))
    for lie in LIES.values():
        cloud = truthful()
        lie(cloud)
        yield cloud
    for height, width in ((0, 2**32 - 1), (2**32 - 1, 0)):
        cloud = truthful()
        cloud.height, cloud.width, cloud.data = height, width, b""
        yield cloud


@needs(GXX)
def test_a_node_takes_the_points_that_python_takes(tmp_path: Path) -> None:
    program = tmp_path / "clouds"
    source = HERE / "programs" / "clouds.cpp"
    run(["g++", *OPTIONS, f"-I{RUNTIME}", source, "-o", program])
    given = list(clouds())
    text = "\n".join(map(line_of, given))
    found = run([program], text.encode()).stdout.decode().splitlines()
    taken = [[text.replace("-nan", "nan") for text in line.split()] for line in found]
    assert taken == [numbers_of(cloud) for cloud in given]
    known = [int(line[0]) for line in taken if int(line[0]) != UNKNOWN]
    assert len(known) > SEEDS // 2
    assert math.fsum(known) > SEEDS
