"""Small files that stand for gigabytes or minutes: each gets a located finding, within limits.

The limits of the product are on the page docs/reference/limits.md; those of these tests are wider,
because other programs run beside them.
"""

from __future__ import annotations

import bz2
import json
import sqlite3
import struct
import subprocess
import sys
from collections.abc import Mapping
from contextlib import closing
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from rosbags import rosbag1
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer

from support import command_line
from support.ontologies import HALL
from support.recordings import (
    ROS1,
    ROS2,
    START_NS,
    battery,
    readings,
    write_kind,
    write_mcap,
    write_ros2,
)

if sys.version_info >= (3, 14):
    from compression import zstd
else:
    from backports import zstd

MEMORY = 3 << 30
"""Address space of a command, most of which libraries reserve and do not use."""
SECONDS = 60.0


def run(program: str, *arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """An installed program that may take so much memory and time."""
    return command_line.run(program, *arguments, timeout=SECONDS, memory=MEMORY)


# --- ontologies and scenes -------------------------------------------------------------------

RDF = '<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#" xmlns:e="http://e#">'
NESTED = 300_000


def laughs(before: str = "", after: str = "") -> str:
    """Nine entities, each of which is ten of the one before: 10 GB of text."""
    values = ["haha haha ", *(f"&a{i};" * 10 for i in range(9))]
    declared = "\n".join(f'<!ENTITY a{i} "{value}">' for i, value in enumerate(values))
    head = f"<!DOCTYPE rdf:RDF [{before}\n{declared}\n{after}]>"
    return f'{head}\n{RDF}<e:A e:b="&a9;"/></rdf:RDF>'


def repeated() -> str:
    """A long entity that is used often; 20 GB of text."""
    entity = f'<!ENTITY a "{"a" * 100_000}">'
    return f"<!DOCTYPE r [\n{entity}]>\n{RDF}\n" + '<e:A e:b="&a;"/>' * 200_000 + "</rdf:RDF>"


def namespaces() -> str:
    declared = " ".join(f'xmlns:e{i}="http://e#"' for i in range(50_000))
    nothing = "<rdf:Description rdf:about='http://x'/>" * 100_000
    return f"{RDF.replace('>', ' ' + declared + '>')}{nothing}</rdf:RDF>"


ONTOLOGIES = {
    "entities in entities.owl": (laughs(), 3),
    "entities in a comment.owl": (laughs("<!--", "-->"), 3),
    "an entity from elsewhere.owl": ('<!DOCTYPE r [<!ENTITY a SYSTEM "/etc/passwd">]>' + RDF, 1),
    "a long entity.owl": (repeated(), 4),
    "deep elements.owl": (f"{RDF}\n" + "<rdf:Description><e:a>" * NESTED, 2),
    "many namespaces.owl": (namespaces(), 1),
    "deep objects.jsonld": ('\n{"http://b":' * NESTED + "1" + "}" * NESTED, 202),
    "deep lists.jsonld": ('{"http://b":\n' + "[" * NESTED + "]" * NESTED + "}", 2),
    "deep terms.ttl": ("<a:a> <a:b>\n" + "<<( <a:a> <a:b> " * NESTED + "1" + " )>>" * NESTED, 2),
    "deep terms.nt": ("<a:a> <a:b> " + "<<( <a:a> <a:b> " * NESTED + "1" + " )>>" * NESTED, 1),
    "a long subject.ttl": (f"<http://x/{'a' * 1_000_000}> <http://p> {'1,' * 20_000}1.", 1),
    "a long prefix.ttl": (
        f"@prefix a: <http://x/{'a' * 1_000_000}> ." + "a:a a:b a:c . " * 9_999,
        1,
    ),
}


def check_ontology(path: Path, *options: str) -> subprocess.CompletedProcess[str]:
    """A check of a module that loads an ontology, and nothing else."""
    module = path.with_name("skills.py")
    module.write_text("from ezskiros.ontology import load\n\nload()\n")
    return run("ezskiros", "check", "--ontology", path, module, *options)


@pytest.mark.parametrize("name", ONTOLOGIES)
def test_ontologies_beyond_a_limit_are_reported_at_their_place(name: str, tmp_path: Path) -> None:
    text, line = ONTOLOGIES[name]
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    done = check_ontology(path, "--format", "json")
    found = {each["code"]: each["primary"] for each in json.loads(done.stdout)["diagnostics"]}
    assert found["EZS107"]["file"] == str(path)
    assert found["EZS107"]["start"]["line"] == line
    assert done.returncode == 1, done.stderr


def test_a_file_larger_than_an_ontology_may_be_is_not_read(tmp_path: Path) -> None:
    path = tmp_path / "huge.ttl"
    with path.open("wb") as file:
        file.truncate(8 << 30)  # without a block on the disk
    done = check_ontology(path)
    assert "EZS107" in done.stdout, done.stderr
    assert done.returncode == 1


@pytest.mark.parametrize("name", ["deep terms.ttl", "a long subject.ttl"])
def test_scenes_beyond_a_limit_are_reported(name: str, tmp_path: Path) -> None:
    scene = tmp_path / "scene.turtle"
    scene.write_text(ONTOLOGIES[name][0], encoding="utf-8")
    done = run("ezskiros", "check", scene, "--ontology", HALL)
    assert "EZS107" in done.stdout, done.stderr


# --- recordings ------------------------------------------------------------------------------

RULES = """\
action stop;
input battery = topic /battery : std_msgs/Float32 .data in V timeout 3 sec
rule low: if battery < 1 V then { stop; };
"""
ZEROS = bytes(80 << 20)


def replay(path: Path, rules: str = RULES) -> subprocess.CompletedProcess[str]:
    """A replay that must end by itself, without a traceback."""
    written = path.parent / "low.ross"
    written.write_text(rules)
    done = run("rossmarie", "replay", written, path)
    assert "Traceback" not in done.stderr, done.stderr
    assert done.returncode in (0, 1, 2), done.stderr
    return done


def bag_with(path: Path, bomb: bytes) -> Path:
    """A whole bag of ten chunks, in the fifth of which a bomb is."""
    writer = rosbag1.Writer(path)
    writer.set_compression(rosbag1.Writer.CompressionFormat.BZ2)
    chunks = iter(range(100))
    writer.compressor = lambda content: bomb if next(chunks) == 4 else bz2.compress(content)
    writer.chunk_threshold = 1
    with writer:
        connection = writer.add_connection("/battery", "std_msgs/msg/Float32", typestore=ROS1)
        for number in range(10):
            name, message = battery(ROS1, 12.0)
            content = ROS1.serialize_ros1(message, name)
            writer.write(connection, START_NS + number * 1_000_000_000, content)
    return path


def mcap_with(folder: Path, bombs: Mapping[int, bytes], size: int | None = None) -> Path:
    """A whole MCAP file of ten chunks, some of which are bombs, of the `size` that they state."""
    writer = Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP)
    writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
    with writer:
        connection = writer.add_connection("/battery", "std_msgs/msg/Float32", typestore=ROS2)
        storage: Any = writer.storage
        for number in range(10):
            name, message = battery(ROS2, 12.0)
            content = ROS2.serialize_cdr(message, name)
            writer.write(connection, START_NS + number * 1_000_000_000, content)
            storage.compressor = zstd.compress
            if number in bombs:
                storage.compressor = partial(lambda bomb, _: bomb, bombs[number])
                storage.chunk.bio.seek(size or storage.chunk.bio.tell())  # what it states
            storage.close_chunk()
    return next(folder.glob("*.mcap"))


