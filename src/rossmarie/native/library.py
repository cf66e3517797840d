"""The only place that speaks to C: a loaded library, with types.

Takes the path of a library built from `host.c`, or from `fastcall.c`, which includes it.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cffi

# What cffi gives out has no static types; it does not leave this file but as `Pointer`.
Pointer = Any


class Library:
    """A library of one machine, and the memory that is handed to it."""

    def __init__(self, path: Path, declarations: str) -> None:
        """Raises `OSError` if the file is no library."""
        self._ffi = cffi.FFI()
        self._ffi.cdef(declarations)
        self._functions: Any = self._ffi.dlopen(str(path))
        self._path = path
        self.null: Pointer = self._ffi.NULL

    def function(self, name: str) -> Callable[..., Any]:
        """A function by name; raises `OSError` if the library lacks it."""
        try:
            found: Callable[..., Any] = getattr(self._functions, name)
        except AttributeError as error:
            raise OSError(str(error)) from error
        return found

    def owned(self, pointer: Pointer, release: Callable[..., Any]) -> Pointer:
        """A pointer that is released when Python forgets it."""
        return self._ffi.gc(pointer, release)

    def pointer(self, kind: str, buffer: Any) -> Pointer:
        """The memory of an array; it must live as long as the pointer is used."""
        return self._ffi.from_buffer(kind, buffer)

    def new(self, kind: str, initial: object) -> Pointer:
        """New memory, filled."""
        return self._ffi.new(kind, initial)

    def is_null(self, pointer: Pointer) -> bool:
        """Whether a pointer leads nowhere."""
        return bool(pointer == self._ffi.NULL)

    def text_at(self, pointer: Pointer) -> str | None:
        """A copy of a string; None for a pointer that leads nowhere."""
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
        """The function of `fastcall.c` for a channel; None if the library was built without.

        It keeps `owner` alive, on which the host rests.
        """
        kinds = [ctypes.c_void_p, ctypes.c_int, ctypes.c_int, ctypes.py_object]
        return self._python_function(
            "host_python_function", kinds, self._address(host), channel, fields, owner
        )

    def rows_function(
        self, host: Pointer, table: Pointer, owner: object
    ) -> Callable[..., bytes] | None:
        """The function of `fastcall.c` for a table; None if the library was built without.

        It keeps `owner` alive, on which host and table rest.
        """
        kinds = [ctypes.c_void_p, ctypes.c_void_p, ctypes.py_object]
        addresses = map(self._address, (host, table))
        return self._python_function("host_python_rows", kinds, *addresses, owner)

    def _python_function(
        self, name: str, kinds: list[Any], *arguments: object
    ) -> Callable[..., Any] | None:
        try:
            make = getattr(ctypes.PyDLL(str(self._path)), name)
        except AttributeError:
            return None
        make.argtypes = kinds
        make.restype = ctypes.py_object
        function: Callable[..., Any] = make(*arguments)
        return function

    def _address(self, pointer: Pointer) -> int:
        return int(self._ffi.cast("intptr_t", pointer))
