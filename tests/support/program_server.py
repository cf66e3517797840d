"""A process that has the programs of this project imported, and whose children become one of them.

`support.command_line` starts it and asks it by a socket, its standard input. It has one thread, and
nothing of pytest or of `support`: a child knows no more than importing a program leaves behind.

A request is one byte with four open files: what is to be run (JSON), and its standard input,
output and error. The answers are the number of the child and, when it has ended, its exit code,
negative if a signal ended it.
"""

from __future__ import annotations

import builtins
import contextlib
import gc
import json
import multiprocessing.process
import os
import pkgutil
import resource
import socket
import struct
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

NUMBER = struct.Struct("q")
_PACKAGES = {
    "crosscheck": ("crosscheck", "rossmarie"),
    "ezskiros": ("ezskiros",),
    "ezskiros migrate": ("ezskiros.migrate",),
    "rossmarie": ("rossmarie",),
}
"""The packages whose modules a command imports completely. The heron packages read the environment.
"""
_MODULES = {
    "crosscheck": ("typer._adapters",),
    "ezskiros": ("typer._adapters",),
    "heron": ("heron.cli.main", "typer._adapters"),
    "rossmarie": ("_cffi_backend", "cffi.cparser", "typer._adapters"),
}
"""The other modules that it imports."""
_LATER = ("ezskiros.migrate",)
_imported: set[str] = set()


def _import_for(arguments: list[str]) -> None:
    """Import what a command needs, if none like it has been run yet."""
    program = Path(arguments[0]).name
    for command in {program, " ".join([program, *arguments[1:2]])} - _imported:
        _imported.add(command)
        names = [*_MODULES.get(command, ())]
        for package in _PACKAGES.get(command, ()):
            names += _modules_of(package)
        for name in names:
            with contextlib.suppress(ModuleNotFoundError):  # the program says it better
                import_module(name)
        gc.collect()
        gc.freeze()  # what all children share is not looked at, and so not copied


def _modules_of(package: str) -> Iterator[str]:
    yield package
    for found in pkgutil.iter_modules(import_module(package).__path__, f"{package}."):
        if found.ispkg and found.name not in _LATER:
            yield from _modules_of(found.name)
        elif found.name not in _LATER:
            yield found.name


def _answer(asking: socket.socket) -> None:
    """Answer requests until nobody asks any more; returns in children only."""
    while True:
        asked, files, _, _ = socket.recv_fds(asking, 1, 4)
        if not asked:
            os._exit(0)
        with os.fdopen(files.pop(0), "rb") as file:
            request = json.load(file)
        _import_for(request["arguments"])
        child = os.fork()
        with contextlib.suppress(OSError):  # done by who comes first of parent and child
            os.setpgid(child, child)
        if child == 0:
            asking.close()
            _get_ready(request, files)
            return
        for each in files:
            os.close(each)
        asking.sendall(NUMBER.pack(child))
        _, status = os.waitpid(child, 0)
        asking.sendall(NUMBER.pack(os.waitstatus_to_exitcode(status)))


def _get_ready(request: dict[str, Any], files: list[int]) -> None:
    """Make this child such as a new process of Python is before its program runs."""
    for number, given in enumerate(files):
        os.dup2(given, number)
        os.close(given)
    os.environ.clear()
    os.environ.update(request["environment"])
    os.chdir(request["folder"])
    if request["memory"] is not None:
        resource.setrlimit(resource.RLIMIT_AS, (request["memory"], request["memory"]))
    vars(multiprocessing.process)["ORIGINAL_DIR"] = request["folder"]
    sys.argv = request["arguments"]
    sys.path.insert(0, str(Path(sys.argv[0]).absolute().parent))


def _run() -> None:
    """Run the file that the arguments name as Python does it, in a `__main__` of its own."""
    path = sys.argv[0]
    main = ModuleType("__main__")
    main.__file__ = path
    vars(main)["__builtins__"] = builtins
    sys.modules["__main__"] = main
    exec(compile(Path(path).read_bytes(), path, "exec", dont_inherit=True), vars(main))


if __name__ == "__main__":
    del sys.path[0]  # the folder of this file
    _answer(socket.socket(fileno=os.dup(0)))
    _run()