def test_bz2_in_a_bag_is_reported_with_its_chunk_and_the_rest_is_used(tmp_path: Path) -> None:
    bomb = bz2.compress(ZEROS) * 60  # 5 GB
    path = bag_with(tmp_path / "drive.bag", bomb)
    done = replay(path)
    assert "ROSS615" in done.stdout
    at = path.read_bytes().index(bomb)
    reported = (
        f"the chunk at byte {at} is incomplete: {len(bomb)} bytes decompress to more than 64 MiB"
    )
    assert reported in done.stdout
    assert "9 messages could be read" in done.stdout


@pytest.mark.parametrize("size", [None, 80 * 75 << 20], ids=["reported small", "reported large"])
def test_zstd_in_an_mcap_is_reported_with_its_chunk_and_the_rest_is_used(
    tmp_path: Path, size: int | None
) -> None:
    bomb = zstd.compress(ZEROS) * 75  # 6 GB
    path = mcap_with(tmp_path / "drive", {4: bomb}, size)
    done = replay(path)
    assert "ROSS615" in done.stdout
    assert f"the chunk at byte {path.read_bytes().index(bomb)} is incomplete" in done.stdout
    assert "9 messages could be read" in done.stdout


def test_many_chunks_that_are_each_within_a_limit_are_reported(tmp_path: Path) -> None:
    metadata = struct.pack("<BQ", 0x0C, 60 << 20) + bytes(60 << 20)  # a record to pass over
    bombs = dict.fromkeys(range(1, 9), zstd.compress(metadata))
    path = mcap_with(tmp_path / "drive", bombs, len(metadata))
    done = replay(path)
    assert "too large for the size of the file" in done.stdout
    assert "2 messages could be read" in done.stdout


