"""The words of the language, as data."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

_LIKENESS = 0.7  # the share of letters in common from which on a word is meant as another

ITEM_WORDS = {
    "import": "import_item",
    "system": "system",
    "action": "action",
    "const": "constant",
    "input": "input",
    "entity": "entity",
    "rule": "rule",
    "if": "rule",
}
"""The words that begin an item, and the grammar's rule for that item."""

MEMBER_WORDS = {
    "topic": "topic_declaration",
    "unit": "unit_declaration",
    "messages": "messages_declaration",
    "node": "node",
}
"""The words that begin a declaration inside a system."""

PART_WORDS = frozenset(
    {"timeout", "clear", "when", "latched", "until", "reset", "times", "within", "by"}
    | {"publishes", "subscribes"}
)
"""The words that are keywords in their places inside other items, and names elsewhere."""

MEANT = {"when": "if", "whenever": "if", "include": "import"}
"""Words that people begin an item with, and the word that they mean."""

OPERATOR_WORDS = frozenset({"and", "or", "not", "in", "for"})

RESERVED = OPERATOR_WORDS | ITEM_WORDS.keys() | {"topic", "then", "true", "false"}
"""Words that never are the name of a constant, input, entity, condition, action or rule."""

FOREIGN = {
    "&&": "and",
    "&": "and",
    "||": "or",
    "|": "or",
    "!": "not",
    "=": "==",
    "===": "==",
    "!==": "!=",
    "<>": "!=",
    "≠": "!=",
    "=<": "<=",
    "≤": "<=",
    "=>": ">=",
    "≥": ">=",
}
"""Operators as other languages write them, and the operator that is meant."""

COMPARISONS = frozenset({"==", "!=", "<", "<=", ">", ">="})


def nearest(word: str, words: Iterable[str]) -> str | None:
    """The one of `words` that `word` is, but for a slip of the pen; None if it is none of them."""
    near = difflib.get_close_matches(word, words, n=1, cutoff=_LIKENESS)
    return near[0] if near else None


FORMS = {
    "module": "a file consists of imports, systems, actions, constants, inputs, entities and rules",
    "actions": "actions are written `{ ACTION; ACTION; }`",
    "import_item": 'an import is written `import "FILE.ross";`',
    "system": "a system is written `system NAME { topic /TOPIC : PACKAGE/TYPE; }`",
    "action": "an action is written `action NAME;`",
    "constant": "a constant is written `const NAME = 0.5 m/s;`",
    "input": "an input is written "
    "`input NAME = topic /TOPIC : PACKAGE/TYPE .FIELD timeout 0.2 sec;`",
    "entity": "an entity is written `entity NAME { CONDITION : EXPRESSION; }`",
    "condition": "a condition is written `NAME : EXPRESSION;`",
    "rule": "a rule is written `rule NAME: if CONDITION then { ACTION; };`",
    "contract": "a resume contract is `clear when CONDITION`, `clear for 2 sec` or "
    "`latched until reset`",
    "expression": "a condition is built of names, comparisons, `and`, `or`, `not` and "
    "`for DURATION`",
    "topic_declaration": "a topic is declared as `topic /TOPIC : PACKAGE/TYPE;`",
    "unit_declaration": "the unit of a field is declared as `unit PACKAGE/TYPE.FIELD = rad/s;`",
    "messages_declaration": 'a folder of message definitions is declared as `messages "FOLDER";`',
    "node": "a node is declared as `node NAME { publishes /TOPIC; subscribes /TOPIC; }`",
}
"""How each part of a file is written, for messages."""
