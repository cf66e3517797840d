"""The compilation of C text to the content of a shared library.

Libraries are stored in the user's cache folder under a name derived from their text, the compiler
and its options, so that the same text is compiled once. Several processes may build at the same
time.
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
    """The C compiler rejected the text. This is a defect of the program that wrote the text."""


def compiler() -> list[str]:
    """The command of the C compiler: `$CC`, else the first of cc, gcc and clang on the PATH.

    Raises `NoCompilerError` if there is no compiler.
    """
    candidates = _named() or [["cc"], ["gcc"], ["clang"]]
    for command in candidates:
        if command and (found := shutil.which(command[0])):
            return [found, *command[1:]]
    looked = " ".join(command[0] for command in candidates if command)
    raise NoCompilerError(f"no C compiler found (looked for {looked})")


def _named() -> list[list[str]]:
    """The command in `$CC`, if the variable is set."""
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
    """Compile the file `main` among `files`, together with the files in `beside`, to a shared
    library. A stored library with the same text is used again.

    Raises `NoCompilerError`, or `BuildError` with the output of the compiler, or `OSError` if the
    disk is full.
    """
    command = [*compiler(), *OPTIONS, *more_options]
    sources = (main, *beside)
    name = f"{_digest(files, sources, command)}.so"
    return kept(name, lambda: _compiled(files, sources, command), anew=rebuild)


def _digest(files: Mapping[str, str], sources: Sequence[str], command: Sequence[str]) -> str:
    """A name for the result. The size and modification time of the compiler's file stand for its
    version.
    """
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
