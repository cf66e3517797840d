"""The fuzz targets: each kind of external file, with all its readers and all messages about it.

No target runs damaged code. For skills, the targets damage the content of descriptions, the values
that are given at launch, and the text that `ezskiros migrate` parses. For the C engine of monitors,
the bytes are not a file but calls of the engine.
"""

from __future__ import annotations

import io
import json
import re
import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from random import Random
from typing import Any

from rich.console import Console
from rosbags import rosbag1
from rosbags.rosbag2 import CompressionMode, StoragePlugin
from rosbags.typesys.store import Typestore

import crosscheck.catalog
import ezskiros.catalog
import rossmarie.catalog
from crosscheck.check import check_robot
from dslkit.diagnostics import Collector, DeclaredHere, Diagnostic
from dslkit.diagnostics.render_json import render_json
from dslkit.diagnostics.render_sarif import Tool, render_sarif
from dslkit.diagnostics.render_text import render_text
from ezskiros import session
from ezskiros.driver import check_paths
from ezskiros.engine.scenes import load_world
from ezskiros.export import changed_sources, not_exported, read_export
from ezskiros.learning.knowledge import known, read_knowledge, text_of
from ezskiros.learning.learn import learn
from ezskiros.learning.report import print_report
from ezskiros.learning.runs import read_runs
from ezskiros.migrate.files import migrate_paths
from ezskiros.ontology import Ontology, load
from fuzz.engine import trying
from rossmarie.driver import check_file
from rossmarie.ir import EACH, POINTS, Array, List
from rossmarie.lowering import lower
from rossmarie.recordings.errors import RecordingError
from rossmarie.recordings.opening import open_recording
from rossmarie.recordings.system_model import write_model
from support.clouds import MOST, READ, message, random_cloud
from support.learning import LOCATIONS, RAMP, active, header, refill
from support.ontologies import HALL
from support.recordings import (
    ROS1,
    ROS2,
    START_NS,
    Reading,
    machine,
    readings,
    slot,
    write_ros1,
    write_ros2,
)

ENGINE = "engine"
ROOT = Path(__file__).parents[2]
CPU_LIMIT_S = 30.0
"""The largest rules files take 3 s of a quiet machine."""
ROSSMARIE = rossmarie.catalog.CATALOG.sarif_tool("0")
EZSKIROS = ezskiros.catalog.CATALOG.sarif_tool("0")
CROSSCHECK = crosscheck.catalog.CATALOG.sarif_tool("0")


class TooSlowError(Exception):
    """A file took longer than any of its size may take."""


@dataclass(frozen=True)
class Target:
    """A kind of file: what is damaged, and what reads it.

    `read` takes the content and a folder to write it into. It raises what must not be raised.
    """

    seeds: Callable[[], Sequence[bytes]]
    read: Callable[[bytes, Path], None]

    def try_bytes(self, content: bytes, folder: Path) -> None:
        """Read a content. Raises whatever escapes, and `TooSlowError`."""
        begin = time.process_time()
        self.read(content, folder)
        taken = time.process_time() - begin
        if taken > CPU_LIMIT_S:
            raise TooSlowError(f"{taken:.1f} s of CPU for {len(content)} bytes")


def _written(content: bytes, folder: Path, name: str) -> Path:
    path = folder / name
    path.write_bytes(content)
    return path


def _say(found: Sequence[Diagnostic], tool: Tool) -> None:
    """Print findings in all forms, to nowhere."""
    render_text(found).plain.encode()
    render_json(found, command="rossmarie check", file_count=1)
    render_sarif(found, tool)


# --- rules -----------------------------------------------------------------------------------


def _rules() -> list[bytes]:
    """The rules files of this project."""
    folders = (ROOT / "examples", ROOT / "tests" / "fixtures")
    paths = sorted(path for folder in folders for path in folder.rglob("*.ross"))
    return [path.read_bytes() for path in paths]


def _check_rules(content: bytes, folder: Path) -> None:
    """Check a rules file, lower it if it is free of errors, print the findings."""
    result = check_file(_written(content, folder, "fuzzed.ross"))
    if result.program is not None:
        lower(result.program)
    _say(result.diagnostics, ROSSMARIE)


# --- recordings ------------------------------------------------------------------------------


SCANNED = machine(
    [
        ("/battery", "std_msgs/Float32"),
        ("/scan", "sensor_msgs/LaserScan"),
        ("/points", "sensor_msgs/PointCloud2"),
    ],
    [("battery", 0), ("scan", 1), ("mode", 2)],
    [slot(0, "data"), slot(1, "angle_min")],
    [
        Array(1, ("ranges",), 1.0, 0.0, ""),
        *(Array(2, (POINTS, EACH, name), 1.0, 0.0, "", list=0) for name in READ),
    ],
    lists=[List(2, (POINTS,), MOST)],
)


