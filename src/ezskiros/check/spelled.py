"""Statements as text in the syntax of a description."""

from __future__ import annotations

from ezskiros.ontology.iris import split
from ezskiros.ontology.model import Model
from ezskiros.ontology.python_names import identifier
from ezskiros.ontology.statements import (
    AnyOf,
    Generated,
    HasProperty,
    OfType,
    Relation,
    Specified,
    Statement,
    ValueComparison,
    negated,
)


def spelled_iri(iri: str, model: Model) -> str:
    """The IRI of an entity as `skiros.Product`."""
    return model.short(iri).replace(":", ".")


def spelled(statement: Statement, model: Model) -> str:
    """The statement as `~Gripper.contain(Object)`."""
    opposite = None if statement.is_true else negated(statement)
    if opposite is not None:
        return _denied(opposite, spelled(opposite, model))
    match statement:
        case Relation(subject=subject, relation=iri, object=other, is_abstract=is_abstract):
            found = f"{subject}.{_bare(iri)}({other})"
            return f"abstract({found})" if is_abstract else found
        case ValueComparison(subject=subject, property=iri, operator=operator, value=value):
            return f"{subject}.{_bare(iri)} {'==' if operator == '=' else operator} {value!r}"
        case HasProperty(subject=subject, property=iri):
            return f"{subject}.{_bare(iri)}"
        case OfType(subject=subject, owl_class=iri):
            return f"of_type({subject}, {spelled_iri(iri, model)})"
        case Specified(subject=subject):
            return f"specified({subject})"
        case Generated(subject=subject):
            return f"generated({subject})"
        case AnyOf(parts=parts):
            return " | ".join(f"({spelled(part, model)})" for part in parts)


def _denied(opposite: Statement, text: str) -> str:
    if isinstance(opposite, ValueComparison) and opposite.operator == "=":
        return text.replace(" == ", " != ", 1)
    return f"~({text})" if isinstance(opposite, (ValueComparison, AnyOf)) else f"~{text}"


def _bare(iri: str) -> str:
    return identifier(split(iri)[1])
