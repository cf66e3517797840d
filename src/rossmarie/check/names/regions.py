"""Locations of a class of individuals: `pose in Corridor`, `distance(pose, skiros.Location)`."""

from __future__ import annotations

import re

from dslkit.diagnostics import listed
from dslkit.source import Span
from rossmarie import core
from rossmarie.check.model import CheckedSkills
from rossmarie.check.names.frames import check_frame_is
from rossmarie.check.names.region_errors import (
    NoFrame,
    NoLocation,
    SeveralClasses,
    SeveralFrames,
    UnknownLocation,
)
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import stripped, text_of
from rossmarie.skills import Location, among
from rossmarie.syntax import ast
from rossmarie.types import Message, Region, Text, Type, Unknown

FRAME_OF_HEADER = ("header", "frame_id")
"""The path from a message to its frame (REP 105)."""


def type_of_class(node: ast.Reference | ast.Member, context: Context) -> Type | None:
    """The locations of the class that a name stands for, recorded in `context.regions`; None if no
    class has this name.
    """
    skills = context.skills
    name = text_of(node)
    found = () if skills is None else among(name, skills.file.classes)
    if skills is None and context.names_skills and _is_asked_for(node, context):
        return Unknown()  # the file with the class could not be read
    if skills is None or not found:
        return None
    if len(found) > 1:
        several = SeveralClasses(identifier=name, known=listed(found))
        context.collector.add(several.at(node.span))
        return Unknown()
    places = places_of(found[0], node.span, skills, context)
    if places is None:
        return Unknown()
    context.regions[node], type_ = places
    return type_


def classes_for(node: ast.Reference, context: Context) -> list[str]:
    """The bare names of the classes that a name at this place may stand for; none if a class is not
    possible there.
    """
    if context.skills is None or not _is_asked_for(node, context):
        return []
    return [each.rpartition(".")[2] for each in context.skills.file.classes]


def _is_asked_for(node: ast.Expression, context: Context) -> bool:
    """Say whether a class name is allowed at the place of a name."""
    around = context.parents.get(node)
    match around:
        case ast.Parenthesized():
            return _is_asked_for(around, context)
        case ast.Membership(container=container):
            return container is node
        case ast.Call(function=function, arguments=[_, second]):
            return function.text == "distance" and second is node
        case _:  # open: the name is part of another expression
            return False


def places_of(
    owl_class: str, named: Span, skills: CheckedSkills, context: Context
) -> tuple[core.Region, Region] | None:
    """The locations of a class, with their type; None after reporting. `named` is the place of the
    class in the rules.
    """
    below = {*skills.classes.below(owl_class)}
    known = [each for each in skills.file.locations if below & {*each.classes}]
    nowhere = [each for each in known if not each.corners]
    frames = sorted({each.frame for each in known if each.corners})
    if not known:
        path = skills.declaration.path.value
        context.collector.add(NoLocation(owl_class=owl_class, path=path).at(named))
    for each in nowhere:
        finding = UnknownLocation(individual=_called(each), owl_class=owl_class)
        span = skills.span_at(each.place)
        places = () if span is None else (finding.Described().at(span),)
        context.collector.add(finding.at(named, *places))
    if len(frames) > 1:
        several = SeveralFrames(owl_class=owl_class, frames=listed(frames))
        context.collector.add(several.at(named))
    if not known or nowhere or len(frames) > 1:
        return None
    region = core.Region(
        name=_word(owl_class),
        about=f"the places of {owl_class}",
        shapes=tuple(_polygon(each, skills) for each in known),
    )
    return region, Region(owl_class, frames[0], any(len(each.corners) > 1 for each in known))


def _polygon(location: Location, skills: CheckedSkills) -> core.Polygon:
    number = skills.file.locations.index(location)
    about = _called(location)
    return core.Polygon(f"location_{number}_{_word(about)}", about, location.corners)


def _called(location: Location) -> str:
    """The label of an individual, or else the last part of its IRI, with only the characters that
    comments may contain.
    """
    name = location.label or re.split("[#/]", location.iri)[-1]
    return re.sub(r"[^\w .-]", "_", name, flags=re.ASCII) or "it"


def _word(name: str) -> str:
    return re.sub(r"\W", "_", name, flags=re.ASCII).lower()


# --- frames ----------------------------------------------------------------------------------


def check_frame(position: ast.Expression, context: Context) -> bool:
    """Say whether a message has the frame of a position. Report an error if not."""
    if isinstance(context.type_of(position), Unknown):
        return True
    reason = _without_frame(position, context)
    if reason is not None:
        text = text_of(position)
        context.collector.add(NoFrame(text=text, reason=reason).at(position.span))
    return reason is None


def check_frame_of_region(
    position: ast.Expression, container: ast.Expression, context: Context
) -> bool:
    """Say whether a position can be in a region: a message has its frame, and this frame is not
    known to differ. Errors are reported.
    """
    region = context.type_of(container)
    if not check_frame(position, context) or not isinstance(region, Region):
        return False
    return check_frame_is(position, region.frame, container, context)


def _root(position: ast.Expression) -> ast.Reference | None:
    """The name before the fields; None if there is none."""
    node = stripped(position)
    while isinstance(node, ast.Member | ast.Index | ast.Sector):
        node = stripped(node.value)
    return node if isinstance(node, ast.Reference) else None


def _without_frame(position: ast.Expression, context: Context) -> str | None:
    """The reason why the frame of a position is unknown; None if a header has it."""
    root = _root(position)
    fold = None if root is None else context.folds_around(root).get(root.name.text)
    if fold is not None:
        root = _root(fold.list)  # the header of the message with the list applies to all elements
    used = None if root is None else context.inputs.get(root.name.text)
    if used is None or context.messages is None:
        return "it is not a field of an input"
    if used.frame is not None:
        return None
    message = context.messages.find(used.message_type)
    header = None if message is None else message.fields.get(FRAME_OF_HEADER[0])
    has_frame = isinstance(header, Message) and isinstance(
        header.fields.get(FRAME_OF_HEADER[1]), Text
    )
    return None if has_frame else f"{used.message_type} has no header"
