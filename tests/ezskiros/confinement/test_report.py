"""The report of a child process to its parent, and the limits of code in the child process."""

from __future__ import annotations

import asyncio
import ctypes
import os
import resource
import socket
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from dslkit.diagnostics import Collector
from ezskiros import session
from ezskiros.confinement import RefusedError, Report, calls, confined
from ezskiros.confinement.report import DefectError
from ezskiros.skills.load_errors import NoFile
from support.parts import SECCOMP, needs

# pytest may have threads, of which Python 3.12 warns; a command has one.
pytestmark = pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")


def finding(path: str) -> Any:
    return NoFile(path=path).at(session.NOWHERE)


def codes(report: Report) -> list[str]:
    return [each.code for each in report.diagnostics]


def test_findings_and_a_value_come_back() -> None:
    def work(collector: Collector) -> dict[str, list[int]]:
        collector.extend([finding("a"), finding("b"), finding("a")])
        return {"x": [1, 2]}

    report = confined(work)
    assert (codes(report), report.value, report.refused) == (["EZS001"] * 2, {"x": [1, 2]}, None)


def test_what_is_refused_is_reported_with_its_findings() -> None:
    def work(collector: Collector) -> None:
        collector.add(finding("a"))
        raise RefusedError("there is none")

    report = confined(work)
    assert (codes(report), report.value, report.refused) == (["EZS001"], None, "there is none")


def test_a_defect_of_ours_stays_one() -> None:
    with pytest.raises(DefectError, match="ZeroDivisionError"):
        confined(lambda _: 1 // 0)


def test_findings_stay_when_the_child_ends() -> None:
    def work(collector: Collector) -> None:
        collector.add(finding("a"))
        session.come_to(__file__)
        os._exit(0)

    report = confined(work)
    assert codes(report) == ["EZS001", "EZS240"]
    assert report.diagnostics[-1].primary.span.file.text == Path(__file__).read_text("utf-8")
    assert report.value is None


def test_a_value_of_changed_code_is_none() -> None:
    def work(_: Collector) -> int:
        session.report = print  # type: ignore[assignment]
        return 1

    report = confined(work)
    assert (codes(report), report.value) == (["EZS241"], None)


def test_a_system_without_confinement_is_reported_of(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(calls, "_LIBRARY", "libnone.so.2")
    report = confined(lambda _: 1)
    assert report.value == 1
    assert report.unconfined is not None
    if sys.platform == "linux":
        assert report.unconfined == "libnone.so.2 is missing: apt-get install libseccomp2"


# --- what the kernel refuses ----------------------------------------------------------------------


def c(name: str, *arguments: Any) -> int:
    """Call a function of the C library; raises the error that it tells."""
    library = ctypes.CDLL(None, use_errno=True)
    result: int = getattr(library, name)(*arguments)
    if result < 0:
        raise OSError(ctypes.get_errno(), "")
    return result


REFUSED: dict[str, Callable[[str], object]] = {
    "write": lambda path: open(path, "w"),  # noqa: PTH123, SIM115
    "append": lambda path: open(path, "a"),  # noqa: PTH123, SIM115
    "read and write": lambda path: os.open(path, os.O_RDWR),
    "create": lambda path: c("creat", path.encode(), 0o600),
    "a file without a name": lambda _: tempfile.TemporaryFile(),  # noqa: SIM115
    "a folder": lambda path: Path(f"{path}.new").mkdir(),
    "remove": lambda path: Path(path).unlink(),
    "rename": lambda path: Path(path).rename(f"{path}.new"),
    "a link": lambda path: Path(f"{path}.new").symlink_to(path),
    "a hard link": lambda path: os.link(path, f"{path}.new"),
    "a pipe with a name": lambda path: os.mkfifo(f"{path}.new"),
    "a mode": lambda path: Path(path).chmod(0o777),
    "times": lambda path: os.utime(path),
    "an attribute": lambda path: os.setxattr(path, "user.x", b"x"),
    "shorter": lambda path: os.truncate(path, 0),
    "a socket": lambda _: socket.socket(),
    "a local socket": lambda _: socket.socket(socket.AF_UNIX),
    "a fork": lambda _: os.fork(),
    "a program": lambda _: subprocess.run(["/bin/true"], check=False),
    "another program": lambda _: os.execv("/bin/true", ["true"]),
    "a signal to the parent": lambda _: os.kill(os.getppid(), 0),
    "a signal to a group": lambda _: os.killpg(os.getpgid(os.getppid()), 0),
    "a priority": lambda _: os.nice(1),
    "a limit": lambda _: resource.setrlimit(resource.RLIMIT_CPU, (1, 1)),
    "a trace": lambda _: c("ptrace", 0, 0, 0, 0),
    "other memory": lambda _: c("process_vm_writev", os.getppid(), 0, 0, 0, 0, 0),
    "a namespace": lambda _: c("unshare", 0x10000000),
    "rings": lambda _: c("syscall", 425, 8, 0),
    "a terminal": lambda _: c("ioctl", 0, 0x5412, b"x"),
    "another filter": lambda _: c("prctl", 22, 2, 0),
}


@needs(SECCOMP)
@pytest.mark.parametrize("deed", REFUSED.values(), ids=REFUSED)
def test_the_kernel_refuses(deed: Callable[[str], object], tmp_path: Path) -> None:
    path = tmp_path / "file"
    path.write_text("text")

    def work(_: Collector) -> str:
        try:
            deed(str(path))
        except (OSError, ValueError) as problem:
            return type(problem).__name__
        return "done"

    report = confined(work)
    assert report.unconfined is None
    assert report.value in ("PermissionError", "ValueError")
    assert [each.name for each in tmp_path.iterdir()] == ["file"]
    assert path.read_text() == "text"


def _thread() -> int:
    done: list[int] = []
    thread = threading.Thread(target=done.append, args=(1,))
    thread.start()
    thread.join()
    return len(done)


ALLOWED: dict[str, Callable[[], object]] = {
    "read": lambda: Path(__file__).read_text("utf-8"),
    "list": lambda: list(Path("/").iterdir()),
    "threads": _thread,
    "a loop of events": lambda: asyncio.run(asyncio.sleep(0)),
    "numbers": lambda: __import__("numpy").ones((99, 99)).dot(__import__("numpy").ones((99, 99))),
    "limits": lambda: resource.getrlimit(resource.RLIMIT_CPU),
}


@needs(SECCOMP)
@pytest.mark.parametrize("deed", ALLOWED.values(), ids=ALLOWED)
def test_the_kernel_allows(deed: Callable[[], object]) -> None:
    def work(_: Collector) -> bool:
        deed()
        return True

    report = confined(work)
    assert (report.value, report.unconfined) == (True, None)
