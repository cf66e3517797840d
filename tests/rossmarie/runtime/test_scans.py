"""The beams that a node takes of a scan are those that Python takes, whatever the scan says."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from random import Random
from types import SimpleNamespace

import rossmarie
from rossmarie.ir import INVALID, RETURNS, Sector
from rossmarie.ir.scans import UnreadableScanError, beams, sector
from support.c_compiler import run
from support.parts import GXX, needs
from support.scans import LIES, plain_scan, random_scan, single, truthful

HERE = Path(__file__).parent
RUNTIME = Path(rossmarie.__file__).parent / "runtime" / "ros"
OPTIONS = ("-std=c++20", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror", "-g",
           "-ffp-contract=off", "-fsanitize=address,undefined",
           "-fno-sanitize-recover=undefined")  # fmt: skip
SEEDS = 400
MOST = 360
UNKNOWN = 2**64 - 1

Case = tuple[SimpleNamespace, Sector]


def line_of(case: Case) -> str:
    scan, wanted = case
    head = (wanted.first, wanted.width, scan.angle_min, scan.angle_max, scan.angle_increment,
            scan.range_min, scan.range_max)  # fmt: skip
    arrays = (len(scan.ranges), *scan.ranges, len(scan.intensities), *scan.intensities)
    return " ".join(f"{each:.17g}" for each in (*head, *arrays))


def numbers_of(case: Case) -> list[str]:
    """The counts and the numbers that Python has, as the program prints them."""
    scan, wanted = case
    return [
        *texts_of([sector_of(scan, wanted)], unknown=0),
        *texts_of(columns_of(scan, "range", "angle", "intensity")),
        *texts_of(columns_of(scan, "invalid")),
    ]


def sector_of(scan: SimpleNamespace, wanted: Sector) -> list[float]:
    try:
        return list(map(float, sector(scan, wanted)))
    except UnreadableScanError:
        return []


def columns_of(scan: SimpleNamespace, *fields: str) -> list[list[float]] | None:
    try:
        return [
            beams(scan, INVALID, "angle", MOST).tolist()
            if field == "invalid"
            else beams(scan, RETURNS, field, MOST).tolist()
            for field in fields
        ]
    except UnreadableScanError:
        return None


def texts_of(columns: Sequence[Sequence[float]] | None, unknown: int = UNKNOWN) -> list[str]:
    if columns is None:
        return [str(unknown)]
    return [str(len(columns[0])), *(f"{number:.17g}" for column in columns for number in column)]


def scans() -> Iterator[SimpleNamespace]:
    yield from (random_scan(Random(seed)).scan for seed in range(SEEDS))
    for seed in range(SEEDS):  # beams anywhere, and not only at whole degrees
        random = Random(seed)
        ranges = [single(random.uniform(0.0, 15.0)) for _ in range(random.randrange(1, 365))]
        yield plain_scan(ranges, random.uniform(-400.0, 400.0), random.uniform(-1.2, 1.2) or 1.0)
    for lie in LIES.values():
        scan = truthful()
        lie(scan)
        yield scan
    scan = truthful()
    scan.intensities = scan.intensities[1:]
    yield scan


def cases() -> Iterator[Case]:
    random = Random(1)
    for scan in scans():
        first, step = (
            each if math.isfinite(each) else 0.5 for each in (scan.angle_min, scan.angle_increment)
        )
        width = random.choice([random.uniform(0.0, 2 * math.pi), 2 * math.pi, abs(step)])
        yield scan, Sector(random.choice([-math.pi, random.uniform(-3.0, 3.0), first]), width)


@needs(GXX)
def test_a_node_takes_the_beams_that_python_takes(tmp_path: Path) -> None:
    program = tmp_path / "scans"
    source = HERE / "programs" / "scans.cpp"
    run(["g++", *OPTIONS, f"-I{RUNTIME}", source, "-o", program])
    given = list(cases())
    text = "\n".join(map(line_of, given))
    found = run([program], text.encode()).stdout.decode().splitlines()
    taken = [[text.replace("-nan", "nan") for text in line.split()] for line in found]
    assert taken == [numbers_of(case) for case in given]
    known = [int(line[0]) for line in taken]
    assert sum(count > 0 for count in known) > SEEDS // 2
    assert math.fsum(known) > 20 * SEEDS
