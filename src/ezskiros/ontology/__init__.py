"""Ontologies (OWL) as Python types.

The pattern Domain Language Mapping (thesis, Paper IV, section 4.2): classes of the ontology are
Python classes, with the real relation of subclasses, and relations are methods of them.
"""

from ezskiros.ontology.load import load
from ezskiros.ontology.world import Namespace, Ontology

__all__ = ["Namespace", "Ontology", "load"]
