"""A plan as a skill: the source of a description and of a compound implementation.

Individuals of the scene become parameters. The pre-conditions are the needs of steps that no
earlier step provides; the post-conditions are the goals.
"""

from __future__ import annotations

import keyword
import re
import sys
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from ezskiros.check.spelled import spelled
from ezskiros.engine.world import World
from ezskiros.ontology import Ontology
from ezskiros.ontology.iris import THING, split
from ezskiros.ontology.model import Model
from ezskiros.ontology.python_names import identifier, identifiers
from ezskiros.ontology.statements import HasProperty, Relation, Statement, ValueComparison
from ezskiros.ontology.world import Namespace
from ezskiros.planning.facts import EVERYTHING, About, FluentLiteral, is_so
from ezskiros.planning.pddl import PlanStep
from ezskiros.planning.plan import Plan
from ezskiros.skills.importing import module_name
from ezskiros.skills.interface import Parameter

MOST_CHARACTERS = 100
"""The maximum number of characters per source line."""
_CONDITIONS = (About.RELATION, About.COMPARISON, About.PROPERTY)


def source(plan: Plan, name: str, goal: str) -> str:
    """The source of a plan as a skill. `name` is the name of the implementation."""
    return "\n".join(_Source(plan, name, goal).lines()) + "\n"


def other_folder(plan: Plan, path: Path) -> Path | None:
    """The folder from which a plan imports its skills, if it is not the folder of a file."""
    root = module_name(path.resolve())[1]
    for step in plan.steps:
        file = sys.modules[step.action.description.__module__].__file__
        folder = module_name(Path(file).resolve())[1] if file else root
        if folder != root and str(folder) not in sys.path:
            return folder
    return None


class _Source:
    def __init__(self, plan: Plan, name: str, goal: str) -> None:
        self._plan, self._goal = plan, goal
        self._name = identifier(name)
        self._description = "".join(each.capitalize() for each in self._name.split("_") if each)
        if self._description == self._name:
            self._description += "Skill"
        self._ontology: Ontology = plan.scene.ontology
        self._model: Model = self._ontology.model
        self._world: World = plan.scene.world()
        self._needs = list(dict.fromkeys(initial_needs(plan)))
        self._individuals = self._named_individuals()
        self._values = {(id(step), each.name): each for step, each in self._open_values()}

    def lines(self) -> Iterator[str]:
        """The source, line by line."""
        yield f'"""A plan for {self._one_line(self._goal)}."""'
        yield ""
        yield from self._imports()
        yield ""
        yield ""
        yield f"class {self._description}(SkillDescription):"
        yield '    """What the steps need, and what they lead to."""'
        yield ""
        yield "    def description("
        yield "        self,"
        for iri, name in self._individuals.items():
            yield f"        {name}: {self._class(iri)},"
        for name, kind in self._value_types().items():
            yield f"        {name}: {kind},"
        yield "    ):"
        for each in self._needs:
            yield f"        self.pre_conditions += {self._condition(each)}"
        for goal in self._plan.goals:
            yield f"        self.post_conditions += {self._condition(goal.literal)}"
        yield ""
        yield ""
        yield f"class {self._name}({self._description}.SkillBase):"
        yield "    def expandBT(self, params):"
        yield "        self.serialstar("
        for step in self._plan.steps:
            yield from _call(step.action.skill.name, list(self._arguments(step)))
        yield "        )"

    # --- names ------------------------------------------------------------------------------------

    def _named_individuals(self) -> dict[str, str]:
        """Individuals by IRI, with the names of their parameters."""
        used: dict[str, None] = {}
        for step in self._plan.steps:
            used.update(dict.fromkeys(step.individuals.values()))
        literals = [*self._needs, *(each.literal for each in self._plan.goals)]
        for literal in literals:
            used.update(dict.fromkeys(literal.arguments))
        found: dict[str, str] = {}
        for iri in used:
            name = _parameter_name(split(iri)[1])
            while name in found.values():
                name += "_"
            found[iri] = name
        return found

    def _open_values(self) -> Iterator[tuple[PlanStep, Parameter]]:
        """The parameters of the steps, other than individuals, that need a value."""
        for step in self._plan.steps:
            for each in step.action.skill.parameters:
                if not each.is_individual and each.default is None and not each.is_output:
                    yield step, each

    def _value_name(self, step: PlanStep, parameter: Parameter) -> str:
        """The name of the parameter, with the name of the skill if another skill uses it for
        another type.
        """
        kinds = {each.type for each in self._values.values() if each.name == parameter.name}
        is_taken = len(kinds) > 1 or parameter.name in self._individuals.values()
        return f"{step.action.skill.name}_{parameter.name}" if is_taken else parameter.name

    def _value_types(self) -> dict[str, str]:
        return {
            self._value_name(step, each): each.type.__name__ for step, each in self._open_values()
        }

    # --- parts ------------------------------------------------------------------------------------

    def _arguments(self, step: PlanStep) -> Iterator[str]:
        for name, iri in step.individuals.items():
            yield f"{name}=params.{self._individuals[iri]}"
        for other, each in self._open_values():
            if other is step:
                yield f"{each.name}=params.{self._value_name(step, each)}"

    def _class(self, iri: str) -> str:
        """The most special class that all skills require of an individual."""
        wanted = {
            parameter.iri or THING
            for step in self._plan.steps
            for parameter in step.action.individuals
            if step.individuals[parameter.name] == iri
        }
        own = [each for each in self._model.classes if self._world.is_a(iri, each)]
        special = [
            each
            for each in own
            if not any(other != each and self._model.is_a(other, each) for other in own)
        ]
        fitting = [e for e in special if all(self._model.is_a(e, other) for other in wanted)]
        chosen = min(fitting or special or sorted(wanted))
        return self._spelled(chosen)

    def _spelled(self, iri: str) -> str:
        namespace, _, _ = self._model.short(iri).partition(":")
        inside = (each for each in self._model.classes if split(each)[0] == split(iri)[0])
        known = identifiers(split(each)[1] for each in inside)
        name = next(spelling for spelling, meant in known.items() if meant == split(iri)[1])
        return f"{identifier(namespace)}.{name}"

    def _condition(self, literal: FluentLiteral) -> str:
        """A condition in the syntax of a description."""
        text = spelled(self._statement(literal), self._model)
        name = identifier(split(literal.fluent.iri)[1])
        if name not in self._ontology.ambiguous():
            return text
        subject = self._individuals[literal.arguments[0]]
        whole = self._model.short(literal.fluent.iri).replace(":", ".")
        text = text.replace(f"{subject}.{name}(", f"{whole}({subject}, ", 1)
        return text.replace(f"{subject}.{name}", f"{whole}({subject})", 1)

    def _statement(self, literal: FluentLiteral) -> Statement:
        names = [self._individuals[each] for each in literal.arguments]
        fluent = literal.fluent
        if fluent.about is About.RELATION:
            return Relation(names[0], fluent.iri, names[1], literal.is_true)
        if fluent.about is About.PROPERTY:
            return HasProperty(names[0], fluent.iri, literal.is_true)
        return ValueComparison(names[0], fluent.iri, fluent.operator, fluent.value, literal.is_true)

    def _imports(self) -> Iterator[str]:
        yield "from ezskiros import SkillDescription"
        skills = {step.action.skill.name: step.action.description for step in self._plan.steps}
        wanted: dict[str, set[str]] = {}
        for name, description in skills.items():
            wanted.setdefault(description.__module__, set()).add(name)
        used = {self._class(iri).partition(".")[0] for iri in self._individuals}
        used |= {
            self._condition(each).lstrip("~(").partition(".")[0]
            for each in (*self._needs, *(goal.literal for goal in self._plan.goals))
        } & {identifier(name) for name in self._model.names}
        loaded = {name: _module_with(name, wanted) for name in sorted(used)}
        for name, module in loaded.items():
            if module is not None:
                wanted[module].add(name)
        missing = [name for name, module in loaded.items() if module is None]
        if missing:
            yield "from ezskiros.ontology import load"
        yield ""
        for module in sorted(wanted):
            yield f"from {module} import {', '.join(sorted(wanted[module]))}"
        if missing:
            yield ""
            yield "world = load()"
            yield from (f"{name} = world.{name}" for name in missing)

    def _one_line(self, text: str) -> str:
        return re.sub(r'\s+|"|\\', " ", text).strip()


