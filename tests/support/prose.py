"""The sentences of a page in Markdown or of a docstring, and our rules of plain English for them.

No linter with rules of one's own comes from a registry by name (decision 0081), so the rules are
regular expressions: each names a construction that readers had to read twice.
"""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Iterator
from dataclasses import dataclass

LONGEST = 45
"""The most words of a sentence."""


@dataclass(frozen=True)
class Rule:
    """A construction to avoid; `instead` says how to write."""

    name: str
    pattern: re.Pattern[str]
    instead: str


def _rule(name: str, pattern: str, instead: str) -> Rule:
    return Rule(name, re.compile(pattern, re.IGNORECASE), instead)


RULES = (
    _rule("so long as", r"\bso long as\b", "while, or if"),
    _rule("clause as subject", r"^what [^?]*[^?]$", "name the thing: `The rules that ...`"),
    _rule("what comes of", r"\bwhat (comes?|came|becomes?|became) of\b", "the result of"),
    _rule("is told", r"\b(is|are|was|were|be) told\b(?! (to|which|that)\b)", "is reported"),
    _rule("nobody", r"\b(nobody|somebody) (says|tells|asks|hears|knows)\b", "name the program"),
    _rule("whoever", r"\bwhoever\b", "name the person or the program"),
    _rule("but for", r"\bbut for\b", "except"),
    _rule("save", r"(?<=, )save (?!the file|a |as )", "except"),
    _rule("of which", r"\b(some|one|each|all|none|most) of which\b", "begin a new sentence"),
    _rule("the one that", r"\bthat of (which|what|whoever)\b", "repeat the noun"),
    _rule("seeded fault", r"\bseeded faults?\b", "mutant"),
    _rule("lost input", r"\blost inputs?\b|\binputs? (is|are) lost\b", "stale input"),
)
"""The rules; a name is the key of what a page may still contain."""

_FENCED = re.compile(r"^( *)(```|~~~).*?^\1\2 *$", re.MULTILINE | re.DOTALL)
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_CODE = re.compile(r"`[^`\n]*`")
_LINK = re.compile(r"!?\[([^\]]*)\](\([^)]*\)|\[[^\]]*\])")
_END = re.compile(r"(?<=[.!?])\s+(?=[A-Z\"'(`*_])")


def sentences(page: str) -> Iterator[str]:
    """The sentences of the paragraphs and the lists; code in a sentence counts as one word."""
    text = _COMMENT.sub("", _FENCED.sub("\n", page))
    for block in re.split(r"\n\s*\n|^ *(?:[-*]|\d+\.) ", text, flags=re.MULTILINE):
        lines = [line for line in block.splitlines() if not _is_no_prose(line)]
        plain = _LINK.sub(r"\1", _CODE.sub("Code", " ".join(line.strip() for line in lines)))
        yield from (each.strip(" *_") for each in _END.split(plain) if each.strip(" *_"))


def findings(page: str) -> Iterator[tuple[str, str]]:
    """The names of the rules that a page breaks, each with the sentence."""
    for sentence in sentences(page):
        yield from ((rule.name, sentence) for rule in RULES if rule.pattern.search(sentence))
        if len(sentence.split()) > LONGEST:
            yield "long sentence", sentence


_QUESTION = re.compile(r"(?:What|Whether|Which|How|Of|By|From|That|Where|Why|When|Who)\b")


def docstrings(source: str) -> Iterator[tuple[int, str]]:
    """The docstrings of a Python module with their lines, including those below assignments."""
    for node in ast.walk(ast.parse(source)):
        body = getattr(node, "body", None)
        for statement in body if isinstance(body, list) else ():
            value = statement.value if isinstance(statement, ast.Expr) else None
            if isinstance(value, ast.Constant) and isinstance(value.value, str):
                yield statement.lineno, inspect.cleandoc(value.value)


def docstring_findings(source: str) -> Iterator[tuple[int, str, str]]:
    """The lines of the docstrings that break a rule, each with the rule and the sentence."""
    for line, text in docstrings(source):
        if _QUESTION.match(text):
            yield line, "opening word", text.partition("\n")[0]
        yield from ((line, *found) for found in findings(text))


def _is_no_prose(line: str) -> bool:
    return line.startswith(("#", "|", "    ", "[", "---", ">", "<", ":")) or line.lstrip() == ""
