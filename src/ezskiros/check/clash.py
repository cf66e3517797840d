"""Statements that cannot all hold, and the reasons."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

from ezskiros.check.spelled import spelled_iri
from ezskiros.check.world_errors import Together
from ezskiros.ontology.model import Model
from ezskiros.ontology.statements import Statement


class Axiom(NamedTuple):
    """A statement of the ontology: a text with placeholders for the names in it."""

    text: str
    iris: tuple[str, ...]

    def reported(self, model: Model) -> str:
        """The statement as a clause of a sentence."""
        return self.text.format(*(spelled_iri(iri, model) for iri in self.iris))


class FactReason(NamedTuple):
    """The reason for a fact: the conditions that imply it, and the axioms of the ontology."""

    said: frozenset[Statement] = frozenset()
    axioms: tuple[Axiom, ...] = ()


@dataclass(frozen=True)
class Clash:
    """A contradiction: the statements `said` cannot hold together, by `axioms` of the ontology, and
    by `why`.

    `iris` are the other entities of the ontology in the reason; `individual` is the parameter whose
    class is part of the reason.
    """

    said: frozenset[Statement]
    kind: type[Together]
    axioms: tuple[Axiom, ...] = ()
    why: str = ""
    iris: tuple[str, ...] = ()
    individual: str | None = None

    def reason(self, model: Model) -> str:
        """The full reason, in one sentence."""
        reported = dict.fromkeys(axiom.reported(model) for axiom in self.axioms)
        return "; ".join([*reported, *filter(None, [self.why])])

    def declared(self) -> Iterable[str]:
        """All entities of the ontology in the reason, each once."""
        found = [iri for axiom in self.axioms for iri in axiom.iris]
        return dict.fromkeys([*found, *self.iris])


def joined(*reasons: FactReason, axiom: Axiom | None = None) -> FactReason:
    """Several reasons joined, with one more axiom if given."""
    said = frozenset[Statement]().union(*(each.said for each in reasons))
    axioms = tuple(axiom for each in reasons for axiom in each.axioms)
    return FactReason(said, (*axioms, axiom) if axiom else axioms)


KnownClasses: TypeAlias = Mapping[str, Mapping[str, FactReason]]
"""The known classes of each individual, with a reason for each. The class of a parameter needs no
reason.
"""
