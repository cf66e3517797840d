"""Skills against the ontology and against themselves; all that is wrong at once."""

from ezskiros.check.skills import check_skills

__all__ = ["check_skills"]
