"""Statements of conditions: written as JSON, and read again."""

from __future__ import annotations

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ezskiros.export.statements import MOST_LEVELS, MOST_PARTS, statement_of, written
from ezskiros.ontology.statements import (
    AnyOf,
    Generated,
    HasProperty,
    OfType,
    Relation,
    Specified,
    Statement,
    ValueComparison,
)
from support.exports import SCHEMA
from support.json_schema import faults

TEXTS = st.text(max_size=5)
VALUES = st.one_of(TEXTS, st.integers(), st.floats(allow_nan=False), st.booleans())
PLAIN: st.SearchStrategy[Statement] = st.one_of(
    st.builds(Relation, TEXTS, TEXTS, TEXTS, st.booleans(), st.booleans()),
    st.builds(ValueComparison, TEXTS, TEXTS, st.sampled_from(["=", "<", ">", "<=", ">="]), VALUES),
    st.builds(HasProperty, TEXTS, TEXTS, st.booleans()),
    st.builds(OfType, TEXTS, TEXTS),
    st.builds(Specified, TEXTS, st.booleans()),
    st.builds(Generated, TEXTS, st.booleans()),
)
STATEMENTS = st.recursive(
    PLAIN,
    lambda parts: st.builds(
        AnyOf, st.lists(parts, min_size=1, max_size=3).map(tuple), st.booleans()
    ),
    max_leaves=6,
)
RELATION = written(Relation("Robot", "http://example.org/at", "Start"))


def nested(levels: int) -> object:
    """An `any` in an `any`, and so on."""
    found: object = RELATION
    for _ in range(levels - 1):
        found = {"kind": "any", "parts": [found], "is_true": True}
    return found


@given(STATEMENTS)
def test_a_statement_is_read_as_it_was_written(statement: Statement) -> None:
    text = json.dumps(written(statement), allow_nan=False)
    assert statement_of(json.loads(text)) == statement
    schema = {"$ref": "#/$defs/statement", "$defs": SCHEMA["$defs"]}
    assert not list(faults(json.loads(text), schema))


@pytest.mark.parametrize(
    ("found", "reported"),
    [
        (None, "it is not an object"),
        ([], "it is not an object"),
        ({}, "its `kind` is not one of"),
        ({"kind": ["relation"]}, "its `kind` is not one of"),
        ({**RELATION, "kind": "relative"}, "its `kind` is not one of"),
        ({**RELATION, "subject": 1}, "its `subject` is missing or has the wrong type"),
        ({**RELATION, "is_true": 1}, "its `is_true` is missing or has the wrong type"),
        (
            {k: v for k, v in RELATION.items() if k != "object"},
            "its `object` is missing or has the wrong type",
        ),
        (
            {**written(ValueComparison("A", "b", "=", 1)), "operator": "=="},
            "its `operator` is not one of",
        ),
        ({**written(ValueComparison("A", "b", "=", 1)), "value": None}, "its `value` is missing"),
        ({"kind": "any", "parts": [], "is_true": True}, "its `parts` are not a list"),
        ({"kind": "any", "parts": [RELATION]}, "its `is_true` is missing"),
        (
            {"kind": "any", "parts": [RELATION] * (MOST_PARTS + 1), "is_true": True},
            "it has more than 1,000 parts",
        ),
        (nested(MOST_LEVELS + 1), "it has more than 50 levels"),
    ],
)
def test_another_object_is_refused(found: object, reported: str) -> None:
    with pytest.raises(ValueError, match="it") as problem:
        statement_of(found)
    assert reported in str(problem.value)
