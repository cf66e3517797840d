"""Each mistake has its own message, at its exact place, and a fix that mends it."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from dslkit.diagnostics import Diagnostic, apply_edits
from rossmarie.syntax import ast, errors

Parsed = Callable[[str], tuple[ast.Module, tuple[Diagnostic, ...]]]


def codes(found: tuple[Diagnostic, ...]) -> list[tuple[str, str]]:
    return [(one.code, one.primary.span.text) for one in found]


# The mistakes that have one obvious remedy: text, code, marked text, text after the fix.
FIXABLE = [
    ("entitty imu { }", "ROSS005", "entitty", "entity imu { }"),
    ("ruel r: if a then {}", "ROSS005", "ruel", "rule r: if a then {}"),
    ("constant a = 3", "ROSS005", "constant", "const a = 3"),
    ('improt "a.ross"', "ROSS005", "improt", 'import "a.ross"'),
    ("iff a then {}", "ROSS005", "iff", "if a then {}"),
    ("limit = 3", "ROSS005", "limit", "const limit = 3"),
    ("entity e { a : b }", "ROSS006", "b", "entity e { a : b; }"),
    ("entity e { a : b c : d; }", "ROSS006", "b", "entity e { a : b; c : d; }"),
    ("entity e { a : b And : d; }", "ROSS006", "b", "entity e { a : b; And : d; }"),
    ("entity e { a : b > 3\n m : d; }", "ROSS006", "3", "entity e { a : b > 3;\n m : d; }"),
    ("if a then { b }", "ROSS006", "b", "if a then { b; }"),
    ("if a then { b c; }", "ROSS006", "b", "if a then { b; c; }"),
    ("if a then { b, c; }", "ROSS006", ",", "if a then { b; c; }"),
    ("const a 3", "ROSS006", "a", "const a = 3"),
    ("const a : 3", "ROSS006", ":", "const a = 3"),
    ("const a == 3", "ROSS006", "==", "const a = 3"),
    ("input a topic /t", "ROSS006", "a", "input a = topic /t"),
    ("input a = /t", "ROSS006", "=", "input a = topic /t"),
    ("rule r if a then {}", "ROSS006", "r", "rule r: if a then {}"),
    ("rule r: a then {}", "ROSS006", ":", "rule r: if a then {}"),
    ("entity e a : b; }", "ROSS006", "e", "entity e { a : b; }"),
    ("system s { topic /t p/T; }", "ROSS006", "t", "system s { topic /t : p/T; }"),
    ("system s { topic /t : p/T }", "ROSS006", "T", "system s { topic /t : p/T; }"),
    ("entity e { a : (b or c; }", "ROSS007", "(", "entity e { a : (b or c); }"),
    ("const a = [1, 2", "ROSS007", "[", "const a = [1, 2]"),
    ("if a then { b;", "ROSS007", "{", "if a then { b; }"),
    ("if a then { b; clear for 2 s", "ROSS007", "{", "if a then { b; } clear for 2 s"),
    ("entity e { a : b;\nconst c = 3", "ROSS007", "{", "entity e { a : b;\n}\nconst c = 3"),
    ("system s { topic /t : p/T;", "ROSS007", "{", "system s { topic /t : p/T;\n}"),
    ("}", "ROSS008", "}", ""),
    ("entity e { a : b); }", "ROSS008", ")", "entity e { a : b; }"),
    ("if a { b; }", "ROSS009", "a", "if a then { b; }"),
    ("entity e { a : b && c; }", "ROSS010", "&&", "entity e { a : b and c; }"),
    ("entity e { a : b||c; }", "ROSS010", "||", "entity e { a : b or c; }"),
    ("entity e { a : !b; }", "ROSS010", "!", "entity e { a : not b; }"),
    ("entity e { a : b = 3; }", "ROSS010", "=", "entity e { a : b == 3; }"),
    ("entity e { a : b === 3; }", "ROSS010", "===", "entity e { a : b == 3; }"),
    ("entity e { a : b <> 3; }", "ROSS010", "<>", "entity e { a : b != 3; }"),
    ("entity e { a : b => 3; }", "ROSS010", "=>", "entity e { a : b >= 3; }"),
    ("entity e { a : b ≤ 3; }", "ROSS010", "≤", "entity e { a : b <= 3; }"),
    ("entity e { a : 1 < b < 3; }", "ROSS011", "<", "entity e { a : (1 < b and b < 3); }"),
    ("entity e { a : b == c == d; }", "ROSS011", "==", "entity e { a : (b == c and c == d); }"),
    ('const a = "b', "ROSS003", '"b', 'const a = "b"'),
    ('import "b;', "ROSS003", '"b;', 'import "b";'),
    ("import b.ross;", "ROSS018", "b.ross", 'import "b.ross";'),
    ("''' a\nconst b = 3", "ROSS004", "'''", "''' a'''\nconst b = 3"),
    ("action a { lmit /c { x in b; }; }", "ROSS028", "lmit", "action a { limit /c { x in b; }; }"),
    ("action a { block /c }", "ROSS006", "c", "action a { block /c; }"),
    ('test "a" { att 0 s b; }', "ROSS029", "att", 'test "a" { at 0 s b; }'),
    ('test "a" { at 0 s b }', "ROSS006", "b", 'test "a" { at 0 s b; }'),
    ('test "a" { at 0 s b\nat 1 s b; }', "ROSS006", "b", 'test "a" { at 0 s b;\nat 1 s b; }'),
    ('test "a" { at 0 s b;', "ROSS007", "{", 'test "a" { at 0 s b;\n}'),
    ("action a { block /c\nhook b; }", "ROSS006", "c", "action a { block /c;\nhook b; }"),
    ("action a { limit /c { x in b };}", "ROSS006", "b", "action a { limit /c { x in b; };}"),
    ("action a { block /c;", "ROSS007", "{", "action a { block /c;\n}"),
    ("rule r: if a then { b else c }", "ROSS006", "c", "rule r: if a then { b else c; }"),
    ("when a then { b; }", "ROSS005", "when", "if a then { b; }"),
    ("if a then { }\nwhen c then { d; }", "ROSS005", "when", "if a then { }\nif c then { d; }"),
    ("input a = topic /t p/T .f", "ROSS006", "t", "input a = topic /t : p/T .f"),
    ("input a = topic T p/T timeout 1 s", "ROSS006", "T", "input a = topic T : p/T timeout 1 s"),
    ("const a = .5 m", "ROSS023", ".5", "const a = 0.5 m"),
    ("const a = -.5e3 m", "ROSS023", ".5e3", "const a = -0.5e3 m"),
    ("const a = 1. m", "ROSS023", "1.", "const a = 1.0 m"),
    ("const a = 1.m", "ROSS023", "1.", "const a = 1.0 m"),
    ("const a = 1.", "ROSS023", "1.", "const a = 1.0"),
    ("const a = 1.e3", "ROSS023", "1.e3", "const a = 1.0e3"),
    ("const a = [.5, 1] m", "ROSS023", ".5", "const a = [0.5, 1] m"),
    ("const a = 1,5 m", "ROSS023", "1,5", "const a = 1.5 m"),
    ("if a > 1,5 m/s then { b; }", "ROSS023", "1,5", "if a > 1.5 m/s then { b; }"),
    ("if (a > 1,5 m/s) then { b; }", "ROSS023", "1,5", "if (a > 1.5 m/s) then { b; }"),
    ("if a then { } clear for .5 s", "ROSS023", ".5", "if a then { } clear for 0.5 s"),
    ("input a = topic /t timeout .5 s", "ROSS023", ".5", "input a = topic /t timeout 0.5 s"),
    ("Const a = 3", "ROSS024", "Const", "const a = 3"),
    ("if a THEN { b; }", "ROSS024", "THEN", "if a then { b; }"),
    ("rule r: IF a then { b; }", "ROSS024", "IF", "rule r: if a then { b; }"),
    ("if a > 1 AND b then { c; }", "ROSS024", "AND", "if a > 1 and b then { c; }"),
    ("if NOT a then { b; }", "ROSS024", "NOT", "if not a then { b; }"),
    ("if Not (a) then { b; }", "ROSS024", "Not", "if not (a) then { b; }"),
    ("if a Not in b then { c; }", "ROSS024", "Not", "if a not in b then { c; }"),
    ("if a FOR 3 s then { b; }", "ROSS024", "FOR", "if a for 3 s then { b; }"),
    ("if a then { b; } Clear for 3 s", "ROSS024", "Clear", "if a then { b; } clear for 3 s"),
    ("if a then { b; } clear When c", "ROSS024", "When", "if a then { b; } clear when c"),
    ("input a = Topic /t", "ROSS024", "Topic", "input a = topic /t"),
    ("input a = topic /t TIMEOUT 1 s", "ROSS024", "TIMEOUT", "input a = topic /t timeout 1 s"),
    ("system s { Topic /t : p/T; }", "ROSS024", "Topic", "system s { topic /t : p/T; }"),
    ("const a = 3 # no", "ROSS002", "#", "const a = 3 // no"),
    (
        "system s { node n { Publishes /t; } }",
        "ROSS024",
        "Publishes",
        "system s { node n { publishes /t; } }",
    ),
    ("/* a */", "ROSS025", "/* a */", "// a"),
    ("/* a\n * b */ action c;", "ROSS025", "/* a\n * b */", "// a\n// * b\n action c;"),
    ("action a; /* b", "ROSS025", "/* b", "action a; // b"),
    ("if /* a */ b then { c; }", "ROSS025", "/* a */", "if // a\n b then { c; }"),
]


@pytest.mark.parametrize(("text", "code", "marked", "mended"), FIXABLE)
def test_a_mistake_is_found_once_and_its_fix_mends_it(
    parsed: Parsed, text: str, code: str, marked: str, mended: str
) -> None:
    _, found = parsed(text)
    assert codes(found) == [(code, marked)]
    assert found[0].fix is not None
    fixed = apply_edits(text, found[0].fix.edits)
    assert fixed == mended
    assert parsed(fixed)[1] == ()


MISTAKES = [
    ("@", "ROSS002", "@"),
    ("const a = \0", "ROSS002", "\0"),
    ("const a = \ud800", "ROSS002", "\ud800"),
    ("const größe = 3", "ROSS002", "ö"),
    ("entity e { a : b ^ 2 > 3; }", "ROSS002", "^"),
    ("a : b > 3;", "ROSS005", "a"),
    ("topic /t : p/T;", "ROSS005", "topic"),
    ("then { }", "ROSS005", "then"),
    ("hello world", "ROSS005", "hello"),
    ("(3)", "ROSS018", "("),
    ("entity e { a : " + "(" * 65 + "b" + ")" * 65 + "; }", "ROSS012", "("),
    ("const input = 3", "ROSS014", "input"),
    ("entity e { rule : a; }", "ROSS014", "rule"),
    ("entity e { a : b > topic; }", "ROSS014", "topic"),
    ("if a then { const; }", "ROSS014", "const"),
    ("rule if: if a then { }", "ROSS014", "if"),
    ("const = 3", "ROSS015", "const"),
    ("const 3x = 3", "ROSS015", "const"),
    ("entity { a : b; }", "ROSS015", "entity"),
    ("rule: if a then { }", "ROSS015", "rule"),
    ("entity e { a : b > ; }", "ROSS016", ">"),
    ("entity e { a : ; }", "ROSS016", ":"),
    ("entity e { a : b and; }", "ROSS016", "and"),
    ("entity e { a : (b or ); }", "ROSS016", "or"),
    ("entity e { a : b > for 3 s; }", "ROSS016", ">"),
    ("entity e { a : () > 3; }", "ROSS016", ")"),
    ("const a =", "ROSS016", "="),
    ("if then { a; }", "ROSS016", "if"),
    ("const a", "ROSS017", "a"),
    ("entity e", "ROSS017", "e"),
    ("entity e { a : b c > 3; }", "ROSS018", "c"),
    ("entity e { a : b -> c; }", "ROSS018", "->"),
    ("entity e { a : b.(c); }", "ROSS018", "("),
    ("entity e { a : b[c + 1] > 3; }", "ROSS018", "]"),
    ("input a = topic /t : Imu", "ROSS018", "Imu"),
    ("if a then { } else { b; }", "ROSS018", "else"),
    ("const a = 1e999 m", "ROSS019", "1e999"),
    ("entity e { a : b[1.5] > 3; }", "ROSS019", "1.5"),
    ("entity e { a : b[9999999999] > 3; }", "ROSS019", "9999999999"),
    ("action a\nhello;", "ROSS005", "hello"),
    ("action a { fly /c; block /c; }", "ROSS028", "fly"),
    ("action a { log info b; }", "ROSS018", "b"),
    ('test "a" { expect b; }', "ROSS017", "b"),
    ('test "a" { at 0 s; }', "ROSS015", "s"),
    ('test "a" { every 1 s at 0 s b; }', "ROSS018", "at"),
    ('test "a" { 3; }', "ROSS018", "3"),
    ("action a { limit /c { x in ; }; }", "ROSS016", "in"),
    ("action a { publish /c { x y; }; }", "ROSS006", "x"),
    ("action a { reset; } latched until;", "ROSS017", "until"),
    ("rule r: if a then { b else; }", "ROSS015", "else"),
    ("priority a;", "ROSS017", "a"),
    ("hazard H1;", "ROSS017", "H1"),
    ('if a then { b; } mitigates "H1";', "ROSS015", "mitigates"),
    ("if a unless then { b; }", "ROSS015", "unless"),
    ("if a unless b, then { b; }", "ROSS015", ","),
    ("system s { resource base /a; }", "ROSS006", "base"),
    ("if a then { b; }\nelse { c; }", "ROSS005", "else"),
    ("entity e { a : not b in c > d; }", "ROSS011", ">"),
    ("entity e { a : b > 1 m/s == c; }", "ROSS011", "=="),
    ("const a = 1,000 m", "ROSS023", "1,000"),
    ("entity e { a : oscillates(b, 3); }", "ROSS021", "oscillates"),
    ("entity e { a : norm(b, 3 times); }", "ROSS021", "3 times"),
    ("entity e { a : b.c(within 3 s); }", "ROSS021", "within 3 s"),
]


@pytest.mark.parametrize(("text", "code", "marked"), MISTAKES)
def test_a_mistake_is_found_once(parsed: Parsed, text: str, code: str, marked: str) -> None:
    _, found = parsed(text)
    assert codes(found) == [(code, marked)]


def test_every_code_is_tested() -> None:
    tested = {code for _, code, *_ in (*FIXABLE, *MISTAKES)}
    elsewhere = {"ROSS001", "ROSS013", "ROSS022", "ROSS026", "ROSS027"}  # limits, hidden, habits
    assert tested | elsewhere == {found.code for found in errors.ALL}


@pytest.mark.parametrize(("text", "code", "marked"), [case[:3] for case in (*FIXABLE, *MISTAKES)])
def test_a_mistake_costs_nothing_around_it(
    parsed: Parsed, text: str, code: str, marked: str
) -> None:
    """Items before and behind a mistake are read as if it were not there."""
    module, found = parsed(f"const before = 3\n{text}\nconst behind = 4\naction last;\n")
    assert codes(found) == [(code, marked)]
    names = [item.name.text for item in module.items if isinstance(item, ast.Constant | ast.Action)]
    assert names[0] == "before"
    assert names[-2:] == ["behind", "last"]


def test_an_instant_without_a_unit_says_what_to_write(parsed: Parsed) -> None:
    _, (found,) = parsed('test "a" { at 0 speed = 1 m/s; }')
    assert found.code == "ROSS015"
    assert found.help == "a time needs a unit: write `at 0 sec speed`"


def test_capitals_are_reported_once_for_each_word(parsed: Parsed) -> None:
    text = (
        "ENTITY e { A : x AND NOT y FOR 3 sec; }\n"
        "RULE r: IF e.A OR OSCILLATES THEN { a; } LATCHED UNTIL RESET\n"
        "INPUT i = TOPIC /i : p/T IN m TIMEOUT 1 sec"
    )
    module, found = parsed(text)
    words = "ENTITY AND NOT FOR RULE IF OR THEN LATCHED UNTIL RESET INPUT TOPIC IN TIMEOUT"
    assert codes(found) == [("ROSS024", word) for word in words.split()]
    edits = [edit for one in found if one.fix is not None for edit in one.fix.edits]
    mended, nothing = parsed(apply_edits(text, edits))
    assert nothing == ()
    assert len(module.items) == len(mended.items) == 3


def test_names_may_look_like_keywords_in_capitals(parsed: Parsed) -> None:
    text = """
    const In = 3  const Then = [1, 2] m
    input Topic = topic And : p/Or .For.Not in In timeout Timeout
    entity Rule { If : Not > In and Clear.When; Not : If(Then, Within, By) for Times; }
    if If then { Then; Not; } clear when Until
    const last =
        Const
    if Rule
        or Entity then { Latched; }
    """
    assert parsed(text)[1] == ()


def test_commas_between_arguments_are_no_decimals(parsed: Parsed) -> None:
    for value in ("[1,5] m", "max(1,5)", "max([1,2],3,(4))", "[(1),2,f(3)]"):
        assert parsed(f"const a = {value}")[1] == ()


def test_what_stands_in_front_of_a_stray_word_is_kept(parsed: Parsed) -> None:
    module, _ = parsed("if a then { b; } clear for 2 s\nhello;\naction c\nhello")
    rule, action = module.items
    assert isinstance(rule, ast.Rule)
    assert len(rule.contracts) == 1
    assert isinstance(action, ast.Action)


def test_a_unit_may_stand_on_its_own_line(parsed: Parsed) -> None:
    assert parsed('const a = 3\nm import "b.ross" const c = [1, 2]\nm\nconst d = 3')[1] == ()


def test_a_value_with_a_name_is_meant_as_a_constant(parsed: Parsed) -> None:
    for text in ("limit = 3 m", "limit = 3 +"):
        (constant,) = parsed(text)[0].items
        assert isinstance(constant, ast.Constant)
        assert constant.name.text == "limit"


def test_messages_say_what_to_write(parsed: Parsed) -> None:
    (found,) = parsed("entity e { a : 0 < b < 3; }")[1]
    assert found.help == "write `0 < b and b < 3`"
    (found,) = parsed("entity e { a : 0 < b == c; }")[1]
    assert found.fix is None
    assert "joined by `and`" in (found.help or "")
    (found,) = parsed("const a = 1,000 m")[1]
    assert (
        found.help == "write `1.000` if the comma begins the decimals, "
        "or `1000` if the comma separates thousands"
    )
    (found,) = parsed("if a then { b; } \n else { c; }")[1]
    assert "no `else`" in (found.help or "")
    (found,) = parsed("entitty e { }")[1]
    assert found.help == "did you mean `entity`?"
    (found,) = parsed("const a = \x07")[1]
    assert found.title == "the control character U+0007 has no meaning here"
    (found,) = parsed("const größe = 3")[1]
    assert "U+00F6, latin small letter o with diaeresis" in found.title
    (found,) = parsed("entity e { a : b;\nconst c = 3")[1]
    assert [(label.span.text, label.text) for label in found.labels] == [
        ("const", "the next item begins here")
    ]
