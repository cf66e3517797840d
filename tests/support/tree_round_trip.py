"""Trees that `expand` of SkiROS2 builds, and those of `expandBT`: plain data, to compare them.

A child is its skill, its implementation, and what each of its parameters gets, by SkiROS2's keys. A
processor is its name, a number, and its children.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product
from pathlib import Path
from typing import Any

from ezskiros.driver import Checked, check_paths
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.interface import SkillInterface
from ezskiros.skills.nodes import Decorator, Node, Processor
from ezskiros.skills.stand_ins import standing_in
from ezskiros.skills.values import Symbol
from ezskiros.trees.tree import IndividualReference, ValueReference
from support import skiros2_api
from support.round_trip import _run, old_forms, write_ontology

Tree = tuple[Any, ...]
COMPUTED = "something computed"


class _Value:
    """The value of a parameter of the compound: both answers are tried where its proposition is
    asked.
    """

    def __init__(self, key: str, answers: dict[str, bool]) -> None:
        self.key, self._answers = key, answers

    @property
    def value(self) -> _Value:
        return self

    def __bool__(self) -> bool:
        return self._answers.setdefault(self.key, True)

    def _operated(self, *_others: object) -> _Value:
        return _Value(COMPUTED, self._answers)

    __add__ = __radd__ = __sub__ = __mul__ = __rmul__ = __truediv__ = __neg__ = _operated


class _Params:
    def __init__(self, answers: dict[str, bool]) -> None:
        self._answers = answers

    def __getitem__(self, key: str) -> _Value:
        return _Value(key, self._answers)


class _Child:
    """A child, or a group of children until they are given: `self.skill(Serial())(...)`."""

    def __init__(self, made: Any, name: str, given: dict[str, object]) -> None:
        self.made, self.name, self.given = made, name.rpartition(":")[2], given
        self.children: tuple[_Child, ...] = ()

    def __call__(self, *children: _Child) -> _Child:
        self.children += children
        return self

    def setProcessor(self, processor: object) -> None:  # noqa: N802
        self.made = processor

    def tree(self, labels: dict[str, str]) -> Tree:
        children = [each.tree(labels) for each in self.children]
        if isinstance(self.made, str):
            given = {key: value for key, value in self.given.items() if value != f"${key}"}
            return (self.name, labels.get(self.made, self.made) or None, given)
        return _group(self.made, children)


def _group(processor: Any, children: list[Tree]) -> Tree:
    name = type(processor).__name__
    if name == "NoFail":
        (given,) = processor.given
        inner = _group(given, children)
        return ("NoFail", None, inner[2] if inner[0] == "SerialStar" else [inner])
    if name == "RetryOnFail":
        single = len(children) == 1
        return (
            "Retry",
            processor.given[0] + 1,
            children if single else [("SerialStar", None, children)],
        )
    return ("SerialStar" if name == "Sequential" else name, None, children)


def _recorder(kind: type, answers: dict[str, bool]) -> Any:
    """An implementation that records what SkiROS2's `skill` gets."""

    class Recorder(kind):  # type: ignore[misc]
        def setDescription(self, _description: object, label: str = "") -> None:  # noqa: N802
            self.label = label

        def setProcessor(self, processor: object) -> None:  # noqa: N802
            """SkiROS2 has taken the processor before."""

        def skill(self, stype: Any, slabel: str = "", remap: Any = (), specify: Any = ()) -> _Child:
            given: dict[str, object] = {k: f"${target}" for k, target in dict(remap).items()}
            for key, value in dict(specify).items():
                given[key] = _kept(value)
            return _Child(slabel if isinstance(stype, str) else stype, str(stype), given)

    found = Recorder()
    found.params = _Params(answers)
    found.createDescription()
    return found


def _kept(value: object) -> object:
    if not isinstance(value, _Value):
        return value
    return value.key if value.key == COMPUTED else f"${value.key}"


def old_trees(text: str) -> dict[str, list[Tree]]:
    """All trees of the compound skills in a module of SkiROS2."""
    with skiros2_api.installed(), standing_in(lambda _name, _place: None):
        module = _run("old", text)
        kinds = {
            name: each
            for name, each in module.items()
            if isinstance(each, type) and "setDescription" in _names(each)
        }
        labels = {_recorder(each, {}).label: name for name, each in kinds.items()}
        compounds = {name: each for name, each in kinds.items() if hasattr(each, "expand")}
        serial = type("SerialStar", (skiros2_api.Other,), {})
        found: dict[str, list[Tree]] = {}
        for name, kind in compounds.items():
            found[name] = [root.tree(labels) for root in _expanded(kind, serial)]
        return found


def _names(kind: type) -> tuple[str, ...]:
    function = vars(kind).get("createDescription")
    return function.__code__.co_names if function else ()


def _expanded(kind: type, serial: type) -> Iterator[_Child]:
    """The tree for each answer to what the method asks."""
    asked: dict[str, bool] = {}
    _recorder(kind, asked).expand(_Child(serial(), "", {}))
    for answers in product((True, False), repeat=len(asked)):
        root = _Child(serial(), "", {})
        _recorder(kind, dict(zip(asked, answers, strict=True))).expand(root)
        yield root


def new_trees(text: str, before: str, folder: Path) -> tuple[dict[str, list[Tree]], Checked]:
    """All trees of the compound skills in a translated module, and what a check says of it."""
    write_ontology(old_forms(before).values(), folder)
    world = (
        f"from ezskiros.ontology import load\nglobals().update(load({str(folder)!r}).namespaces)\n"
    )
    (folder / "world.py").write_text(world)
    (folder / "skills.py").write_text(text)
    checked = check_paths([folder / "skills.py"])
    found: dict[str, list[Tree]] = {}
    for tree in checked.trees:
        found.setdefault(tree.implementation, []).append(_new(tree.root, tree.skill, checked))
    return found, checked


def _new(node: Node, compound: SkillInterface, checked: Checked) -> Tree:
    match node:
        case Processor(flow=flow, children=children):
            return (flow.value, None, [_new(each, compound, checked) for each in children])
        case Decorator(decoration=decoration, limit=limit, child=child):
            return (decoration.value, limit, [_new(child, compound, checked)])
        case SkillCall():
            skill = checked.library.skill(node.skill)
            assert skill is not None
            keys = {each.name: each.key for each in skill.parameters}
            given = {keys.get(name, name): _given(each) for name, each in node.arguments.items()}
            given = {key: value for key, value in given.items() if value != f"${key}"}
            return (skill.name, node.implementation, given)
    raise AssertionError(node)


def _given(value: object) -> object:
    if isinstance(value, (IndividualReference, ValueReference)):
        return f"${value.parameter.key}"
    return COMPUTED if isinstance(value, Symbol) else value
