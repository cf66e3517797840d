"""The list of all diagnostic classes by stage, for pages, SARIF and tests."""

from __future__ import annotations

from dslkit.catalog import Catalog
from dslkit.diagnostics import Template
from ezskiros.catalog import errors as catalog_errors
from ezskiros.check import body_errors, scene_errors, world_errors
from ezskiros.check import errors as check_errors
from ezskiros.check import tree_errors as tree_check_errors
from ezskiros.confinement import errors as confinement_errors
from ezskiros.context import errors as context_errors
from ezskiros.contracts import errors as contract_errors
from ezskiros.drawing import errors as drawing_errors
from ezskiros.export import errors as export_errors
from ezskiros.hosts import owl_errors, skiros2_errors
from ezskiros.learning import errors as learning_errors
from ezskiros.locations import errors as location_errors
from ezskiros.migrate import errors as migrate_errors
from ezskiros.migrate import implementation_errors
from ezskiros.ontology import condition_errors
from ezskiros.ontology import errors as ontology_errors
from ezskiros.planning import errors as planning_errors
from ezskiros.skills import errors as skills_errors
from ezskiros.skills import load_errors, parameter_errors, permit_errors, tree_errors
from ezskiros.trees import errors as launch_errors

DIAGNOSTICS: tuple[type[Template], ...] = (
    *load_errors.ALL,
    *ontology_errors.ALL,
    *skills_errors.ALL,
    *parameter_errors.ALL,
    *permit_errors.ALL,
    *confinement_errors.ALL,
    *condition_errors.ALL,
    *world_errors.ALL,
    *tree_errors.ALL,
    *body_errors.ALL,
    *launch_errors.ALL,
    *tree_check_errors.ALL,
    *contract_errors.ALL,
    *check_errors.ALL,
    *scene_errors.ALL,
    *location_errors.ALL,
    *migrate_errors.ALL,
    *implementation_errors.ALL,
    *drawing_errors.ALL,
    *planning_errors.ALL,
    *export_errors.ALL,
    *learning_errors.ALL,
    *context_errors.ALL,
    *skiros2_errors.ALL,
    *owl_errors.ALL,
    *catalog_errors.ALL,
)

CATALOG = Catalog("ezskiros", "ezskiros.catalog", DIAGNOSTICS)
