"""Formats a module without syntax errors: its canonical text.

- Four spaces for each level; one statement on a line, broken if it exceeds 100 columns (`layout`).
- Items, conditions and effects end in `;`, except those that end in a brace of their own: entities,
  systems, tests, and actions with a body.
- A condition is `name : expression;`, a rule `rule name: if condition then { action; };`.
- Empty lines separate entities, systems, rules and actions with a body, and items of different
  kinds. Elsewhere, up to one empty line of the author stays.
- A comment stays beside the text that it precedes or follows. A documentation string stays before
  the text that it documents. A documentation string that documents nothing and cannot stay in its
  place (before a `;` that moves) becomes a comment.

Formatting twice changes nothing; the formatted text has the same tree, up to spans.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from dslkit.source import Span
from rossmarie.syntax import ast
from rossmarie.syntax.layout import Atom, TrailingComment, indented, lay_out
from rossmarie.syntax.scan import ScannedFile, Token, documentation_text, scan
from rossmarie.syntax.style import Style, collect_style

_Statement = ast.Item | ast.Condition | ast.Shape | ast.SystemMember | ast.Effect | ast.Statement
_EMPTY_LINE = re.compile(r"\n\s*\n")


@dataclass
class _Entry:
    """A statement, or a comment between statements, with its range of the text.

    Statements of the same `group` may be on adjacent lines; comments have no group.
    """

    lines: list[str]
    start: int
    end: int
    group: str | None
    is_block: bool = False


def format_module(module: ast.Module) -> str:
    """The canonical text of a module that was parsed without findings. Unparsed text would be
    lost.
    """
    source = scan(module.file)
    formatter = _Formatter(source, collect_style(source, module.items))
    lines = formatter.block(module.items, len(module.file.text), 0)
    return "\n".join(lines) + "\n" if lines else ""


class _Formatter:
    """Processes the text once, from start to end."""

    def __init__(self, source: ScannedFile, style: Style) -> None:
        self._source = source
        self._style = style
        self._text = source.file.text
        self._trivia = source.trivia
        self._next_trivium = 0

    def block(
        self,
        nodes: Sequence[_Statement],
        end: int,
        indent: int,
    ) -> list[str]:
        """The lines of all statements, and of all remaining comments up to `end`."""
        entries: list[_Entry] = []
        for node in nodes:
            entries += self._comments(node.span.start, indent)
            entry = self._statement(node, indent)
            entry.end = self._trailing(entry)
            entries.append(entry)
        entries += self._comments(end, indent)
        return list(self._join(entries))

    def _join(self, entries: list[_Entry]) -> Iterator[str]:
        """All lines, with empty lines where the author has put them or the style requires them."""
        for index, entry in enumerate(entries):
            if index and (self._is_apart(entries, index) or self._has_gap(entries, index)):
                yield ""
            yield from entry.lines

    def _has_gap(self, entries: list[_Entry], index: int) -> bool:
        between = self._text[entries[index - 1].end : entries[index].start]
        return _EMPTY_LINE.search(between) is not None

    def _is_apart(self, entries: list[_Entry], index: int) -> bool:
        """Say whether an empty line is needed between a statement and the comments of the next
        statement. It is not needed if the author has put one after these comments.
        """
        before = entries[index - 1]
        if before.group is None:
            return False
        following = index
        while following < len(entries) and entries[following].group is None:
            following += 1
        if following == len(entries):
            return False
        after = entries[following]
        if not (before.is_block or after.is_block or before.group != after.group):
            return False
        return not any(self._has_gap(entries, place) for place in range(index, following + 1))

    # --- comments --------------------------------------------------------------------------------

    def _take(self, end: int) -> Iterator[Token]:
        """The remaining comments before an offset."""
        while self._next_trivium < len(self._trivia):
            trivium = self._trivia[self._next_trivium]
            if trivium.start >= end:
                return
            self._next_trivium += 1
            yield trivium

    def _comments(self, end: int, indent: int) -> list[_Entry]:
        return [
            _Entry(indented(self._shown(trivium), indent), trivium.start, trivium.end, None)
            for trivium in self._take(end)
        ]

    def _shown(self, trivium: Token) -> str:
        if trivium.kind == "comment":
            return trivium.text.rstrip()
        text = documentation_text(trivium.text)
        tokens = self._source.tokens
        following = self._style.index(trivium.end)
        if following < len(tokens) and tokens[following].text == ";":
            return "\n".join(f"// {line}".rstrip() for line in text.split("\n"))
        if "\n" in text:
            return f"'''\n{text}\n'''"
        return f"'''{text} '''" if text.endswith("'") else f"'''{text}'''"

    def _trailing(self, entry: _Entry) -> int:
        """Append the comment that follows a statement on its line. Returns the end of statement and
        comment.
        """
        tokens = self._source.tokens
        following = self._style.index(entry.end)
        end = entry.end
        if following < len(tokens) and tokens[following].text == ";" and not self._is_next(end):
            end = tokens[following].end
        comment = self._same_line_comment(end)
        if comment is None:
            return end
        self._next_trivium += 1
        entry.lines[-1] += f"  {comment.text.rstrip()}"
        return comment.end

    def _is_next(self, offset: int) -> bool:
        """Say whether the next comment comes before the next token after an offset."""
        if self._next_trivium == len(self._trivia):
            return False
        trivium = self._trivia[self._next_trivium]
        following = self._style.index(offset)
        tokens = self._source.tokens
        return following == len(tokens) or trivium.start < tokens[following].start

    def _same_line_comment(self, offset: int) -> Token | None:
        if not self._is_next(offset):
            return None
        trivium = self._trivia[self._next_trivium]
        is_behind = trivium.start >= offset and "\n" not in self._text[offset : trivium.start]
        return trivium if is_behind and trivium.kind == "comment" else None

    # --- statements ------------------------------------------------------------------------------

    def _statement(self, node: _Statement, indent: int) -> _Entry:
        start, end = node.span.start, node.span.end
        if isinstance(node, ast.Effect | ast.Statement):
            return _Entry(self._lines(start, end, ";", indent), start, end, "inner")
        group = type(node).__name__
        match node:
            case ast.Entity(conditions=inner) | ast.Motion(parts=inner) | ast.System(members=inner):
                lines = self._braced(node, inner, end, indent)
                return _Entry(lines, start, end, group, True)
            case ast.Action(body=Span(end=brace_end), effects=effects):
                lines = self._braced(node, effects, brace_end, indent)
                return _Entry(lines, start, end, group, True)
            case ast.Zone(shapes=inner):
                return _Entry(self._braced(node, inner, end, indent), start, end, group, True)
            case ast.Test(statements=inner):
                return _Entry(self._braced(node, inner, end, indent), start, end, group, True)
            case ast.NodeDeclaration():
                return _Entry(self._lines(start, end, "", indent), start, end, group)
            case ast.Rule():
                return _Entry(self._lines(start, end, ";", indent), start, end, group, True)
            case (
                ast.Import() | ast.Skills() | ast.Parameter() | ast.Action() | ast.Constant()
                | ast.Input() | ast.Priority() | ast.Hazard() | ast.Condition() | ast.Shape()
                | ast.TopicDeclaration()
                | ast.ServiceDeclaration() | ast.ServerDeclaration() | ast.ResourceDeclaration()
                | ast.UnitDeclaration() | ast.MessagesDeclaration() | ast.FrameDeclaration()
            ):  # fmt: skip
                return _Entry(self._lines(start, end, ";", indent), start, end, group)

    def _braced(
        self,
        node: ast.Entity | ast.Motion | ast.Zone | ast.System | ast.Action | ast.Test,
        inner: Sequence[_Statement],
        end: int,
        indent: int,
    ) -> list[str]:
        """The lines of an item whose braces end at an offset."""
        head_end = node.frame if isinstance(node, ast.Zone) else node.name
        brace = self._source.tokens[self._style.index(head_end.span.end)]
        head = _Entry(self._lines(node.span.start, brace.end, "", indent), 0, brace.end, None)
        self._trailing(head)
        lines = self.block(inner, end - 1, indent + 1)
        closing = ";" if node.span.end > end else ""
        return [*head.lines, *lines, *self._lines(end - 1, node.span.end, closing, indent)]

    def _lines(self, start: int, end: int, closing: str, indent: int) -> list[str]:
        atoms = list(self._atoms(start, end))
        if closing:
            atoms.append(Atom(closing, is_glued=True))
        return lay_out(atoms, indent)

    def _atoms(self, start: int, end: int) -> Iterator[Atom]:
        tokens = self._source.tokens
        index = self._style.index(start)
        before: Token | None = None
        while index < len(tokens) and tokens[index].start < end:
            token = tokens[index]
            stop = self._style.words.get(token.start, token.end)
            index = self._style.index(stop)
            word = Token(token.kind, self._text[token.start : stop], token.start, stop)
            is_last = index == len(tokens) or tokens[index].start >= end
            comments = () if is_last else tuple(self._inner_comments(stop, tokens[index].start))
            break_before = self._style.breaks.get(token.start)
            yield Atom(word.text, self._is_glued(before, word), break_before, comments)
            before = word

    def _inner_comments(self, start: int, end: int) -> Iterator[TrailingComment]:
        is_first = True
        for trivium in self._take(end):
            is_beside = is_first and "\n" not in self._text[start : trivium.start]
            yield TrailingComment(self._shown(trivium), is_beside and trivium.kind == "comment")
            is_first = False

    def _is_glued(self, before: Token | None, token: Token) -> bool:
        """Say whether no space precedes a token."""
        if before is None or before.end in self._style.tight_behind:
            return True
        if token.text == ".":
            return token.start not in self._style.spaced
        if token.text == "}":
            return before.text == "{"
        is_closing = token.text in (",", ";", ")", "]") or token.start in self._style.tight
        return is_closing or before.text in ("(", "[", ".")