def _call(name: str, arguments: Sequence[str]) -> Iterator[str]:
    """A child of the processor, on as many lines as necessary."""
    line = f"            {name}({', '.join(arguments)}),"
    if len(line) <= MOST_CHARACTERS:
        yield line
        return
    yield f"            {name}("
    yield from (f"                {each}," for each in arguments)
    yield "            ),"


def _parameter_name(local: str) -> str:
    name = identifier(local)
    return f"{name}_" if name in ("self", "params") or keyword.iskeyword(name) else name


def _module_with(name: str, modules: Iterable[str]) -> str | None:
    """The module that has a namespace under this name; None if there is none."""
    for module in sorted(modules):
        if isinstance(vars(sys.modules[module]).get(name), Namespace):
            return module
    return None


def initial_needs(plan: Plan) -> Iterator[FluentLiteral]:
    """The needs of the steps that no earlier step affects."""
    world = plan.scene.world()
    changed: list[FluentLiteral] = []
    for step in plan.steps:
        bound = dict(step.individuals)
        for clause in step.action.needs:
            literals: Sequence[FluentLiteral] = [each.bound(bound) for each in clause]
            if literals[0].fluent.about not in _CONDITIONS:
                continue
            if any(_is_given(each, changed) for each in literals):
                continue
            yield from [each for each in literals if is_so(each, world)][:1]
        changed += [each.bound(bound) for each in step.action.effects]


def _is_given(literal: FluentLiteral, changed: Iterable[FluentLiteral]) -> bool:
    """Say whether an earlier step has made a literal true or false."""
    return any(
        each.fluent == literal.fluent
        and all(
            one in (other, EVERYTHING)
            for one, other in zip(each.arguments, literal.arguments, strict=True)
        )
        for each in changed
    )
