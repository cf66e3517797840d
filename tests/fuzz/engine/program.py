"""The engine in programs under sanitizers that answer calls one by one, as calls.h has it."""

from __future__ import annotations

import atexit
import os
import resource
import struct
import subprocess
import tempfile
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from rossmarie.targets.c99.engine import files
from support.c_compiler import STRICT, run, write

HERE = Path(__file__).parent
SANITIZED = ("-g", "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
MOST_CALLS = 1000
"""So many fit into a pipe, so that nobody waits for each other."""
_CALL = struct.Struct("@iiq4d")


@dataclass(frozen=True)
class Call:
    """A call of the engine."""

    kind: int
    t_ns: int = 0
    about: int = 0
    numbers: tuple[float, ...] = ()


class DefectError(Exception):
    """The program ended by itself, or gave a wrong answer."""


class Program:
    """One of the programs; it is started when it is first needed, and again after it has ended."""

    def __init__(self, source: str, *options: str) -> None:
        self._source = source
        self._options = options
        self._process: subprocess.Popen[bytes] | None = None

    def send(self, calls: Sequence[Call]) -> None:
        """Make calls, of a monitor that has just been initialized; then `read` their answers.
        Raises `DefectError` if the program has ended.
        """
        process = self._started()
        assert process.stdin is not None
        try:
            process.stdin.write(struct.pack("@I", len(calls)) + b"".join(map(_packed, calls)))
            process.stdin.flush()
        except BrokenPipeError:
            raise DefectError(self._complaint()) from None

    def read(self, size: int) -> bytes:
        """So much of the answers. Raises `DefectError` if the program has ended."""
        assert self._process is not None
        assert self._process.stdout is not None
        found = self._process.stdout.read(size)
        if len(found) != size:
            raise DefectError(self._complaint())
        return found

    def _complaint(self) -> str:
        assert self._process is not None
        assert self._process.stderr is not None
        said = self._process.stderr.read().decode("utf-8", "replace")
        self.stop()
        return f"{self._source} ended: {said or 'it took too long'}"

    def _started(self) -> subprocess.Popen[bytes]:
        if self._process is None:
            pipe = subprocess.PIPE
            program = _built(self._source, *self._options)
            self._process = subprocess.Popen(
                [program], stdin=pipe, stdout=pipe, stderr=pipe, preexec_fn=_lift_limit
            )
            atexit.register(self.stop)
        return self._process

    def stop(self) -> None:
        """End the program."""
        process, self._process = self._process, None
        if process is not None:
            process.kill()
            with suppress(BrokenPipeError), process:  # of calls that it has not read
                pass


def _lift_limit() -> None:
    """Sanitizers reserve more of the address space than the fuzzer leaves itself."""
    _, most = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (most, most))


def _packed(call: Call) -> bytes:
    numbers = [*call.numbers, 0.0, 0.0, 0.0, 0.0][:4]
    return _CALL.pack(call.kind, call.about, call.t_ns, *numbers)


@cache
def _folder() -> Path:
    """The folder of the built programs, beside the engine."""
    folder = tempfile.TemporaryDirectory()
    atexit.register(folder.cleanup)
    write(files(), Path(folder.name))
    return Path(folder.name)


@cache
def _built(source: str, *options: str) -> Path:
    folder = _folder()
    program = folder / "-".join((source, *options))
    includes = [f"-I{folder}", f"-I{HERE}"]
    given = ["-std=c99", "-D_POSIX_C_SOURCE=200809L", *STRICT, *SANITIZED, *includes, *options]
    compiler = os.environ.get("CC", "gcc")
    run([compiler, *given, HERE / source, "-o", program, "-lm"])
    return program
