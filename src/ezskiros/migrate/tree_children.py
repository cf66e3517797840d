"""Translation of `self.skill("Drive", "drive_fast", ...)` to `Drive.drive_fast(...)`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

import libcst as cst

from ezskiros.migrate import errors, implementation_errors
from ezskiros.migrate.calls import Arguments, literal_text
from ezskiros.migrate.comments import inner_comments
from ezskiros.migrate.description import LENGTH
from ezskiros.migrate.errors import LeftError
from ezskiros.migrate.names import is_name
from ezskiros.migrate.shared_keys import SharingChild
from ezskiros.migrate.skills import MigratedSkill
from ezskiros.migrate.tree_context import PartPosition, TreeContext

_Entry = tuple[cst.BaseExpression, cst.BaseExpression]


@dataclass
class ChildTranslation:
    """Translates the calls of skills in the tree of `skill`.

    `code` gives the text of an expression, `shown` the text of the current statement. `params` is
    the name of the argument of `expandBT`, `imports` are the imports that the method needs, and
    `sharing` the keys that children share.
    """

    skill: MigratedSkill
    code: Callable[[cst.CSTNode], str]
    shown: Callable[[], str]
    context: TreeContext
    params: str = "params"
    imports: dict[str, None] = field(default_factory=dict)
    sharing: list[SharingChild] = field(default_factory=list)

    def translated(
        self, original: cst.Call, updated: cst.Call, place: PartPosition
    ) -> cst.BaseExpression:
        """The translated call, such as `Pick.pick_fast(Object=params.Object)`. Raises
        `LeftError`.
        """
        old, new = Arguments(original, "skill"), Arguments(updated, "skill")
        if literal_text(old["stype"]) is None:
            raise LeftError(implementation_errors.NoTree(found=self.shown()), original)
        if old.get("preconditions") is not None:
            raise LeftError(
                implementation_errors.NoTree(found="pre-conditions of a child"), original
            )
        child = self._called(old.text("stype").rpartition(":")[2], old["stype"])
        label = old.text("slabel") if old.get("slabel") is not None else ""
        label = self.context.skills.labels.get(label, label)
        if label and (not is_name(label) or label.startswith("_")):
            raise LeftError(implementation_errors.NoName(found=label), old["slabel"])
        remaps = list(_entries(old, "remap"))
        self._share(child, remaps, [key for key, _ in _entries(old, "specify")])
        given = [*self._remapped(child, remaps), *self._specified(child, old, new, remaps)]
        given += self._same_keys(child, {name for name, _ in given}, remaps)
        name = self.context.wanted.name(child)
        if line := self.context.late(name, child):
            self.imports[line] = None
        name += f".{label}" if label else ""
        values = [value for _, value in _entries(new, "specify")]
        said = [each for value in values for each in inner_comments(value)]
        comments = [each for each in inner_comments(original) if each not in said]
        return _written(name, given, comments, place, self.context.step)

    def _share(
        self, child: MigratedSkill, remaps: Sequence[_Entry], values: Sequence[cst.BaseExpression]
    ) -> None:
        """Record the keys that a child shares with others."""
        texts = [(literal_text(key), literal_text(target)) for key, target in remaps]
        renamed = {key: target for key, target in texts if key in child.names and target}
        hidden = {key for key, _ in texts if key} | {literal_text(each) for each in values}
        shared = {target: child.kinds.get(key or "", "") for key, target in renamed.items()}
        own = {key: child.kinds.get(key, "") for key in child.names if key not in hidden}
        hidden_texts = {each for each in hidden if each}
        said = {target for key, target in renamed.items() if key != target}
        self.sharing.append(SharingChild(child, {**own, **shared}, said, hidden_texts))

    def _called(self, name: str, node: cst.CSTNode) -> MigratedSkill:
        """The called skill. Raises `LeftError` if it is missing, unchanged or ambiguous."""
        found = self.context.skills.called(name, self.context.path)
        if len(found) != 1 or found[0].is_left:
            said = "described in several of these files"
            if not found:
                said = "not described in these files"
            elif len(found) == 1:
                said = found[0].left_as()
            raise LeftError(implementation_errors.UnusableChild(skill=name, found=said), node)
        return found[0]

    def _remapped(
        self, child: MigratedSkill, remaps: Sequence[_Entry]
    ) -> Iterator[tuple[str, str]]:
        """The arguments for a dictionary of remaps. Raises `LeftError`."""
        for key, target in remaps:
            text = _text(target, "remap")
            own_name = self.skill.names.get(text)
            if own_name is None and text != _text(key, "remap"):
                raise self._undeclared(child, key, target, text)
            if own_name is not None:
                yield _name_of(child, key), f"{self.params}.{own_name}"

    def _undeclared(
        self, child: MigratedSkill, key: cst.BaseExpression, target: cst.BaseExpression, shared: str
    ) -> LeftError:
        """The finding for a remap to a key that is not a parameter of the compound, with the wrong
        end of the remap.
        """
        text = _text(key, "remap")
        if text in child.names:
            why = self.context.skills.keys.refused.get(self.skill.id, {}).get(shared, "")
            template = implementation_errors.SharedName(
                skill=self.skill.name, key=shared, child=child.name, why=why
            )
            return LeftError(template, target)
        unknown = implementation_errors.UnknownKey
        if shared in child.names and text in self.skill.names:
            advice = f'write {{"{shared}": "{text}"}}: the parameter of the child comes first'
            return LeftError(unknown(skill=child.name, key=text, advice=advice), key)
        return LeftError(unknown(skill=child.name, key=text), key)

    def _specified(
        self,
        child: MigratedSkill,
        old: Arguments,
        new: Arguments,
        remaps: Sequence[_Entry],
    ) -> Iterator[tuple[str, str]]:
        """The arguments for a dictionary of values. Raises `LeftError`."""
        renamed = {literal_text(each) for pair in remaps for each in pair}
        for (key, _), (_, value) in zip(
            _entries(old, "specify"), _entries(new, "specify"), strict=True
        ):
            if _text(key, "specify") in renamed:
                raise LeftError(implementation_errors.TwiceGiven(key=_text(key, "specify")), key)
            yield _name_of(child, key), self.code(value)

    def _same_keys(
        self,
        child: MigratedSkill,
        given: set[str],
        remaps: Sequence[_Entry],
    ) -> Iterator[tuple[str, str]]:
        """The arguments for keys that are equal, although the names are not."""
        renamed = {literal_text(key) for key, _ in remaps}
        for key, name in child.names.items():
            own_name = self.skill.names.get(key)
            if own_name not in (None, name) and name not in given and key not in renamed:
                yield name, f"{self.params}.{own_name}"


def _entries(given: Arguments, key: str) -> Iterator[_Entry]:
    """The entries of a dictionary; none for an empty text. Raises `LeftError`."""
    value = given.get(key)
    if value is None or literal_text(value) == "":
        return
    if not isinstance(value, cst.Dict):
        computed = errors.ComputedArgument(argument=key, call="skill", wanted="the dictionary")
        raise LeftError(computed, value)
    for each in value.elements:
        if not isinstance(each, cst.DictElement):
            computed = errors.ComputedArgument(argument=key, call="skill", wanted="its keys")
            raise LeftError(computed, each.value)
        yield each.key, each.value


def _text(node: cst.BaseExpression, argument: str) -> str:
    """A literal key. Raises `LeftError`."""
    found = literal_text(node)
    if found is None:
        computed = errors.ComputedArgument(argument=argument, call="skill", wanted="the strings")
        raise LeftError(computed, node)
    return found


def _name_of(child: MigratedSkill, key: cst.BaseExpression) -> str:
    """The name of a parameter of a child. An unknown valid name stays: the check reports it.

    Raises `LeftError`.
    """
    text = _text(key, "remap")
    if text not in child.names and not is_name(text):
        raise LeftError(implementation_errors.UnknownKey(skill=child.name, key=text), key)
    return child.names.get(text, text)


def _written(
    name: str,
    given: Sequence[tuple[str, str]],
    comments: Sequence[str],
    place: PartPosition,
    step: str,
) -> cst.BaseExpression:
    """The call of a skill, in one line if it fits."""
    arguments = [f"{key}={value}" for key, value in given]
    one = f"{name}({', '.join(arguments)})"
    if comments or (arguments and place.column + len(one) >= LENGTH):
        inside = [
            f"{place.indent}{step}{each}" for each in (*comments, *(f"{a}," for a in arguments))
        ]
        one = "\n".join([f"{name}(", *inside, f"{place.indent})"])
    return cst.parse_expression(one)
