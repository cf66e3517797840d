"""The syntax trees of correct texts."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from rossmarie.syntax import ast, children

Accepted = Callable[[str], ast.Module]


def expression_of(accepted: Accepted, text: str) -> ast.Expression:
    entity = accepted(f"entity e {{ c : {text}; }}").items[0]
    assert isinstance(entity, ast.Entity)
    return entity.conditions[0].expression


OVER_TIME = {ast.Held: "for", ast.Since: "since", ast.Once: "once", ast.Response: "after"}


def chosen(node: ast.Index | ast.Sector) -> str:
    """The index in brackets behind a value."""
    value = shape(node.value)
    if isinstance(node, ast.Index):
        return f"{value}[{node.index}]"
    return f"{value}[{shape(node.arc.first)} .. {shape(node.arc.last)}]"


def shape(node: ast.Expression) -> str:
    """An expression with every operator in parentheses."""
    inside = " ".join(shape(child) for child in children(node))
    match node:
        case ast.Bracket(unit=unit):
            return f"[{inside}]{unit.text if unit else ''}"
        case ast.Member(member=member):
            return f"{inside}.{member.text}"
        case ast.Index() | ast.Sector():
            return chosen(node)
        case ast.Call(function=function, is_method=is_method):
            return f"{'.' if is_method else ''}{function.text}({inside})"
        case ast.Unary(operator=operator) | ast.Binary(operator=operator):
            return f"({operator.value} {inside})"
        case ast.Membership(is_negated=is_negated):
            return f"({'not in' if is_negated else 'in'} {inside})"
        case ast.Held() | ast.Since() | ast.Once() | ast.Response():
            return f"({OVER_TIME[type(node)]} {inside})"
        case ast.Parenthesized():
            return f"<{inside}>"
        case ast.Edges() | ast.Oscillates():
            return f"{type(node).__name__}({inside})"
        case ast.ListFold(function=function, variable=variable):
            return f"{function.text}({variable.text} in {inside})"
        case (
            ast.Number() | ast.Boolean() | ast.Text() | ast.Reference() | ast.Doing()
            | ast.Broken()
        ):  # fmt: skip
            return leaf(node)


def leaf(
    node: ast.Number | ast.Boolean | ast.Text | ast.Reference | ast.Doing | ast.Broken,
) -> str:
    match node:
        case ast.Doing(skill=skill, arguments=arguments):
            limits = (f"{each.parameter.text}: {each.kind.text}" for each in arguments)
            return f"doing {skill.text}({', '.join(limits)})"
        case ast.Number(value=value, unit=unit):
            return f"{value:g}{unit.text if unit else ''}"
        case ast.Boolean(value=value):
            return str(value).lower()
        case ast.Text(value=value):
            return repr(value)
        case ast.Reference(name=name):
            return name.text
        case ast.Broken():
            return "?"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a or b and c or d", "(or (or a (and b c)) d)"),
        ("not a and b", "(and (not a) b)"),
        ("not x for 2 sec", "(for (not x) 2sec)"),
        ("not doing A and b", "(and (not doing A()) b)"),
        ("doing A since doing B for 2 sec", "(for (since doing A() doing B()) 2sec)"),
        ("doing A(X: n.C, Y : D) or doing", "(or doing A(X: n.C, Y: D) doing)"),
        ("doing since b and within", "(and (since doing b) within)"),
        ("doing since", "doing since()"),
        ("doing.x > doing", "(> doing.x doing)"),
        ("once doing A within 2 sec", "(once doing A() 2sec)"),
        ("after doing A, doing in x within 2 sec", "(after doing A() (in doing x) 2sec)"),
        ("a for 2 sec and b", "(and (for a 2sec) b)"),
        ("a and b for 2 sec", "(and a (for b 2sec))"),
        ("(a and b) for 2 sec", "(for <(and a b)> 2sec)"),
        ("a for 1 s for 2 s", "(for (for a 1s) 2s)"),
        ("a since b for 2 sec", "(for (since a b) 2sec)"),
        ("a for 2 sec since b since not c", "(since (since (for a 2sec) b) (not c))"),
        ("not a since b and c", "(and (since (not a) b) c)"),
        ("once a > 2 within 2 sec or b", "(or (once (> a 2) 2sec) b)"),
        ("not once not a within 2 sec", "(not (once (not a) 2sec))"),
        ("once once a within 1 s within 2 s", "(once (once a 1s) 2s)"),
        ("not after a or b, c and d within 2 sec", "(not (after (or a b) (and c d) 2sec))"),
        ("after a, after b, c within 1 s within 2 s", "(after a (after b c 1s) 2s)"),
        ("a since after b, c within 1 s", "(since a (after b c 1s))"),
        ("once and after or not since", "(or (and once after) (not since))"),
        ("after.since since once.within", "(since after.since once.within)"),
        ("once > 2 or after[1] < since", "(or (> once 2) (< after[1] since))"),
        ("once once within 1 s", "(once once 1s)"),
        ("once since since", "(since once since)"),
        ("after after, after within 1 s", "(after after after 1s)"),
        ("not a < b", "(not (< a b))"),
        ("a + b * c - d / e", "(- (+ a (* b c)) (/ d e))"),
        ("a - b - c", "(- (- a b) c)"),
        ("-a * b", "(* (- a) b)"),
        ("a - -3 m > -b", "(> (- a -3m) (- b))"),
        ("- - 3", "(- -3)"),
        ("a not in [-10, 10] deg", "(not in a [-10 10]deg)"),
        ("p in zone or q not in zone", "(or (in p zone) (not in q zone))"),
        ("a.b.c[3].d()", ".d(a.b.c[3])"),
        ("norm(v) >= max(a, 3 m)", "(>= norm(v) max(a 3m))"),
        ("q.pitch().x", ".pitch(q).x"),
        ("f()", "f()"),
        ('state == "a // b \\ c"', "(== state 'a // b \\\\ c')"),
        ("true and not false", "(and true (not false))"),
        ("any(scan.ranges < 0.5 m)", "any((< scan.ranges 0.5m))"),
        ("count(edges of a > 1 within 2 sec)", "count(Edges((> a 1) 2sec))"),
        ("oscillates(x, 3 times, within 0.25 sec)", "Oscillates(x 3 0.25sec)"),
        ("oscillates(x, 3 times, within w, by 5 N)", "Oscillates(x 3 w 5N)"),
        ("x.oscillates(3 times, within w, by 5 N)", "Oscillates(x 3 w 5N)"),
        ("5 m / t > 3", "(> (/ 5m t) 3)"),
        ("x > 3 m/s^2", "(> x 3m/s^2)"),
        ("x > 3kgm.m", "(> x 3kgm.m)"),
        ("x > 3 N*m", "(> x 3N*m)"),
        ("x > 3 m^-2", "(> x 3m^-2)"),
        ("x > 3 % or x > 4 °C or x > 5 µm", "(or (or (> x 3%) (> x 4°C)) (> x 5µm))"),
        ("x > 1.5e-3", "(> x 0.0015)"),
        ("x > 1e3 V", "(> x 1000V)"),
    ],
)
def test_precedence_and_units(accepted: Accepted, text: str, expected: str) -> None:
    assert shape(expression_of(accepted, text)) == expected


@pytest.mark.parametrize("field", ["in", "for", "rule", "if", "unit", "reset", "import", "true"])
def test_a_field_may_have_any_name(accepted: Accepted, field: str) -> None:
    assert (
        shape(expression_of(accepted, f"a.{field}.{field}() > 3")) == f"(> .{field}(a.{field}) 3)"
    )


@pytest.mark.parametrize("word", ["unit", "reset", "clear", "node", "times", "messages", "latched"])
def test_most_keywords_are_names_elsewhere(accepted: Accepted, word: str) -> None:
    module = accepted(
        f"action {word}; const x = 3 entity {word} {{ {word} : {word} > 3 m and x > {word}; }}"
        f" rule {word}: if {word}.{word} then {{ {word}; {word}; }} clear when {word}.{word}"
    )
    assert [type(item) for item in module.items] == [
        ast.Action,
        ast.Constant,
        ast.Entity,
        ast.Rule,
    ]


def test_all_items(accepted: Accepted) -> None:
    module = accepted(
        'import "a.ross" system s {} action a; const c = 3 entity e {}\n'
        "input i = topic /t : p/T rule r: if a then {} ; if b then { c; };;"
    )
    assert [type(item).__name__ for item in module.items] == [
        "Import",
        "System",
        "Action",
        "Constant",
        "Entity",
        "Input",
        "Rule",
        "Rule",
    ]


def test_an_input_has_all_its_parts(accepted: Accepted) -> None:
    text = "input p = topic /imu/data : sensor_msgs/msg/Imu .a.in.b in rad/s timeout 0.2 sec"
    (item,) = accepted(text).items
    assert isinstance(item, ast.Input)
    assert item.message_type is not None
    assert item.unit is not None
    assert isinstance(item.timeout, ast.Number)
    assert (item.name.text, item.topic.text) == ("p", "/imu/data")
    assert item.message_type.text == "sensor_msgs/Imu"
    assert item.message_type.span.text == "sensor_msgs/msg/Imu"
    assert [name.text for name in item.path] == ["a", "in", "b"]
    assert item.unit.text == "rad/s"
    assert item.timeout.span.text == "0.2 sec"


@pytest.mark.parametrize(
    "text", ["input f = topic Wrench.force", "input f = topic Wrench . force;"]
)
def test_the_printed_form_of_an_input(accepted: Accepted, text: str) -> None:
    (item,) = accepted(text).items
    assert isinstance(item, ast.Input)
    assert (item.topic.text, item.message_type, item.timeout) == ("Wrench", None, None)
    assert [name.text for name in item.path] == ["force"]


def test_a_system_has_all_its_members(accepted: Accepted) -> None:
    (system,) = accepted(
        """system husky {
            messages "msg";
            topic /imu/data : sensor_msgs/Imu;
            topic Wrench = /ft/wrench : geometry_msgs/Wrench in N;
            topic plain : std_msgs/Bool;
            node planner { publishes /cmd_vel; subscribes /odom, Wrench; publishes /plan; }
            node idle {};
            unit my_msgs/Wheel.speed.left = rad/s;
        }"""
    ).items
    assert isinstance(system, ast.System)
    messages, imu, wrench, plain, planner, idle, unit = system.members
    assert isinstance(messages, ast.MessagesDeclaration)
    assert messages.path.value == "msg"
    assert isinstance(imu, ast.TopicDeclaration)
    assert (imu.alias, imu.topic.text, imu.unit) == (None, "/imu/data", None)
    assert isinstance(wrench, ast.TopicDeclaration)
    assert wrench.alias is not None
    assert wrench.unit is not None
    assert (wrench.alias.text, wrench.topic.text) == ("Wrench", "/ft/wrench")
    assert (wrench.message_type.text, wrench.unit.text) == ("geometry_msgs/Wrench", "N")
    assert isinstance(plain, ast.TopicDeclaration)
    assert plain.topic.text == "plain"
    assert isinstance(planner, ast.NodeDeclaration)
    assert [name.text for name in planner.publishes] == ["/cmd_vel", "/plan"]
    assert [name.text for name in planner.subscribes] == ["/odom", "Wrench"]
    assert isinstance(idle, ast.NodeDeclaration)
    assert (idle.publishes, idle.subscribes) == ((), ())
    assert isinstance(unit, ast.UnitDeclaration)
    assert [name.text for name in unit.path] == ["speed", "left"]
    assert unit.unit.text == "rad/s"


def test_a_rule_has_all_its_contracts(accepted: Accepted) -> None:
    (rule,) = accepted(
        "rule r: if a then { x; y; } clear when b and c clear for 2.0 sec latched until reset"
    ).items
    assert isinstance(rule, ast.Rule)
    assert rule.name is not None
    assert rule.name.text == "r"
    assert [action.text for action in rule.actions] == ["x", "y"]
    when, hold, latched = rule.contracts
    assert isinstance(when, ast.ClearWhen)
    assert shape(when.condition) == "(and b c)"
    assert isinstance(hold, ast.ClearFor)
    assert shape(hold.duration) == "2sec"
    assert isinstance(latched, ast.LatchedUntilReset)


def test_documentation_belongs_to_what_follows(accepted: Accepted) -> None:
    module = accepted(
        """
        ''' only a comment '''
        ''' the first
              rule ''' // not in between
        rule a: if x '''nothing''' then { y; }
        const c = 3 '''the entity''' entity e {
            '''one''' one : x; two : '''nothing''' x;
            '''three''' three : x;
            '''nothing'''
        }
        action plain;
        '''nothing'''
        """
    )
    rule, constant, entity, action = module.items
    assert isinstance(rule, ast.Rule)
    assert rule.documentation == "the first\nrule"
    assert isinstance(constant, ast.Constant)
    assert constant.documentation is None
    assert isinstance(entity, ast.Entity)
    assert entity.documentation == "the entity"
    documentation = [condition.documentation for condition in entity.conditions]
    assert documentation == ["one", None, "three"]
    assert isinstance(action, ast.Action)
    assert action.documentation is None


def test_an_empty_file_is_fine(accepted: Accepted) -> None:
    for text in ("", "\ufeff", " \n\t\r\n", "// nothing", "'''nothing'''", ";;"):
        assert accepted(text).items == ()


def test_spans_are_exact(accepted: Accepted) -> None:
    text = (
        "// first line\n"
        "entity imu {  steep : abs( tilt . x )  >  -20.5   deg/s  for 4 sec ; } ;\n"
        "rule r : if imu.steep then { stop ; } clear for 2 sec ;"
    )
    entity, rule = accepted(text).items
    assert isinstance(entity, ast.Entity)
    assert entity.span.text.startswith("entity imu")
    assert entity.span.text.endswith("}")
    (steep,) = entity.conditions
    assert steep.span.text == "steep : abs( tilt . x )  >  -20.5   deg/s  for 4 sec"
    assert steep.name.span.text == "steep"
    held = steep.expression
    assert isinstance(held, ast.Held)
    assert held.span.text == "abs( tilt . x )  >  -20.5   deg/s  for 4 sec"
    comparison = held.condition
    assert isinstance(comparison, ast.Binary)
    assert comparison.span.text == "abs( tilt . x )  >  -20.5   deg/s"
    assert isinstance(comparison.right, ast.Number)
    assert comparison.right.span.text == "-20.5   deg/s"
    assert comparison.right.unit is not None
    assert comparison.right.unit.span.text == "deg/s"
    call = comparison.left
    assert isinstance(call, ast.Call)
    assert (call.function.span.text, call.span.text) == ("abs", "abs( tilt . x )")
    assert call.arguments[0].span.text == "tilt . x"
    assert isinstance(rule, ast.Rule)
    assert rule.span.text == "rule r : if imu.steep then { stop ; } clear for 2 sec"
    assert rule.contracts[0].span.text == "clear for 2 sec"
    assert (steep.span.begin.line, rule.span.begin.line) == (2, 3)


def test_comments_are_white_space_and_quotes_hide_them(accepted: Accepted) -> None:
    module = accepted('const a = // = 4\n 3 const b = "// no" // "')
    first, second = module.items
    assert isinstance(first, ast.Constant)
    assert isinstance(second, ast.Constant)
    assert shape(first.value) == "3"
    assert shape(second.value) == "'// no'"


@pytest.mark.parametrize(
    "text",
    [
        "input a = topic /t\n: p/T\n.x\nin m\ntimeout d",
        "input a\n=\ntopic\nb\n.c",
        "rule\nr\n:\nif\na\nand\nb\nthen\n{\nc\n;\n}\nclear\nwhen\nd\nlatched\nuntil\nreset",
        "const\na\n=\nb\n+\nc",
    ],
)
def test_lines_may_be_broken_anywhere(accepted: Accepted, text: str) -> None:
    assert len(accepted(f"action x\n{text}\naction y").items) == 3


def test_an_item_may_end_with_a_field_of_any_name(accepted: Accepted) -> None:
    text = "input a = topic /t.in action b const c = d.rule action e"
    assert len(accepted(text).items) == 4


@pytest.mark.parametrize("end", ["= topic /t.\nrule", "= topic /t timeout 3\nm"])
def test_the_next_item_may_begin_behind_the_end_of_a_broken_line(
    accepted: Accepted, end: str
) -> None:
    assert len(accepted(f'input a {end} import "a.ross"').items) == 2


def test_a_unit_may_stand_on_the_next_line(accepted: Accepted) -> None:
    (constant,) = accepted("const a = 3\n    m/s // slow\n").items
    assert isinstance(constant, ast.Constant)
    assert shape(constant.value) == "3m/s"
