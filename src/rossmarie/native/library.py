"""The only module that calls C: a loaded library, with types.

The input is the content of a library built from `host.c`, or from `fastcall.c`, which includes it.
"""

from __future__ import annotations

import ctypes
import os
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

import cffi

# Objects of cffi have no static types; they leave this file only as `Pointer`.
Pointer = Any


class NativeLibrary:
    """A library of one machine, and the memory that is passed to it."""

    def __init__(self, content: bytes, declarations: str) -> None:
        """Raises `OSError` if the content is not a library."""
        self._python = _loaded(content)
        self._ffi = cffi.FFI()
        self._ffi.cdef(declarations)
        handle: Any = self._ffi.cast("void *", self._python._handle)  # noqa: SLF001 - documented
        self._functions: Any = self._ffi.dlopen(handle)
        self.null: Pointer = self._ffi.NULL

    def function(self, name: str) -> Callable[..., Any]:
        """A function by name. Raises `OSError` if the library does not have it."""
        try:
            found: Callable[..., Any] = getattr(self._functions, name)
        except AttributeError as error:
            raise OSError(str(error)) from error
        return found

    def owned(self, pointer: Pointer, release: Callable[..., Any]) -> Pointer:
        """A pointer whose memory is released when Python no longer uses the pointer."""
        return self._ffi.gc(pointer, release)

    def pointer(self, kind: str, buffer: Any) -> Pointer:
        """The memory of an array, which must live while the pointer is used; for None, a null
        pointer.
        """
        return self.null if buffer is None else self._ffi.from_buffer(kind, buffer)

    def new(self, kind: str, initial: object) -> Pointer:
        """New memory, filled."""
        return self._ffi.new(kind, initial)

    def is_null(self, pointer: Pointer) -> bool:
        """Say whether a pointer is null."""
        return bool(pointer == self._ffi.NULL)

    def text_at(self, pointer: Pointer) -> str | None:
        """A copy of a string; None for a null pointer."""
        if self.is_null(pointer):
            return None
        text = self._ffi.string(pointer)
        return text.decode("utf-8") if isinstance(text, bytes) else text

    def bytes_at(self, pointer: Pointer, size: int) -> bytes:
        """A copy of some memory."""
        return bytes(self._ffi.buffer(pointer, size)) if size else b""

    def update_function(
        self, host: Pointer, channel: int, fields: int, owner: object
    ) -> Callable[..., int] | None:
        """The function of `fastcall.c` for a channel; None if the library was built without
        `fastcall.c`.

        The function keeps `owner` alive, on which the host depends.
        """
        kinds = [ctypes.c_void_p, ctypes.c_int, ctypes.c_int, ctypes.py_object]
        return self._python_function(
            "host_python_function", kinds, self._address(host), channel, fields, owner
        )

    def rows_function(
        self, host: Pointer, table: Pointer, owner: object
    ) -> Callable[..., bytes] | None:
        """The function of `fastcall.c` for a table; None if the library was built without
        `fastcall.c`.

        The function keeps `owner` alive, on which host and table depend.
        """
        kinds = [ctypes.c_void_p, ctypes.c_void_p, ctypes.py_object]
        addresses = map(self._address, (host, table))
        return self._python_function("host_python_rows", kinds, *addresses, owner)

    def step_function(
        self, host: Pointer, wiring: Pointer, owner: object
    ) -> Callable[..., bytes | None] | None:
        """The function of `fastguard.c` for a guard; None if the library was built without
        `fastguard.c`.

        The function keeps `owner` alive, on which guard and wiring depend.
        """
        kinds = [ctypes.c_void_p, ctypes.c_void_p, ctypes.py_object]
        addresses = map(self._address, (host, wiring))
        return self._python_function("guard_python_step", kinds, *addresses, owner)

    def watch_function(
        self, host: Pointer, shape: Pointer, owner: object
    ) -> Callable[..., int | None] | None:
        """The function of `fastguard.c` for a channel; None if the library was built without
        `fastguard.c`.

        The function keeps `owner` alive, on which guard and shape depend.
        """
        kinds = [ctypes.c_void_p, ctypes.c_void_p, ctypes.py_object]
        addresses = map(self._address, (host, shape))
        return self._python_function("guard_python_watch", kinds, *addresses, owner)

    def _python_function(
        self, name: str, kinds: list[Any], *arguments: object
    ) -> Callable[..., Any] | None:
        try:
            make = getattr(self._python, name)
        except AttributeError:
            return None
        make.argtypes = kinds
        make.restype = ctypes.py_object
        function: Callable[..., Any] = make(*arguments)
        return function

    def _address(self, pointer: Pointer) -> int:
        return int(self._ffi.cast("intptr_t", pointer))


@cache
def _loaded(content: bytes) -> ctypes.PyDLL:
    """The library with this content. The library is loaded once and stays loaded, because functions
    of `fastcall.c` may outlive all its users.
    """
    with _file_of(content) as path:
        return ctypes.PyDLL(str(path))


@contextmanager
def _file_of(content: bytes) -> Iterator[Path]:
    """A read-only file with this content, for the system's loader, which accepts only file names.
    Each file has a unique name, because the loader identifies libraries by name.
    """
    with tempfile.TemporaryDirectory(prefix="rossmarie_") as folder:
        path = Path(folder) / "monitor.so"
        try:
            memory = _in_memory(content)
        except OSError:  # the folder protects the file: only this user has access
            path.write_bytes(content)
            yield path
            return
        try:
            path.symlink_to(f"/proc/self/fd/{memory}")
            yield path
        finally:
            os.close(memory)


def _in_memory(content: bytes) -> int:
    """A sealed file in memory. It can be loaded even if the system forbids loading programs from
    the folder of temporary files.
    """
    if sys.platform != "linux" or not Path("/proc/self/fd").exists():
        raise OSError("this system has no named files in memory")
    import fcntl

    memory = os.memfd_create("rossmarie", os.MFD_CLOEXEC | os.MFD_ALLOW_SEALING)
    try:
        with os.fdopen(memory, "wb", closefd=False) as file:
            file.write(content)
        seals = fcntl.F_SEAL_WRITE | fcntl.F_SEAL_GROW | fcntl.F_SEAL_SHRINK | fcntl.F_SEAL_SEAL
        fcntl.fcntl(memory, fcntl.F_ADD_SEALS, seals)
    except OSError:
        os.close(memory)
        raise
    return memory
