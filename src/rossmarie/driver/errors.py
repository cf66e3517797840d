"""ROSS8xx: files that cannot be read or found, or say too much."""

from __future__ import annotations

from dataclasses import dataclass

from dslkit.diagnostics import Error, Template, Warning


@dataclass(frozen=True, kw_only=True)
class FileUnreadable(Error, code="ROSS801", name="file-unreadable"):
    """A rules file that the operating system does not hand out."""

    title = "cannot read `{path}`"
    label = "{reason}"
    help = "check the path, and that the file may be read"
    path: str
    reason: str


@dataclass(frozen=True, kw_only=True)
class NotUtf8(Error, code="ROSS802", name="not-utf8"):
    """A file that is not text in UTF-8."""

    title = "this file is not UTF-8 text"
    label = "byte {byte} cannot be decoded here"
    note = "rules files are plain text in UTF-8; this looks like {guess}"
    help = "save the file as UTF-8, or check that you named the right file"
    byte: str
    guess: str


@dataclass(frozen=True, kw_only=True)
class ImportNotFound(Error, code="ROSS803", name="import-not-found"):
    """An import that leads nowhere."""

    title = "no file `{path}` to import"
    label = "looked for {looked_for}"
    note = "the path of an import is relative to the file that imports"
    path: str
    looked_for: str


@dataclass(frozen=True, kw_only=True)
class TooManyWarnings(Warning, code="ROSS804", name="too-many-warnings"):
    """The point from which on the warnings of a file are no longer shown."""

    title = "there are more than {limit} warnings in this file"
    label = "none is shown from here on"
    help = "mend what the warnings above say; many of the others usually have the same cause"
    limit: int


ALL: tuple[type[Template], ...] = (FileUnreadable, NotUtf8, ImportNotFound, TooManyWarnings)