def _sent(ros: Typestore) -> list[Reading]:
    """Numbers, scans, and clouds of several layouts."""
    name = "sensor_msgs/msg/PointCloud2"
    clouds = [random_cloud(Random(seed)).cloud for seed in range(4)]
    sent = [message(ros, index, each) for index, each in enumerate(clouds)]
    found = [("/points", START_NS + index, name, each) for index, each in enumerate(sent)]
    return [*readings(ros), *found]


_BAG_COMPRESSIONS = tuple(rosbag1.Writer.CompressionFormat)


def _bags() -> list[bytes]:
    with tempfile.TemporaryDirectory() as folder:
        paths = {Path(folder) / f"{kind}.bag": kind for kind in (None, *_BAG_COMPRESSIONS)}
        for path, kind in paths.items():
            write_ros1(path, _sent(ROS1), compression=kind)
        return [path.read_bytes() for path in paths]


def _ros2(plugin: StoragePlugin, *modes: CompressionMode) -> list[bytes]:
    with tempfile.TemporaryDirectory() as folder:
        written = [
            write_ros2(Path(folder) / mode.name, _sent(ROS2), plugin, mode) for mode in modes
        ]
        files = [path for each in written for path in each.iterdir() if path.suffix != ".yaml"]
        return [path.read_bytes() for path in files]


def _mcaps() -> list[bytes]:
    return _ros2(StoragePlugin.MCAP, CompressionMode.NONE, CompressionMode.STORAGE)


def _databases() -> list[bytes]:
    return _ros2(StoragePlugin.SQLITE3, CompressionMode.NONE)


def _tables() -> list[bytes]:
    return [
        b"time,battery,/scan.ranges[0]\n0,12.5,1\n0.25,,2\n1e1,nan,\n",
        b'time_ns;/battery.data;"/scan.angle_min"\n1432235498025043042;1;"2"\n',
        b"\xef\xbb\xbft\tbattery\r\n5\t1\r\n4\t1\r\n",
    ]


def _replay(suffix: str, content: bytes, folder: Path) -> None:
    """Read all that rules could read, and what a system model says of it."""
    path = _written(content, folder, f"fuzzed{suffix}")
    collector = Collector()
    try:
        with open_recording(path) as recording:
            collector.extend(recording.findings)
            for _ in recording.batches(SCANNED, collector, {}):
                pass
            write_model(recording)
    except RecordingError as error:
        collector.add(error.diagnostic)
    _say(collector.sorted(), ROSSMARIE)


# --- ontologies and scenes -------------------------------------------------------------------

RDF_XML = b"""<?xml version="1.0"?>
<!DOCTYPE rdf:RDF [ <!ENTITY test "http://example.org/test.owl#"> ]>
<rdf:RDF xmlns="http://example.org/test.owl#" xml:base="http://example.org/test.owl"
     xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"
     xmlns:owl="http://www.w3.org/2002/07/owl#" xmlns:rdfs="http://www.w3.org/2000/01/rdf-schema#">
  <owl:Class rdf:about="&test;Robot"/>
  <owl:Class rdf:ID="Arm"><rdfs:subClassOf rdf:resource="#Robot"/></owl:Class>
  <owl:ObjectProperty rdf:about="#hasA"><rdfs:domain rdf:resource="#Robot"/></owl:ObjectProperty>
</rdf:RDF>
"""
JSON_LD = b"""{"@context": {"owl": "http://www.w3.org/2002/07/owl#", "t": "http://example.org/t.owl#"},
 "@graph": [{"@id": "t:Robot", "@type": "owl:Class"}, {"@id": "t:Arm", "owl:in": [1, "a", true]}]}
"""


def _ontologies() -> list[bytes]:
    return [RDF_XML, JSON_LD, *(path.read_bytes() for path in sorted(HALL.glob("*.ttl")))]


def _load(content: bytes, folder: Path) -> None:
    """Load an ontology of the kind that it begins as."""
    kinds = {b"{": ".jsonld", b"<": ".owl"}
    path = _written(content, folder, f"fuzzed{kinds.get(content.lstrip()[:1], '.ttl')}")
    collector = Collector()
    with session.collecting(collector):
        ontology = load(path)
    for name in (*ontology.model.classes, *ontology.model.relations):
        ontology.label(name, DeclaredHere())
    _say(collector.sorted(), EZSKIROS)


def _scenes() -> list[bytes]:
    return [path.read_bytes() for path in sorted(HALL.parent.glob("*.turtle"))]


@cache
def _hall() -> Ontology:
    return load(HALL)


def _open_scene(content: bytes, folder: Path) -> None:
    """Check a scene, make a world of it, and write that."""
    world, found = load_world(_hall(), _written(content, folder, "fuzzed.turtle"))
    (folder / "saved.turtle").write_text(world.turtle())
    _say(found, EZSKIROS)


# --- skills ----------------------------------------------------------------------------------

