"""The parts of a program that remain around its syntax errors."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from dslkit.diagnostics import Diagnostic
from rossmarie.syntax import ast

Parsed = Callable[[str], tuple[ast.Module, tuple[Diagnostic, ...]]]


def test_all_mistakes_of_a_file_are_found_at_once(parsed: Parsed) -> None:
    module, found = parsed(
        """
        const a = 3 @ 4
        const ok = 3
        entity e {
            one : a > ;
            two : a > ok;
            three : (a;
            four a > ok;
            five : a > ok
        }
        rule r: if e.two and and e.three then { x; y } claer for 2 sec;
        actoin z;
        """
    )
    assert [one.code for one in found] == [
        "ROSS002",
        "ROSS016",
        "ROSS007",
        "ROSS006",
        "ROSS006",
        "ROSS016",
        "ROSS006",
        "ROSS027",
        "ROSS005",
    ]
    entity = next(item for item in module.items if isinstance(item, ast.Entity))
    broken = {
        condition.name.text: isinstance(condition.expression, ast.Broken)
        for condition in entity.conditions
    }
    assert broken == {"one": True, "two": False, "three": True, "four": True, "five": False}
    rule = next(item for item in module.items if isinstance(item, ast.Rule))
    assert isinstance(rule.condition, ast.Broken)
    assert [action.text for action in rule.actions] == ["x", "y"]
    assert isinstance(module.items[-1], ast.Action)


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("const a = 3 +", ast.Constant),
        ("const a", ast.Constant),
        ("input a = topic", ast.Input),
        ("action a b", ast.Action),
        ("entity a { ? }", ast.Entity),
        ("system a { ? }", ast.System),
        ("rule a: if b > then { }", ast.Rule),
    ],
)
def test_a_readable_name_stays_declared(parsed: Parsed, text: str, kind: type[ast.Item]) -> None:
    module, found = parsed(f"'''about it''' {text}")
    assert len(found) == 1
    (item,) = module.items
    assert isinstance(item, kind)
    assert not isinstance(item, ast.Import | ast.Priority | ast.Skills | ast.Test)
    assert item.name is not None
    assert (item.name.text, item.documentation) == ("a", "about it")


def test_a_broken_input_has_a_topic_without_text(parsed: Parsed) -> None:
    ((item,), _) = parsed("input a = topic 3")[0].items, None
    assert isinstance(item, ast.Input)
    assert item.topic.text == ""


def test_a_broken_topic_is_known_to_exist(parsed: Parsed) -> None:
    module, found = parsed("system s { topic /imu/data = x; topic /odom : nav_msgs/Odometry; }")
    assert len(found) == 1
    (system,) = module.items
    assert isinstance(system, ast.System)
    first, second = system.members
    assert isinstance(first, ast.TopicDeclaration)
    assert isinstance(second, ast.TopicDeclaration)
    assert (first.topic.text, first.message_type.text) == ("/imu/data", "")
    assert second.message_type.text == "nav_msgs/Odometry"


def test_a_broken_import_still_imports(parsed: Parsed) -> None:
    for text in ("import husky.ross;", 'import "husky.ross;', 'import "husky.ross" x;'):
        (item,) = parsed(text)[0].items
        assert isinstance(item, ast.Import)
        assert item.path.value.startswith("husky.ross")


def test_an_open_brace_does_not_swallow_the_file(parsed: Parsed) -> None:
    items = (
        "entity a { x : y;",
        "system b { node n {",
        "if c then { d;",
        "action e { {",
        "entity f {",
    )
    module, found = parsed("\n".join([*items, "const last = 3"]))
    assert [one.code for one in found] == ["ROSS007"] * 5
    kinds = [ast.Entity, ast.System, ast.Rule, ast.Action, ast.Entity, ast.Constant]
    assert [type(item) for item in module.items] == kinds


def test_an_open_documentation_string_does_not_swallow_the_file(parsed: Parsed) -> None:
    module, found = parsed(
        "''' about a\nconst a = 3\n'''about b''' const b = 4\n'''about c''' const c = 5"
    )
    assert [(one.code, one.primary.span.start) for one in found] == [("ROSS004", 0)]
    constants = [item for item in module.items if isinstance(item, ast.Constant)]
    assert [(item.name.text, item.documentation) for item in constants] == [
        ("a", None),
        ("b", "about b"),
        ("c", "about c"),
    ]


def test_an_apostrophe_mark_in_prose_is_no_mistake(parsed: Parsed) -> None:
    _, found = parsed("''' it's\nrule number one ''' const a = 3 ''' trailing '''")
    assert found == ()


def test_foreign_spellings_are_understood(parsed: Parsed) -> None:
    module, found = parsed("entity e { a : b && !c || 1 < d <= 3; }")
    assert [one.code for one in found] == ["ROSS010", "ROSS010", "ROSS010", "ROSS011"]
    meant, _ = parsed("entity e { a : b and not c or 1 < d and d <= 3; }")
    for module_ in (module, meant):
        (entity,) = module_.items
        assert isinstance(entity, ast.Entity)
        root = entity.conditions[0].expression
        assert isinstance(root, ast.Binary)
        assert root.operator is ast.BinaryOperator.OR
        assert isinstance(root.right, ast.Binary)
        assert root.right.operator is ast.BinaryOperator.AND


def test_the_parts_of_a_rule_fail_one_by_one(parsed: Parsed) -> None:
    module, found = parsed(
        "rule if a b { c d; if; } clear when latched until reset clear for ; const x = 3"
    )
    assert {one.code for one in found} == {
        "ROSS015",
        "ROSS009",
        "ROSS018",
        "ROSS006",
        "ROSS014",
        "ROSS016",
    }
    rule = module.items[0]
    assert isinstance(rule, ast.Rule)
    assert [action.text for action in rule.actions] == ["c", "d"]
    assert [type(contract) for contract in rule.contracts] == [ast.LatchedUntilReset]
    assert isinstance(module.items[1], ast.Constant)


def test_lines_end_as_the_author_likes(parsed: Parsed) -> None:
    text = "entity a {\n  x : y > ;\n  z : w;\n}\nconst b = 3\n"
    _, unix = parsed(text)
    _, windows = parsed(text.replace("\n", "\r\n"))
    assert [one.title for one in unix] == [one.title for one in windows] != []


@pytest.mark.parametrize(
    "broken",
    [
        "limit /c { x in ; }",
        "fly /c",
        "limit /c { x in [-1, 1] m/s; y in z }",
        "publish /c { { }",
        "cancel",
        "log warning",
        "send { a = 1; to /s within 1 sec",
        "42",
    ],
)
def test_an_effect_that_cannot_be_read_costs_no_other(parsed: Parsed, broken: str) -> None:
    text = f"action a {{\nblock /c;\n{broken};\nhook b;\n}} latched until reset;\naction c;"
    module, found = parsed(text)
    assert len(found) == 1
    action, last = module.items
    assert isinstance(action, ast.Action)
    kinds = {type(effect) for effect in action.effects}
    assert {ast.Block, ast.Hook} <= kinds <= {ast.Block, ast.Hook, ast.Limit}
    assert action.latch is not None
    assert isinstance(last, ast.Action)


def test_steps_survive_what_is_wrong_around_them(parsed: Parsed) -> None:
    module, found = parsed("rule r: if > 3 then { a; also b else c d; also; }")
    assert [one.code for one in found] == ["ROSS016", "ROSS006"]
    (rule,) = module.items
    assert isinstance(rule, ast.Rule)
    steps = [(one.is_beside, one.action.text, one.otherwise) for one in rule.steps]
    assert [step[:2] for step in steps] == [
        (False, "a"),
        (True, "b"),
        (False, "d"),
        (False, "also"),
    ]
    assert steps[1][2] is not None
