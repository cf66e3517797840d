"""Nothing in the cache is believed that this user's own processes did not keep there."""

from __future__ import annotations

import os
import pickle
import re
import shutil
import signal
import struct
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

import rossmarie
from rossmarie.syntax.grammar import load_tables
from support.depth import deep
from support.parts import C_COMPILER, ROOT, needs

pytestmark = needs(C_COMPILER)

RULES = """
action stop;
input person = topic /person : geometry_msgs/PointStamped .point.x timeout 1 sec
rule near: if person < 0.7 m then { stop; };
"""
NOBODY = 65534
LOAD = "import sys, rossmarie; sys.stdout.write(rossmarie.load(sys.argv[1]).kind)"


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The user's cache folder; it does not exist yet."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    load_tables.cache_clear()
    yield tmp_path / "cache" / "rossmarie"
    load_tables.cache_clear()


@pytest.fixture
def rules(tmp_path: Path) -> Path:
    path = tmp_path / "rules.ross"
    path.write_text(RULES)
    return path


@pytest.fixture(scope="module")
def filled(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A cache with the library of the rules, and its key, to copy: it takes a second to fill."""
    folder = tmp_path_factory.mktemp("filled")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(folder / "cache"))
        patch.setenv("XDG_STATE_HOME", str(folder / "state"))
        rules = folder / "rules.ross"
        rules.write_text(RULES)
        stops_at(rules, 0.6)
    load_tables.cache_clear()
    return folder


@pytest.fixture
def library(cache: Path, filled: Path) -> Path:
    """The library of the rules in the cache."""
    for name in ("cache", "state"):
        shutil.copytree(filled / name, cache.parents[1] / name)
    return kept(cache, ".so")


def kept(cache: Path, kind: str) -> Path:
    """The one kept file of a kind."""
    (found,) = (path for path in cache.iterdir() if kind in path.suffixes)
    return found


def stops_at(rules: Path, metres: float) -> bool:
    """Say whether the rule is active in a monitor that is loaded as in a new process."""
    load_tables.cache_clear()
    monitor = rossmarie.load(rules)
    assert monitor.kind == "native"
    monitor.update(1_000_000_000, {"person": metres})
    return monitor.active == ("near",)


def loaded(rules: Path) -> subprocess.CompletedProcess[str]:
    """Load the rules in a process of their own."""
    return subprocess.run(
        [sys.executable, "-c", LOAD, rules], capture_output=True, text=True, timeout=60
    )


def constructor(folder: Path, mark: Path) -> bytes:
    """A library that makes a file as soon as it is loaded."""
    source = folder / "constructor.c"
    source.write_text(
        "#include <stdio.h>\n__attribute__((constructor)) static void run(void) "
        f'{{ FILE *mark = fopen("{mark}", "w"); if (mark) fclose(mark); }}\n'
    )
    built = folder / "constructor.so"
    subprocess.run(["cc", "-shared", "-fPIC", "-o", built, source], check=True)
    return built.read_bytes()


# --- libraries -----------------------------------------------------------------------------------


def test_a_patched_library_is_not_loaded(
    rules: Path, library: Path, caplog: pytest.LogCaptureFixture
) -> None:
    content = library.read_bytes()
    about_0_7 = re.compile(rb".{6}\xe6\x3f", re.DOTALL)
    patched = about_0_7.sub(struct.pack("<d", 0.1), content)
    assert patched != content
    library.unlink()
    library.write_bytes(patched)
    library.chmod(0o600)
    assert stops_at(rules, 0.6)
    assert f"{library}: the content is not what was kept" in caplog.text
    assert library.read_bytes() == content, "it was built again"
    caplog.clear()
    assert stops_at(rules, 0.6)
    assert caplog.text == ""


def test_the_library_of_other_rules_is_not_loaded_under_this_name(
    cache: Path, rules: Path, library: Path, caplog: pytest.LogCaptureFixture
) -> None:
    library.rename(cache / "mine")
    other = rules.with_name("other.ross")
    other.write_text(RULES.replace("0.7", "0.1"))
    assert not stops_at(other, 0.6)
    kept(cache, ".so").rename(library)
    assert stops_at(rules, 0.6)
    assert "the content is not what was kept" in caplog.text


@pytest.mark.parametrize("part", [0.3, *deep([0.0, 0.9])])
def test_a_truncated_library_ends_no_process(rules: Path, library: Path, part: float) -> None:
    whole = library.stat().st_size
    os.truncate(library, int(whole * part))
    for _ in range(2):
        done = loaded(rules)
        assert (done.returncode, done.stdout) == (0, "native"), done.stderr
    assert library.stat().st_size == whole


@needs(ROOT)
def test_no_code_of_another_user_is_run(rules: Path, library: Path, tmp_path: Path) -> None:
    mark = tmp_path / "mark"
    library.write_bytes(constructor(tmp_path, mark))
    os.chown(library, NOBODY, NOBODY)
    done = loaded(rules)
    assert not mark.exists()
    assert done.stdout == "native"
    assert f"{library}: the file belongs to another user" in done.stderr
    assert library.stat().st_uid == 0, "it was built again"


@needs(ROOT)
def test_a_folder_of_another_user_is_left_alone(
    cache: Path, rules: Path, library: Path, tmp_path: Path
) -> None:
    mark = tmp_path / "mark"
    planted = constructor(tmp_path, mark)
    library.write_bytes(planted)
    os.chown(cache, NOBODY, NOBODY)
    cache.chmod(0o777)
    done = loaded(rules)
    assert not mark.exists()
    assert done.stdout == "native", "it was built all the same"
    assert f"{cache}: the folder belongs to another user" in done.stderr
    assert library.read_bytes() == planted, "and not kept there"


def test_others_are_shut_out_of_a_folder_of_ours(cache: Path, rules: Path, library: Path) -> None:
    cache.chmod(0o777)
    assert stops_at(rules, 0.6)
    assert cache.stat().st_mode & 0o777 == 0o755


def test_a_file_that_others_can_write_to_is_not_used(
    rules: Path, library: Path, caplog: pytest.LogCaptureFixture
) -> None:
    library.chmod(0o666)
    assert stops_at(rules, 0.6)
    assert f"{library}: other users can read or write the file" in caplog.text
    assert library.stat().st_mode & 0o777 == 0o600


def test_a_link_in_place_of_a_library_is_not_followed(
    rules: Path, library: Path, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    elsewhere = tmp_path / "elsewhere.so"
    library.rename(elsewhere)
    library.symlink_to(elsewhere)
    before = elsewhere.read_bytes()
    assert stops_at(rules, 0.6)
    assert f"{library}: the file is a symbolic link" in caplog.text
    assert not library.is_symlink()
    assert elsewhere.read_bytes() == before


def test_a_link_in_place_of_the_folder_is_not_followed(
    cache: Path, rules: Path, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    cache.parent.mkdir()
    cache.symlink_to(elsewhere)
    assert stops_at(rules, 0.6)
    assert f"{cache}: the folder is a symbolic link" in caplog.text
    assert list(elsewhere.iterdir()) == []


@pytest.mark.parametrize("make", [os.mkfifo, os.mkdir])
def test_what_is_no_file_holds_nobody_up(rules: Path, library: Path, make: object) -> None:
    library.unlink()
    assert callable(make)
    make(library)
    done = loaded(rules)
    assert done.stdout == "native"
    assert f"{library}: this is no regular file" in done.stderr


# --- tables --------------------------------------------------------------------------------------


class Payload:
    """An object that creates a file when it is unpickled."""

    def __init__(self, mark: Path) -> None:
        self._mark = mark

    def __reduce__(self) -> tuple[object, ...]:
        return (Path.touch, (self._mark,))


def test_tables_with_a_payload_are_not_unpickled(
    cache: Path, rules: Path, library: Path, tmp_path: Path
) -> None:
    mark = tmp_path / "mark"
    tables = kept(cache, ".tables")
    good = tables.read_bytes()
    # As long as the hash that it begins with, and as a line.
    tables.write_bytes(good[:31] + b"\n" + pickle.dumps(Payload(mark)))
    done = subprocess.run(
        [Path(sys.executable).with_name("rossmarie"), "check", rules],
        capture_output=True, text=True, timeout=60,
    )  # fmt: skip
    assert not mark.exists()
    assert done.returncode == 0, done.stderr
    said = (
        f"{tables}: the content is not what was kept; it is not used, and its content is made again"
    )
    assert done.stderr == f"rossmarie: {said}\n"
    assert len(tables.read_bytes()) > len(good) / 2, "they were built again"


# --- the key -------------------------------------------------------------------------------------


def test_a_cache_from_elsewhere_is_not_used_and_no_reason_to_warn(
    cache: Path, rules: Path, library: Path, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    library.write_bytes(constructor(tmp_path, tmp_path / "mark"))
    shutil.rmtree(tmp_path / "state")
    assert stops_at(rules, 0.6)
    assert not (tmp_path / "mark").exists()
    assert caplog.text == ""


@pytest.mark.parametrize(
    ("harm", "reason"),
    [
        (lambda key: key.chmod(0o644), "other users can read or write the file"),
        *deep([
            (lambda key: os.truncate(key, 0), "the file is no key"),
            (lambda key: (key.rename(key.with_name("k")), key.symlink_to("k")), "a symbolic link"),
        ]),
        pytest.param(
            lambda key: os.chown(key, NOBODY, NOBODY), "another user", marks=needs(ROOT)
        ),
    ],
)  # fmt: skip
def test_a_key_that_others_may_know_is_made_anew(
    cache: Path, rules: Path, library: Path, tmp_path: Path, harm: object, reason: str
) -> None:
    key = tmp_path / "state" / "rossmarie" / "cache.key"
    old = key.read_bytes()
    assert callable(harm)
    harm(key)
    done = loaded(rules)
    assert done.stdout == "native"
    assert str(key) in done.stderr
    assert reason in done.stderr
    assert key.read_bytes() != old
    assert key.stat().st_mode & 0o777 == 0o600
    assert loaded(rules).stderr == ""


# --- processes -----------------------------------------------------------------------------------


def test_processes_that_find_the_same_damage_at_once(
    cache: Path, rules: Path, library: Path
) -> None:
    for path in cache.iterdir():
        os.truncate(path, 100)
    running = [
        subprocess.Popen(
            [sys.executable, "-c", LOAD, rules],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
        )
        for _ in range(2)
    ]  # fmt: skip
    assert [process.communicate(timeout=60)[0] for process in running] == ["native"] * 2
    assert loaded(rules).stderr == ""


def test_a_kill_while_it_is_compiled_leaves_nothing(
    cache: Path, rules: Path, tmp_path: Path
) -> None:
    begun = tmp_path / "begun"
    compiler = tmp_path / "slow-cc"
    compiler.write_text(f"#!/bin/sh\ntouch {begun}\nexec sleep 600\n")
    compiler.chmod(0o755)
    running = subprocess.Popen(
        [sys.executable, "-c", LOAD, rules],
        env={**os.environ, "CC": str(compiler), "TMPDIR": str(tmp_path)},
        start_new_session=True,
    )
    until = time.monotonic() + 60
    while not begun.exists():
        assert time.monotonic() < until
        time.sleep(0.02)
    os.killpg(running.pid, signal.SIGKILL)
    running.wait()
    assert all(".tables" in path.suffixes for path in cache.iterdir())
    assert loaded(rules).stdout == "native"


def test_a_kill_before_a_file_is_in_its_place_leaves_no_half_file(cache: Path, rules: Path) -> None:
    program = (
        "import os, signal\n"
        "os.rename = lambda *_, **__: os.kill(os.getpid(), signal.SIGKILL)\n"
        f"{LOAD}"
    )
    state = Path(os.environ["XDG_STATE_HOME"])
    assert loaded(rules).stdout == "native"
    shutil.rmtree(cache)
    done = subprocess.run([sys.executable, "-c", program, rules], capture_output=True)
    assert done.returncode == -signal.SIGKILL
    assert state.exists()
    done_again = loaded(rules)
    assert (done_again.stdout, done_again.stderr) == ("native", "")