def test_a_file_that_is_compressed_as_a_whole_is_reported(tmp_path: Path) -> None:
    folder = write_ros2(
        tmp_path / "drive", readings(ROS2), StoragePlugin.SQLITE3, CompressionMode.FILE
    )
    (packed,) = folder.glob("*.zstd")
    packed.write_bytes(zstd.compress(ZEROS) * 75)
    done = replay(folder)
    assert "ROSS614" in done.stdout
    assert "too large for the size of the file" in done.stdout


def test_messages_that_are_compressed_one_by_one_are_reported(tmp_path: Path) -> None:
    folder = write_ros2(
        tmp_path / "drive", readings(ROS2), StoragePlugin.SQLITE3, CompressionMode.MESSAGE
    )
    (stored,) = folder.glob("*.db3")
    with closing(sqlite3.connect(stored)) as database, database:
        bomb = zstd.compress(ZEROS) * 75
        database.execute("UPDATE messages SET data = ? WHERE id = 9", (bomb,))
    done = replay(folder)
    assert "decompress to more than 64 MiB" in done.stdout


def test_metadata_that_doubles_with_each_line_is_reported(tmp_path: Path) -> None:
    folder = write_ros2(tmp_path / "drive", readings(ROS2), StoragePlugin.MCAP)
    lines = [f"a{i}: &a{i} {{<<: [*a{i - 1}, *a{i - 1}]}}" for i in range(1, 40)]
    (folder / "metadata.yaml").write_text("a0: &a0 {x: 1}\n" + "\n".join(lines))
    assert "the recording is damaged" not in replay(folder).stdout  # its file says it all


TABLES = {
    "a view": (
        "CREATE TABLE stored(id, topic_id, timestamp, data)",
        "DROP TABLE messages",
        "CREATE VIEW messages AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) "
        "SELECT i AS id, 1 AS topic_id, i AS timestamp, x'00010000' AS data FROM n",
    ),
    "a computed column": (
        "DROP TABLE messages",
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, "
        "data BLOB GENERATED ALWAYS AS (zeroblob(900000000)) VIRTUAL)",
        "INSERT INTO messages(topic_id, timestamp) VALUES (1, 1), (1, 2), (1, 3)",
    ),
}


@pytest.mark.parametrize("name", TABLES)
def test_tables_that_are_computed_are_reported(name: str, tmp_path: Path) -> None:
    path = write_kind(tmp_path, "db3", readings(ROS2))
    with closing(sqlite3.connect(path)) as database, database:
        for statement in TABLES[name]:
            database.execute(statement)
    done = replay(path)
    assert "ROSS614" in done.stdout
    assert "`messages`" in done.stdout


def test_a_line_without_end_is_reported(tmp_path: Path) -> None:
    path = tmp_path / "drive.csv"
    with path.open("wb") as file:
        file.write(b"time,battery\n0,12\n")
        file.truncate(8 << 30)  # without a block on the disk
    done = replay(path)
    assert "line 3 is longer than 16 MiB" in done.stdout


