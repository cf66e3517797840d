"""The application of a fix to a text."""

from __future__ import annotations

from collections.abc import Iterable

from dslkit.diagnostics.model import Edit


def apply_edits(text: str, edits: Iterable[Edit]) -> str:
    """`text` with the edits, which all lie in its file, applied together.

    Raises `ValueError` if two of them overlap.
    """
    pieces = []
    done = 0
    for edit in sorted(edits, key=lambda edit: (edit.span.start, edit.span.end)):
        if edit.span.start < done:
            raise ValueError(f"edits overlap at offset {edit.span.start}")
        pieces += [text[done : edit.span.start], edit.replacement]
        done = edit.span.end
    return "".join([*pieces, text[done:]])
