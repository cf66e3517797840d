"""C text in, the content of a shared library out.

Libraries are kept in the user's cache folder under a name that tells their text, the compiler and
its options, so that the same text is compiled once; several processes may build at once.
"""

from __future__ import annotations

import hashlib
import os
import shlex
import shutil
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

from dslkit.writing import write_texts
from rossmarie.cache import kept

OPTIONS = ("-std=c99", "-O2", "-ffp-contract=off", "-fPIC", "-shared")


class NoCompilerError(Exception):
    """No C compiler was found."""


class BuildError(Exception):
    """The C compiler did not accept the text: a fault of the program that wrote it."""


def compiler() -> list[str]:
    """The command of the C compiler: `$CC`, else the first of cc, gcc, clang on the path.

    Raises `NoCompilerError` if there is none.
    """
    candidates = _named() or [["cc"], ["gcc"], ["clang"]]
    for command in candidates:
        if command and (found := shutil.which(command[0])):
            return [found, *command[1:]]
    looked = " ".join(command[0] for command in candidates if command)
    raise NoCompilerError(f"no C compiler found (looked for {looked})")


def _named() -> list[list[str]]:
    """The command in `$CC`, if there is one."""
    named = os.environ.get("CC")
    try:
        return [shlex.split(named)] if named else []
    except ValueError as error:
        raise NoCompilerError(f"no C compiler found (CC is {named!r}: {error})") from error


def build(
    files: Mapping[str, str],
    main: str,
    *more_options: str,
    beside: Sequence[str] = (),
    rebuild: bool = False,
) -> bytes:
    """Compile the file `main` among `files`, and those `beside` it, to a shared library, unless
    that was done before.

    Raises `NoCompilerError`, or `BuildError` with what the compiler said, or `OSError` if there is
    no room to compile.
    """
    command = [*compiler(), *OPTIONS, *more_options]
    sources = (main, *beside)
    name = f"{_digest(files, sources, command)}.so"
    return kept(name, lambda: _compiled(files, sources, command), anew=rebuild)


def _digest(files: Mapping[str, str], sources: Sequence[str], command: Sequence[str]) -> str:
    """A name for the result: the version of the compiler counts by its file's size and time."""
    found = Path(command[0]).resolve().stat()
    digest = hashlib.sha256()
    for part in (*sources, *command, str(found.st_size), str(found.st_mtime_ns)):
        digest.update(os.fsencode(part) + b"\0")
    for name in sorted(files):
        digest.update(name.encode() + b"\0" + files[name].encode() + b"\0")
    return digest.hexdigest()[:32]


def _compiled(files: Mapping[str, str], sources: Sequence[str], command: Sequence[str]) -> bytes:
    with tempfile.TemporaryDirectory(prefix="rossmarie_") as folder:
        write_texts(Path(folder), files)
        built = Path(folder) / "built.so"
        paths = [str(Path(folder) / source) for source in sources]
        call = [*command, "-o", str(built), *paths, "-lm"]
        result = subprocess.run(call, capture_output=True, check=False)
        if result.returncode != 0:
            said = result.stderr.decode("utf-8", "replace").strip()
            raise BuildError(said or f"{call[0]} failed")
        return built.read_bytes()