def redefined(folder: Path, text: str, *messages: bytes) -> Path:
    """A recording that brings along a definition of its own of what the rules read."""
    schema = ("std_msgs/msg/Float32", "ros1msg", f"float32 data\n{text}")
    stamped = [(START_NS + at, content) for at, content in enumerate(messages)]
    return write_mcap(folder / "odd.mcap", "ros1", schema, ("/battery", "ros1"), stamped)


def part(name: str, text: str) -> str:
    return f"{'=' * 80}\nMSG: b/{name}\n{text}\n"


DOUBLED = "".join(part(f"T{i}", f"b/T{i + 1} a\nb/T{i + 1} b") for i in range(40))
DEFINITIONS = {
    "a long array": "string[100000000] a\n",
    "an array of nothing": "b/Empty[4000000000] a\n" + part("Empty", ""),
    "itself": "b/Odd a\n" + part("Odd", "b/Odd a"),
    "doubled": "b/T0 a\n" + DOUBLED + part("T40", ""),
}


@pytest.mark.parametrize("name", DEFINITIONS)
def test_definitions_that_stand_for_much_are_not_used(name: str, tmp_path: Path) -> None:
    done = replay(redefined(tmp_path, DEFINITIONS[name], bytes(100)))
    assert "1 of 1 messages on `/battery` cannot be read" in done.stdout


def test_a_message_of_many_small_parts_is_unknown(tmp_path: Path) -> None:
    many = struct.pack("<fI", 12.0, 50_000_000) + bytes(50_000_000)
    few = struct.pack("<fI", 12.0, 0)
    path = redefined(tmp_path, "b/One[] many\n" + part("One", "bool is_one"), many, few)
    done = replay(path)
    assert "1 of 2 messages on `/battery` cannot be read" in done.stdout
    assert "the limit for its type" in done.stdout


# --- other files -----------------------------------------------------------------------------

PACKAGE = '<?xml version="1.0"?>\n{0}<package format="3"><name>p</name>{1}</package>'
PACKAGES = {
    "deep elements": PACKAGE.format("", "<a>" * 20_000 + "</a>" * 20_000),
    "entities": PACKAGE.format('<!DOCTYPE p [<!ENTITY a "haha"><!ENTITY b "&a;&a;">]>', "&b;"),
    "large": PACKAGE.format("", f"<a>{'a' * 9_000_000}</a>"),
}


@pytest.mark.parametrize("name", PACKAGES)
def test_a_package_xml_beyond_a_limit_is_reported(name: str, tmp_path: Path) -> None:
    (tmp_path / "low.ross").write_text(RULES)
    (tmp_path / "package.xml").write_text(PACKAGES[name])
    out = tmp_path / "generated"
    done = run("rossmarie", "build", tmp_path / "low.ross", "--target", "ros2", "--out", out)
    assert "ROSS807" in done.stdout, done.stderr
    assert done.returncode in (1, 2)


VALUES = {
    "deep lists": "[" * 100_000,
    "deep lists of lines": "- " * 100_000,
    "large": "# " + "a" * 9_000_000,
}


@pytest.mark.parametrize("name", VALUES)
def test_values_that_are_known_at_launch_take_no_gigabytes(name: str, tmp_path: Path) -> None:
    (tmp_path / "launch.yaml").write_text(VALUES[name])
    skills = HALL.parent / "skills"
    done = run(
        "ezskiros", "check", skills, "--ontology", HALL, "--config", tmp_path / "launch.yaml"
    )
    assert "Traceback" not in done.stderr, done.stderr
    assert "launch.yaml" in done.stdout
    assert done.returncode == 1


@pytest.mark.parametrize(
    "text",
    ["x = " + "(" * 9_000, "x = " + "not " * 20_000 + "1", "x = y" + ".z" * 900],
    ids=["brackets", "operators", "names"],
)
def test_python_that_is_too_deep_is_reported(text: str, tmp_path: Path) -> None:
    path = tmp_path / "old.py"
    path.write_text(text)
    done = run("ezskiros", "migrate", path)
    assert "EZS701" in done.stdout + done.stderr
    assert done.returncode > 0
