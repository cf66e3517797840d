"""The maximum numbers of values of a property, or of related individuals."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from ezskiros.check import errors, world_errors
from ezskiros.check.clash import Axiom, Clash, FactReason, joined
from ezskiros.ontology.model import Model


class Limit(NamedTuple):
    """A maximum number of values, and its source in the ontology."""

    most: int
    axiom: Axiom
    reason: FactReason = FactReason()
    is_of_class: bool = False

    def exceeded(self, reasons: Iterable[FactReason], individual: str) -> Clash:
        """The clash of an individual that has more values than the limit."""
        whole = joined(*reasons, self.reason, axiom=self.axiom)
        kind = errors.TwoPlaces if self.most else world_errors.HasNone
        return Clash(
            whole.said, kind, whole.axioms, individual=individual if self.is_of_class else None
        )


def limits(iri: str, classes: Mapping[str, FactReason], model: Model) -> Iterator[Limit]:
    """The limits of a property, for an individual of some classes."""
    declared = model.property(iri)
    if declared is not None and declared.is_functional:
        is_relation = iri in model.relations
        one = "relates to at most one other" if is_relation else "has at most one value"
        yield Limit(1, Axiom(f"{{}} is functional: an individual {one}", (iri,)))
    for owl_class, reason in classes.items() if iri in model.limited else ():
        most = model.most(owl_class, iri)
        if most is not None:
            count = f"at most {most}" if most else "no"
            axiom = Axiom(f"a {{}} has {count} {{}}", (owl_class, iri))
            yield Limit(most, axiom, reason, is_of_class=not reason.said)


def limit_of_subjects(iri: str, model: Model) -> Limit | None:
    """The limit of an inverse functional relation."""
    declared = model.relations.get(iri)
    if declared is None or not declared.is_inverse_functional:
        return None
    text = "{} is inverse functional: at most one individual relates to another"
    return Limit(1, Axiom(text, (iri,)))
