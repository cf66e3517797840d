"""CBMC made ready: where the system has none, a Debian 13 of its own in the cache, by debootstrap.

Needs root, as `chroot` does. Nothing half made is ever taken: the folder is made aside, by one run
at a time, and gets its name when all is in it.
"""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from rossmarie.cache import belongs_to_us
from rossmarie.verification.prover import Prover, find_prover, own_root

_DEBOOTSTRAP = (
    "debootstrap", "--variant=minbase", "--force-check-gpg",
    "--include=cbmc,cadical,z3,gcc,libc6-dev", "trixie",
)  # fmt: skip
_MOST_SECONDS = 900.0
_TO_END_S = 10.0
_OTHERWISE = (
    "install the packages cbmc, cadical and z3 of Debian 13, or use the Docker image debian:trixie"
)
_PRIVATE = (
    f"make it root's alone (chown, chmod go-w), name another by XDG_CACHE_HOME, or {_OTHERWISE}"
)


class NoProverError(Exception):
    """There is no prover, and none can be made; the message is the reason."""

    def __init__(self, reason: str, advice: str = _OTHERWISE) -> None:
        self.advice = advice
        super().__init__(reason)


def provide_prover(tell: Callable[[str], None]) -> Prover:
    """The prover, which is made if there is none; `tell` hears what takes its time.

    Raises `NoProverError`.
    """
    found = find_prover()
    if found is not None:
        return found
    _check_means()
    try:
        root = own_root()
        root.parent.mkdir(mode=0o755, parents=True, exist_ok=True)
        if not belongs_to_us(root.parent):
            raise NoProverError(f"other users can change what is in {root.parent}", _PRIVATE)
        with _alone(root, tell) as lock:
            return find_prover() or _made(root, lock, tell)
    except OSError as error:
        raise NoProverError(str(error)) from error


def _check_means() -> None:
    if not hasattr(os, "geteuid") or os.geteuid() != 0:
        advice = f"{_OTHERWISE}, or run `rossmarie verify` as root where debootstrap is installed"
        raise NoProverError("only root may run another Debian by chroot", advice)
    if shutil.which(_DEBOOTSTRAP[0]) is None:
        advice = f"`apt-get install debootstrap`, or {_OTHERWISE}"
        raise NoProverError("there is no debootstrap, which would set it up", advice)


@contextmanager
def _alone(root: Path, tell: Callable[[str], None]) -> Iterator[int]:
    """No other run is here. The file that says so is open; whoever inherits it is here as well."""
    import fcntl  # not everywhere; root is

    with root.with_name(f"{root.name}.lock").open("w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            tell("another run sets CBMC up; waiting for it")
            fcntl.flock(lock, fcntl.LOCK_EX)
        yield lock.fileno()


def _made(root: Path, lock: int, tell: Callable[[str], None]) -> Prover:
    """A new one, in place of one that does not run, and of what broken runs have left."""
    for left in root.parent.glob(f"{root.name}-*"):
        _remove(left)
    tell(f"setting up CBMC 6, once: debootstrap makes a Debian 13 in {root}")
    aside = Path(tempfile.mkdtemp(prefix=f"{root.name}-", dir=root.parent))
    try:
        aside.chmod(0o755)
        _bootstrap(aside, lock)
        if not Prover(aside).is_complete():
            raise NoProverError("what debootstrap made does not run")
        _remove(root)
        aside.rename(root)
    finally:
        _remove(aside)
    return Prover(root)


def _bootstrap(folder: Path, lock: int) -> None:
    with tempfile.TemporaryFile(mode="w+", encoding="utf-8", errors="replace") as said:
        process = subprocess.Popen(
            [*_DEBOOTSTRAP, str(folder)],
            stdin=subprocess.DEVNULL,
            stdout=said,
            stderr=subprocess.STDOUT,
            start_new_session=True,
            pass_fds=(lock,),
        )
        try:
            code = process.wait(_MOST_SECONDS)
        except subprocess.TimeoutExpired:
            raise NoProverError(f"debootstrap did not end within {_MOST_SECONDS:g} s") from None
        finally:
            _end(process)
        if code != 0:
            said.seek(0)
            raise NoProverError(f"debootstrap failed: {_last_error(said.read())}", _AFTER_FAILURE)


_AFTER_FAILURE = f"see that mirrors of Debian can be reached, and try again; or {_OTHERWISE}"


def _last_error(text: str) -> str:
    """What it says of its failure: the last line that is no mere information."""
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    worse = [line for line in lines if not line.startswith("I: ")]
    return (worse or lines or ["it said nothing"])[-1]


def _end(process: subprocess.Popen[bytes]) -> None:
    """End it with all that it has started; gently, as it has mounts to undo."""
    for number in (signal.SIGTERM, signal.SIGKILL):
        if process.poll() is None:
            os.killpg(process.pid, number)
            try:
                process.wait(_TO_END_S)
            except subprocess.TimeoutExpired:
                continue


def _remove(folder: Path) -> None:
    """Remove a folder, or a link to one, if it is there; nothing that is mounted in it."""
    if folder.is_symlink():
        folder.unlink()
        return
    for place in _mounted_below(folder):
        subprocess.run(["umount", "--lazy", place], check=False, capture_output=True)
    if _mounted_below(folder):
        raise OSError(f"{folder} cannot be removed: something is mounted in it")
    if folder.exists():
        shutil.rmtree(folder)


def _mounted_below(folder: Path) -> list[str]:
    """The innermost first."""
    mounts = Path("/proc/self/mounts")
    lines = mounts.read_bytes().splitlines() if mounts.exists() else []
    places = [os.fsdecode(_ESCAPED.sub(_byte, line.split()[1])) for line in lines]
    inside = f"{folder.resolve()}{os.sep}"
    return sorted((place for place in places if place.startswith(inside)), reverse=True)


_ESCAPED = re.compile(rb"\\([0-7]{3})")


def _byte(escaped: re.Match[bytes]) -> bytes:
    """A character as `proc_pid_mounts(5)` writes it, such as a space."""
    return bytes([int(escaped[1], 8)])
