"""Stored files: compiled monitors and tables of the parser, for the next run.

The content of a stored file is executed, or determines the meaning of a rule. Therefore `kept`
returns only content that this user's own processes have stored, byte for byte:

- The folder and the file belong to this user, and no other user can write to them. Both are checked
  through open descriptors, so that no other user can exchange them after the check.
- The file begins with a hash (HMAC-SHA256) of its name and its content under a random key of this
  user. So a file that was changed, cut off, renamed, or copied from elsewhere does not fit.
- The checked bytes are the bytes that `kept` returns. The file is not read again.

The key is outside the cache folder, so that an archive of a cache cannot contain a key of its own.
A program that can read the files of this user can read the key: this module does not protect
against programs of the same user, or against root. Such programs could also change this program.

Content that fails a check is created again, and a warning gives the reason. If nothing can be
stored, the content is created each time.
"""

from __future__ import annotations

import errno
import hashlib
import hmac
import logging
import os
import stat
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

_LOG = logging.getLogger(__name__)
_KEY = "cache.key"
_SIZE = hashlib.sha256().digest_size
"""The size of the key, and of a hash under the key, in bytes."""

_OTHERS_WRITE = stat.S_IWGRP | stat.S_IWOTH


class _DistrustError(OSError):
    """A file or folder that another user may have written. The message names it, and the reason."""


def cache_folder() -> Path:
    """`$XDG_CACHE_HOME/rossmarie`, or `~/.cache/rossmarie`; the folder need not exist.

    Raises `OSError` if there is no home directory.
    """
    return _folder("XDG_CACHE_HOME", ".cache")


def kept(name: str, make: Callable[[], bytes], *, anew: bool = False) -> bytes:
    """The content stored under this name. If there is no trusted content, or if `anew` is set,
    `make` creates the content, which is then stored.

    Raises the errors of `make`.
    """
    content = None if anew else _read(name)
    if content is None:
        content = make()
        _write(name, content)
    return content


def _read(name: str) -> bytes | None:
    try:
        key = _key()
        with _Folder(cache_folder()) as folder:
            path = _named(name, key)
            tagged = folder.read(path)
            if not hmac.compare_digest(tagged[:_SIZE], _tag(key, name, tagged[_SIZE:])):
                raise _DistrustError(f"{folder.path / path}: the content is not what was kept")
            return tagged[_SIZE:]
    except _DistrustError as distrust:
        _tell(distrust)
    except OSError:
        pass  # nothing was stored, or nothing can be stored
    return None


def _write(name: str, content: bytes) -> None:
    with suppress(OSError):  # `_read` has reported the distrusted file
        key = _key()
        with _Folder(cache_folder()) as folder:
            folder.write(_named(name, key), _tag(key, name, content) + content)


def _tell(distrust: _DistrustError) -> None:
    _LOG.warning("rossmarie: %s; it is not used, and its content is made again", distrust)


def _named(name: str, key: bytes) -> str:
    """The name of the file. A file that was stored under another key causes no warning."""
    return f"{name}.{hashlib.sha256(key).hexdigest()[:8]}"


def _tag(key: bytes, name: str, content: bytes) -> bytes:
    return hmac.digest(key, name.encode() + b"\0" + content, "sha256")


def _key() -> bytes:
    """The key of this user. A new key is created if there is no key that only this user can
    read.
    """
    with _Folder(_folder("XDG_STATE_HOME", ".local/state")) as folder:
        with suppress(FileNotFoundError):
            try:
                return _whole(folder)
            except _DistrustError as distrust:
                _tell(distrust)
        folder.write(_KEY, os.urandom(_SIZE))
        return _whole(folder)  # if two processes create a key, both use the later key


def _whole(folder: _Folder) -> bytes:
    key = folder.read(_KEY)
    if len(key) != _SIZE:
        raise _DistrustError(f"{folder.path / _KEY}: the file is no key")
    return key


def _folder(variable: str, usual: str) -> Path:
    """The folder of this program below the folder that a variable names, or below the default."""
    named = os.environ.get(variable)
    try:
        base = Path(named) if named else Path.home() / usual
    except RuntimeError as error:
        raise OSError(f"no folder for what is kept: {error}") from error
    return base / "rossmarie"


def _is_own(found: os.stat_result) -> bool:
    return hasattr(os, "geteuid") and found.st_uid == os.geteuid()


class _Folder:
    """An open folder of this user to which no other user can write. A missing folder is created.

    Its methods raise `OSError`, and `_DistrustError` for files that another user may have written.
    """

    def __init__(self, path: Path) -> None:
        if not hasattr(os, "geteuid"):
            raise OSError(f"{path}: this system does not tell whose a file is")
        if path.is_symlink():
            raise _DistrustError(f"{path}: the folder is a symbolic link")
        path.mkdir(mode=0o700, parents=True, exist_ok=True)
        self.path = path
        self._opened = os.open(path, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC)
        try:
            self._shut_others_out()
        except OSError:
            os.close(self._opened)
            raise

    def _shut_others_out(self) -> None:
        found = os.fstat(self._opened)
        if not _is_own(found):
            raise _DistrustError(f"{self.path}: the folder belongs to another user")
        if found.st_mode & _OTHERS_WRITE:
            os.fchmod(self._opened, stat.S_IMODE(found.st_mode) & ~_OTHERS_WRITE)
        if os.fstat(self._opened).st_mode & _OTHERS_WRITE:  # some file systems do not support this
            raise _DistrustError(f"{self.path}: other users can write to the folder")

    def __enter__(self) -> _Folder:
        return self

    def __exit__(self, *_: object) -> None:
        os.close(self._opened)

    def read(self, name: str) -> bytes:
        """The content of a file that no other user can read or write."""
        # Do not block: a pipe in place of the file must not stop the program.
        how = os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC
        try:
            opened = os.open(name, how, dir_fd=self._opened)
        except FileNotFoundError:
            raise
        except OSError as error:
            is_link = error.errno == errno.ELOOP
            reason = "a symbolic link" if is_link else f"not to be read ({error.strerror})"
            raise _DistrustError(f"{self.path / name}: the file is {reason}") from error
        try:
            if fault := _fault(os.fstat(opened)):
                raise _DistrustError(f"{self.path / name}: {fault}")
            with os.fdopen(opened, "rb", closefd=False) as file:
                return file.read()
        finally:
            os.close(opened)

    def write(self, name: str, content: bytes) -> None:
        """Write a temporary file, sync it to disk, and move it into place: after a crash or power
        failure, the file is complete or missing.
        """
        aside = f".{name}.{os.urandom(8).hex()}"
        how = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC
        opened = os.open(aside, how, 0o600, dir_fd=self._opened)
        try:
            with os.fdopen(opened, "wb") as file:
                file.write(content)
                file.flush()
                os.fsync(opened)
            os.rename(aside, name, src_dir_fd=self._opened, dst_dir_fd=self._opened)
        except BaseException:  # an interrupt as well: an incomplete file must not stay
            os.unlink(aside, dir_fd=self._opened)
            raise
        os.fsync(self._opened)


def _fault(found: os.stat_result) -> str | None:
    """The reason why a file is not trusted; None if it is trusted."""
    if not stat.S_ISREG(found.st_mode):
        return "this is no regular file"
    if not _is_own(found):
        return "the file belongs to another user"
    if found.st_mode & (stat.S_IRWXG | stat.S_IRWXO):
        return "other users can read or write the file"
    return None