SKILL = """\
from ezskiros import SkillDescription
from ezskiros.ontology import load

skiros = load({ontology!r}).skiros


class Fuzzed(SkillDescription):
    {words!r}

    def description(self, Object: skiros.Product, Word: str = {word!r}, Number: float = 0.5):
        self.post_conditions += Object.hasA(Object)
"""


def _values() -> list[bytes]:
    values = b"Fuzzed: {Word: 'of mouth', Number: 0.3}\n# more\nOther:\n  - &a [1, 2]\n  - *a\n"
    before = ROOT / "tests" / "ezskiros" / "migrate" / "before"
    return [values, values, *(path.read_bytes() for path in sorted(before.glob("*.txt")))]


def _describe(content: bytes, folder: Path) -> None:
    """Values that are known at launch, words in a description, and a text that is migrated."""
    words = content.decode("utf-8", "replace")
    module = _written(
        SKILL.format(ontology=str(HALL), words=words, word=words[:20]).encode(), folder, "fuzzed.py"
    )
    checked = check_paths([module], _written(content, folder, "fuzzed.yaml"))
    _say(checked.diagnostics, EZSKIROS)
    migration = migrate_paths([_written(content, folder, "old.py")])
    _say(migration.diagnostics, EZSKIROS)


def _exports() -> list[bytes]:
    whole = (ROOT / "examples" / "whiteboard" / "skills.json").read_bytes()
    half = whole.partition(b'"context"')[0].rstrip().rstrip(b",") + b"}"
    without_sources = re.sub(rb'"sources": \[.*?\]', b'"sources": []', whole, flags=re.DOTALL)
    return [whole, half, without_sources]


KNOWING_SKILLS = """
skills "fuzzed.json";
input force = topic /wrench : geometry_msgs/WrenchStamped .wrench.force timeout 0.1 sec;
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec;
action halt { block /cmd_vel : geometry_msgs/Twist; }
action retract { cancel /arm_controller/follow_joint_trajectory within 0.5 sec else halt; }
rule contact: if norm(force) > 5 N then { retract; }
    unless doing Wipe(Board: Whiteboard) then if norm(force) > 20 N then { retract; };
rule calm: if speed > 0.5 m/s while doing Drive then { halt; };
"""


def _read_export(content: bytes, folder: Path) -> None:
    """Read a skills file in each language, compare its sources, and look at both together."""
    path = _written(content, folder, "fuzzed.json")
    found = read_export(path)
    if isinstance(found, Diagnostic):
        _say([found], EZSKIROS)
    else:
        _say([*changed_sources(found), *not_exported(found, [path])], EZSKIROS)
    _say(check_robot(_written(KNOWING_SKILLS.encode(), folder, "fuzzed.ross")), CROSSCHECK)


# --- runs ------------------------------------------------------------------------------------

RUN = (refill(0, RAMP), [header(-1, 11), *active(2, 5)])


def _lines(found: Sequence[Mapping[str, Any]]) -> bytes:
    return b"".join(json.dumps(each).encode() + b"\n" for each in found)


def _records() -> list[bytes]:
    """A trace, verdicts, and the knowledge of both."""
    with tempfile.TemporaryDirectory() as folder:
        paths = [_written(_lines(each), Path(folder), f"{len(each)}.jsonl") for each in RUN]
        runs, _ = read_runs(paths)
        knowledge = known(learn(runs, LOCATIONS), runs, Path(folder))
        return [*map(_lines, RUN), text_of(knowledge).encode()]


def _read_records(content: bytes, folder: Path) -> None:
    """Learn from a damaged file with each other half, and read it as knowledge."""
    path = _written(content, folder, "fuzzed.jsonl")
    for other in RUN:
        runs, found = read_runs([path, _written(_lines(other), folder, "other.jsonl")])
        _say(found, EZSKIROS)
        lessons = learn(runs, LOCATIONS)
        text_of(known(lessons, runs, folder))
        print_report(lessons, Console(file=io.StringIO()), str)
    knowledge = read_knowledge(path)
    if isinstance(knowledge, Diagnostic):
        _say([knowledge], EZSKIROS)
    else:
        text_of(knowledge)
        print_report(knowledge.lessons, Console(file=io.StringIO()), str)


TARGETS = {
    "rules": Target(_rules, _check_rules),
    "bag": Target(_bags, partial(_replay, ".bag")),
    "mcap": Target(_mcaps, partial(_replay, ".mcap")),
    "db3": Target(_databases, partial(_replay, ".db3")),
    "csv": Target(_tables, partial(_replay, ".csv")),
    "ontology": Target(_ontologies, _load),
    "scene": Target(_scenes, _open_scene),
    "skills": Target(_values, _describe),
    "export": Target(_exports, _read_export),
    "runs": Target(_records, _read_records),
    ENGINE: Target(trying.seeds, trying.read),
}
"""The targets by their names in `make fuzz TARGET=...`."""
