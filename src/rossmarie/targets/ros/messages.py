"""C++ that passes messages to the monitor, and limits the numbers of commands."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rossmarie import ir
from rossmarie.ir import reactions
from rossmarie.naming import unfiltered
from rossmarie.targets.c99 import names as c99_names
from rossmarie.targets.c99 import types
from rossmarie.targets.c99.layout import CLayout
from rossmarie.targets.c99.text import block, indented
from rossmarie.targets.ros import names
from rossmarie.targets.ros.dialect import Dialect, RosInterface


def types_of(machine: ir.Machine) -> list[str]:
    """The types of all messages that come in or go through the filter, sorted."""
    topics = (each for each in machine.channels if not ir.is_setting(each))
    used = {channel.source_type for channel in topics}
    return sorted(used | {command.message_type for command in machine.reactions.commands})


def channels(layout: CLayout, dialect: Dialect) -> str:
    """A struct for each input topic, with a function that copies the fields of a message."""
    classes = names.channel_classes(layout).items()
    return "".join(_channel(layout, dialect, channel, word) for channel, word in classes)


def given(layout: CLayout) -> str:
    """The lines that pass the parameters of the rules to the monitor."""
    lines = []
    for index, each in enumerate(ir.settings_of(layout.machine)):
        name = layout.channel_names[each.channel]
        (field,) = types.fields_of(layout.machine, each.channel)
        lines += [f"values.has_{name} = true;", f"values.{name}.{field.name} = given[{index}];"]
    return block(lines)


def arrays(layout: CLayout) -> str:
    """The members of the struct that holds arrays while the monitor processes them."""
    machine = layout.machine
    kept = (
        _room(machine, field.array, f"{layout.channel_names[channel]}_{field.name}")
        for channel in range(len(layout.channel_names))
        for field in types.fields_of(machine, channel)
        if field.array is not None
    )
    return block(kept)


def _room(machine: ir.Machine, array: int, name: str) -> str:
    """The member that stores an array. A column of a list has a bound, so it needs no heap."""
    its_list = machine.arrays[array].list
    if its_list is None:
        return f"std::vector<double> {name};"
    return f"std::array<double, {machine.lists[its_list].most}> {name}{{}};"


def _channel(layout: CLayout, dialect: Dialect, channel: int, word: str) -> str:
    topic, name = layout.machine.channels[channel], layout.channel_names[channel]
    fields = types.fields_of(layout.machine, channel)
    lines = [line for field in fields for line in _field(layout, name, field)]
    lines += [line for field in fields for line in _points(layout, name, field, fields)]
    lines += [line for field in fields for line in _beams(layout, name, field, fields)]
    has_array = any(field.array is not None for field in fields)
    edge = topic.edge
    message = "const Message &"
    if fields:
        message += "message" if edge is None else "all"
    if edge is not None and fields:
        lines.insert(0, f"const auto &message = *{_transform(edge)};")
    timeout = types.duration(_timeout(layout, channel))
    arrays = "Arrays &arrays" if has_array else "Arrays &"
    return (
        f"// {topic.topic}: {topic.message_type}\n"
        f"struct {word} {{\n"
        f"    using Message = {dialect.cpp_type(topic.source_type, RosInterface.MESSAGE)};\n"
        f"    static constexpr const char *topic = {names.heard(topic)};\n"
        f"    static constexpr int64_t timeout_ns = {timeout};\n\n"
        f"    static void fill({layout.name}_values &values, {arrays}, {message})\n"
        f"    {{\n{indented([f'values.has_{name} = true;', *lines], 2)}\n    }}\n\n"
        f"    static void forget({layout.name}_values &values) {{ values.has_{name} = false; }}\n"
        f"{_has(edge)}}};\n\n"
    )


def _has(edge: ir.Edge | None) -> str:
    """The function that reports whether a message contains the transform of a channel."""
    if edge is None:
        return ""
    return (
        "\n    static bool has(const Message &all)\n"
        f"    {{\n        return {_transform(edge)} != nullptr;\n    }}\n"
    )


def _transform(edge: ir.Edge) -> str:
    """The transform in the message `all`, as C++."""
    frames = c99_names.string(edge.parent), c99_names.string(edge.child)
    return f"transform_in(all, {', '.join(frames)})"


def _timeout(layout: CLayout, channel: int) -> int:
    """The least timeout of the inputs of a channel in ns, 0 if none has one."""
    timeouts = (used.timeout_ns for used in layout.machine.inputs if used.channel == channel)
    return min((timeout for timeout in timeouts if timeout is not None), default=0)


def _field(layout: CLayout, channel: str, field: types.StructField) -> Iterator[str]:
    """The lines that copy one field of `message`."""
    target = f"values.{channel}.{field.name}"
    if field.slot is not None:
        yield f"{target} = {_scalar(layout.machine.slots[field.slot])};"
        return
    assert field.array is not None, "a field is a slot or an array"
    array = layout.machine.arrays[field.array]
    kept = f"arrays.{channel}_{field.name}"
    sector = array.path[-1] if array.path else ""
    if isinstance(sector, ir.Sector):
        scan = f"message{names.member(array.path[:-2])}"
        yield f"sector({scan}, {types.number(sector.first)}, {types.number(sector.width)}, {kept});"
        yield f"{target} = {kept}.data();"
        yield f"values.{channel}.{field.count} = {kept}.size();"
        return
    if ir.POINTS in array.path or _beams_on(array.path) is not None:
        yield f"{target} = {kept}.data();"
        return
    if array.list is not None:
        its_list = f"message{names.member(layout.machine.lists[array.list].path)}"
        inside = names.member(array.path[array.path.index(ir.EACH) + 1 :])
        yield f"{target} = column({its_list}, {kept},"
        yield f"    [](const auto &each) {{ return {_reader(array.kind)}(each{inside}); }});"
        if field.count is not None:
            yield f"values.{channel}.{field.count} = {its_list}.size();"
        return
    whole = names.member(array.path)
    yield f"{kept} = numbers(message{whole});"
    yield f"{target} = {kept}.data();"
    yield f"values.{channel}.{field.count} = {kept}.size();"


def _points(
    layout: CLayout, channel: str, last: types.StructField, fields: Sequence[types.StructField]
) -> Iterator[str]:
    """The lines that copy the points of a cloud, at the last of their fields."""
    machine = layout.machine
    its_list = None if last.array is None else machine.arrays[last.array].list
    if its_list is None or last.count is None or ir.POINTS not in machine.lists[its_list].path:
        return
    cloud = f"message{names.member(machine.lists[its_list].path[:-1])}"
    yield f"values.{channel}.{last.count} = points({cloud}, {machine.lists[its_list].most}, {{"
    for field in fields:
        if field.array is not None and machine.arrays[field.array].list == its_list:
            name = c99_names.string(str(machine.arrays[field.array].path[-1]))
            yield f"    {{{name}, arrays.{channel}_{field.name}.data()}},"
    yield "});"


def _beams(
    layout: CLayout, channel: str, last: types.StructField, fields: Sequence[types.StructField]
) -> Iterator[str]:
    """The lines that copy the beams of a scan, at the last of their fields."""
    machine = layout.machine
    its_list = None if last.array is None else machine.arrays[last.array].list
    if its_list is None or last.count is None:
        return
    whole = machine.lists[its_list]
    kind = _beams_on(whole.path)
    if kind is None:
        return
    scan = f"message{names.member(whole.path[:-1])}"
    are_points = "true" if kind == ir.RETURNS else "false"
    yield f"values.{channel}.{last.count} = beams({scan}, {are_points}, {whole.most}, {{"
    for field in fields:
        if field.array is not None and machine.arrays[field.array].list == its_list:
            word = str(machine.arrays[field.array].path[-1]).upper()
            yield f"    {{BeamField::{word}, arrays.{channel}_{field.name}.data()}},"
    yield "});"


def _beams_on(path: ir.Path) -> ir.Beams | None:
    """The beams through which a path leads."""
    return next((step for step in path if isinstance(step, ir.Beams)), None)


def _scalar(slot: ir.Slot) -> str:
    """A field as a double."""
    last = slot.path[-1] if slot.path else ""
    if isinstance(last, ir.Doing | ir.Quantity):
        return skill_query(last)
    several = ir.Each | ir.Points | ir.Sector | ir.Beams
    assert not isinstance(last, several), "all elements are no scalar"
    if not isinstance(last, str):
        whole = f"message{names.member(slot.path[:-1])}"
        return f"element({whole}, {_element_place(last, whole)})"
    return f"{_reader(slot.kind)}(message{names.member(slot.path)})"


def skill_query(step: ir.SkillStep) -> str:
    """A query about the running skills in `message`, as a double in C++."""
    asked = f"message, {c99_names.string(step.export)}, skills::names({_texts(step.skills)})"
    match step:
        case ir.Doing(arguments=arguments, is_ahead=is_ahead):
            limits = (
                f"skills::limit({_texts((parameter, *classes))})"
                for parameter, classes in arguments
            )
            asks = "ahead" if is_ahead else "doing"
            return f"skills::{asks}({', '.join([asked, *limits])})"
        case ir.Quantity(parameter=parameter, property=asked_property, is_boolean=is_boolean):
            named = (parameter,) if asked_property is None else (parameter, asked_property)
            number = f"skills::quantity({asked}, {_texts(named)})"
            return f"skills::boolean({number})" if is_boolean else number


def _texts(texts: Sequence[str]) -> str:
    return ", ".join(map(c99_names.string, texts))


def _reader(kind: ir.FieldKind) -> str:
    """The C++ function that converts a field to a number."""
    return "text_index" if kind is ir.FieldKind.TEXT else "number"


def _element_place(element: int | ir.ByName | ir.Listed, whole: str) -> str:
    """The place of an element of the array `whole`."""
    match element:
        case int():
            return str(element)
        case ir.ByName(key=key, names=path):
            return f"place_of({c99_names.string(key)}, message{names.member(path)}, {whole})"
        case ir.Listed(place=place, count=count):
            return f"place_among({place}, {count}, {whole})"


def commands(machine: ir.Machine, dialect: Dialect) -> str:
    """A struct for each command topic."""
    classes = names.command_classes(machine)
    return "".join(_command(machine, dialect, index, word) for index, word in enumerate(classes))


def sources(machine: ir.Machine) -> str:
    """A row for each source topic of commands."""
    topics = (unfiltered(command.topic) for command in machine.reactions.commands)
    return block(f"{names.relative(topic)}," for topic in topics)


def _command(machine: ir.Machine, dialect: Dialect, index: int, word: str) -> str:
    command = machine.reactions.commands[index]
    kind = dialect.cpp_type(command.message_type, RosInterface.MESSAGE)
    source = names.relative(unfiltered(command.topic))
    visits = [line for place, field in enumerate(command.fields) for line in _visit(place, field)]
    return (
        f"// {command.topic}: {command.message_type}\n"
        f"struct {word} {{\n"
        f"    using Message = {kind};\n"
        f"    static constexpr int index = {index};\n"
        f"    static constexpr std::size_t fields = {len(command.fields)};\n"
        f"    static constexpr const char *topic = {names.relative(command.topic)};\n"
        f"    static constexpr const char *source = {source};\n\n"
        f"    template <class Visit> static void each_number(Message &message, Visit visit)\n"
        f"    {{\n{indented(visits, 2)}\n    }}\n}};\n\n"
    )


def _visit(place: int, field: reactions.CommandField) -> Iterator[str]:
    number = f"message{names.member(field.path)}"
    if field.is_array:
        yield f"for (auto &number : {number})"
        yield f"    visit({place}, number);"
    else:
        yield f"visit({place}, {number});"
