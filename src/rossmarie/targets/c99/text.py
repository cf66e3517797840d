"""Layout of C text: tables, enumerations, indentation."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Mapping, Sequence
from itertools import accumulate

from rossmarie.targets import comments


def indented(lines: Iterable[str], levels: int = 1) -> str:
    """Indented lines."""
    return "\n".join("    " * levels + line for line in lines)


def block(lines: Iterable[str], levels: int = 1) -> str:
    """Indented lines, each with a line end; empty if there are none."""
    return "".join("    " * levels + line + "\n" for line in lines)


def table(kind: str, name: str, entries: Sequence[object]) -> str:
    """A constant table. C has no empty tables, so an empty one gets an unused entry."""
    listed = ", ".join(map(str, entries)) or "0"
    opening = f"static const {kind} {name}[{max(1, len(entries))}] = {{"
    if len(opening) + len(listed) + 2 <= 100:
        return f"{opening}{listed}}};"
    wrapped = textwrap.fill(listed, 96, initial_indent="    ", subsequent_indent="    ")
    return f"{opening}\n{wrapped}}};"


def remarked_table(kind: str, name: str, rows: Sequence[tuple[str, str]]) -> str:
    """A constant table with a remark on every entry."""
    if not rows:
        return table(kind, name, ())
    lines = indented(f"{entry}, /* {comments.in_c(remark)} */" for entry, remark in rows)
    return f"static const {kind} {name}[{len(rows)}] = {{\n{lines}\n}};"


def sizes(rows: Mapping[str, int]) -> str:
    """Names for numbers that select parts of the engine."""
    return "".join(f"#define {name} {size}\n" for name, size in rows.items())


def enumeration(rows: Sequence[tuple[str, str]]) -> str:
    """Names for 0, 1, 2 ... with a remark on each; nothing if there are none."""
    listed = [f"{name}, /* {comments.in_c(remark)} */" for name, remark in rows]
    return f"enum {{\n{indented(listed)}\n}};\n" if listed else ""


def boolean(value: bool) -> str:
    """True or false as C's `bool`."""
    return "true" if value else "false"


def starts_of(counts: Iterable[int]) -> list[int]:
    """The first index of each list in the concatenation of lists with these lengths, and the end of
    the last list.
    """
    return list(accumulate(counts, initial=0))


def lists(starts: str, entries: str, rows: Sequence[tuple[str, Sequence[object]]]) -> str:
    """Lists of indexes of different lengths, each with its name. The entries of list i have the
    indexes from starts[i] up to, not including, starts[i + 1].
    """
    places = starts_of([len(row) for _, row in rows])
    filled = [_listed(name, row) for name, row in rows if row]
    if not filled:
        return f"{table('index_t', starts, places)}\n{table('index_t', entries, ())}"
    opening = f"static const index_t {entries}[{places[-1]}] = {{"
    return "\n".join([table("index_t", starts, places), opening, *filled, "};"])


def _listed(name: str, row: Sequence[object]) -> str:
    text = f"/* {comments.in_c(name)} */ {', '.join(map(str, row))},"
    return textwrap.fill(
        text, 96, initial_indent="    ", subsequent_indent="        ",
        break_long_words=False, break_on_hyphens=False,
    )  # fmt: skip


def call(head: str, arguments: Sequence[str]) -> str:
    """`head(arguments)`, on several lines if necessary."""
    lines = [f"{head}("]
    for place, argument in enumerate(arguments):
        ending = ")" if place + 1 == len(arguments) else ", "
        if len(lines[-1]) + len(argument) + len(ending) > 100:
            lines.append(" " * 8)
        lines[-1] += argument + ending
    return "\n".join(line.rstrip() for line in lines)
