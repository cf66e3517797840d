"""The canonical text: what it looks like, and that nothing is lost on the way to it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

from rossmarie.syntax import ast, format_module
from support.depth import examples

Accepted = Callable[[str], ast.Module]
WithoutSpans = Callable[[ast.Module], Any]

EXAMPLES = sorted((Path(__file__).parents[3] / "examples").rglob("*.ross"))

CASES = {
    "statements end in a semicolon": (
        'import "a.ross" const a=3m/s input i=topic /t:p/T.x in N timeout 0.2s action b',
        """\
import "a.ross";

const a = 3 m/s;

input i = topic /t : p/T .x in N timeout 0.2 s;

action b;
""",
    ),
    "the printed form of an input": ("input  f=topic W . force", "input f = topic W.force;\n"),
    "items of one kind stand together, with the empty lines of their author": (
        "action a;;\naction b;\n\n\n\naction c; const d = 1",
        "action a;\naction b;\n\naction c;\n\nconst d = 1;\n",
    ),
    "expressions": (
        "const a=-1+ - b*( c-d )/e . f( g,-2 )[ 0 ]\n"
        "const h=[-1 ,2]deg const i = - - 3 const j=f( )",
        "const a = -1 + -b * (c - d) / e.f(g, -2)[0];\n"
        "const h = [-1, 2] deg;\nconst i = --3;\nconst j = f();\n",
    ),
    "oscillates": (
        "if (a+b) . oscillates ( 3 times,within 1 s )or oscillates (a,3 times,within 1 s) then{c;}",
        "if (a + b).oscillates(3 times, within 1 s) or oscillates(a, 3 times, within 1 s)"
        " then { c; };\n",
    ),
    "the body of an action": (
        """action a{// head
limit /c:p/T{x . y in[-1,1]m;z[0] in r;}ramp 1 m/s,-2 Hz;// trailing
// own line
publish t{a=[1,2]m;b . c="d";}at 2Hz;set n . p . q in m/s to-1 m/s within 1s else b;


switch /m{stop a,b;start c;};cancel/s confirm by x<1 within 1s then drop else b;
call s;reset;}latched until reset""",
        """\
action a {  // head
    limit /c : p/T { x.y in [-1, 1] m; z[0] in r; } ramp 1 m/s, -2 Hz;  // trailing
    // own line
    publish t { a = [1, 2] m; b.c = "d"; } at 2 Hz;
    set n.p.q in m/s to -1 m/s within 1 s else b;

    switch /m { stop a, b; start c; };
    cancel /s confirm by x < 1 within 1 s then drop else b;
    call s;
    reset;
} latched until reset;
""",
    ),
    "a long effect": (
        "action a { send p/Goal { first_field = 1; second_field = 2; third_field = 3; } to /server "
        "within 10 sec then resend else stop; }",
        """\
action a {
    send p/Goal {
        first_field = 1;
        second_field = 2;
        third_field = 3;
    } to /server within 10 sec then resend else stop;
}
""",
    ),
    "steps and priorities": (
        "rule r:if a then{b;also c else d;also;}priority r over s  over t",
        "rule r: if a then { b; also c else d; also; };\n\npriority r over s over t;\n",
    ),
    "actions named as words": (
        "if a then{else;also also;else else also;also else else;also also else else;}",
        "if a then { else; also also; else else also; also else else; also also else else; };\n",
    ),
    "categories": (
        "rule r:if a then{b;}clear for 1 s category  human task  dependent feedback 1 per s",
        "rule r: if a then { b; } clear for 1 s category human task dependent feedback 1 per s;\n",
    ),
    "hazards, and rules that give way": (
        'hazard  H1 "x";hazard H2  "y"\n'
        "rule r:if a  unless s,t then{b;}clear for 1 s mitigates H1,H2",
        'hazard H1 "x";\nhazard H2 "y";\n\n'
        "rule r: if a unless s, t then { b; } clear for 1 s mitigates H1, H2;\n",
    ),
    "conditions over time": (
        "if once   a>1 within 1s and not after x , y since(z) within 2 s then{b;}"
        "if after norm(imu.angular_velocity)>1 rad/s and stopped.now, norm(imu.angular_velocity)"
        "<0.1 rad/s within 2 sec then{b;}",
        """\
if once a > 1 within 1 s and not after x, y since (z) within 2 s then { b; };

if after norm(imu.angular_velocity) > 1 rad/s and stopped.now,
        norm(imu.angular_velocity) < 0.1 rad/s within 2 sec
    then { b; };
""",
    ),
    "resources": (
        "system s{topic a:p/T;resource  base:a,/b , /c/d;}",
        "system s {\n    topic a : p/T;\n\n    resource base : a, /b, /c/d;\n}\n",
    ),
    "a test": (
        """test "a  b"{every 0.1s from 0s to 5 s x,y . z[ 0 ]=-3 m;// trailing

at 1s reset ;at 2 s reset r;expect r  active at 3s;
expect r inactive from 0s until(a+b);}const c=1""",
        """\
test "a  b" {
    every 0.1 s from 0 s to 5 s x, y.z[0] = -3 m;  // trailing

    at 1 s reset;
    at 2 s reset r;
    expect r active at 3 s;
    expect r inactive from 0 s until (a + b);
}

const c = 1;
""",
    ),
    "an entity": (
        "entity e{a:b for 2 s;\n\n\nc : not d   in[1,2]m ;}if e.a then{x;y;}",
        """\
entity e {
    a : b for 2 s;

    c : not d in [1, 2] m;
}

if e.a then { x; y; };
""",
    ),
    "words before parentheses": (
        "entity e{a:not(b)and(c)for(d)or f (g)>min( 1,2 )or-(x)in(h);}",
        "entity e {\n    a : not (b) and (c) for (d) or f(g) > min(1, 2) or -(x) in (h);\n}\n",
    ),
    "a system": (
        'system s{messages "m";topic /t:p/T;topic A=/b:p/U in rad/s;node n{publishes /t;subscribes'
        " /a,B;};unit p/T . x=m;}",
        """\
system s {
    messages "m";

    topic /t : p/T;
    topic A = /b : p/U in rad/s;

    node n { publishes /t; subscribes /a, B; }

    unit p/T.x = m;
}
""",
    ),
    "a long rule": (
        "rule r:if first_entity.first_condition and second_entity.second_condition then "
        "{ first_action; second_action; } clear for 2 sec",
        """\
rule r: if first_entity.first_condition and second_entity.second_condition
    then { first_action; second_action; }
    clear for 2 sec;
""",
    ),
    "a longer rule": (
        "if first_entity.first_condition and second_entity.second_condition or third_entity"
        ".third_condition_of_all then { first_action_with_a_long_name; "
        "second_action_with_a_long_name; third_action_with_a_long_name; } "
        "clear when first_entity.last_condition",
        """\
if first_entity.first_condition
        and second_entity.second_condition
        or third_entity.third_condition_of_all
    then {
        first_action_with_a_long_name;
        second_action_with_a_long_name;
        third_action_with_a_long_name;
    }
    clear when first_entity.last_condition;
""",
    ),
    "a long condition": (
        "entity e{a:(first_entity.first_condition and second_entity.second_condition)or("
        "third_entity.third_condition and not(fourth_entity.fourth_condition or fifth_entity"
        ".condition))"
        "for 2 sec;b:norm(first_imu.angular_velocity)+norm(second_imu.angular_velocity)*gain_of_the"
        "_second-offset_of_the_second>limit;c:any(ranges_of_the_front_laser<first_limit_of_laser"
        " and ranges_of_the_front_laser>second_limit_of_the_laser);}",
        """\
entity e {
    a : (first_entity.first_condition and second_entity.second_condition)
            or (third_entity.third_condition
                and not (fourth_entity.fourth_condition or fifth_entity.condition)) for 2 sec;
    b : norm(first_imu.angular_velocity) + norm(second_imu.angular_velocity) * gain_of_the_second
            - offset_of_the_second > limit;
    c : any(ranges_of_the_front_laser < first_limit_of_laser
            and ranges_of_the_front_laser > second_limit_of_the_laser);
}
""",
    ),
    "long lists": (
        "priority first_rule_with_a_long_name over second_rule_with_a_long_name over "
        "third_rule_with_a_long_name;system s{resource base:/first_topic_of_the_base,"
        "/second_topic_of_the_base,/third_topic_of_base,/fourth;}",
        """\
priority first_rule_with_a_long_name over second_rule_with_a_long_name
        over third_rule_with_a_long_name;

system s {
    resource base : /first_topic_of_the_base, /second_topic_of_the_base, /third_topic_of_base,
            /fourth;
}
""",
    ),
    "comments stay beside what they belong to": (
        """\
// the file


// a limit
const a = 3 // trailing
// below
entity e { // entity
    // first
    a : b; // is b

    // last
}
// the end""",
        """\
// the file

// a limit
const a = 3;  // trailing

// below
entity e {  // entity
    // first
    a : b;  // is b

    // last
}
// the end
""",
    ),
    "comments inside statements": (
        "entity e { a : b // one\n and // two\n // three\n c // four\n ; // five\n}",
        """\
entity e {
    a : b  // one
            and  // two
            // three
            c;  // four
    // five
}
""",
    ),
    "documentation": (
        "'''one line'''entity e{'''  two\n      lines\n        here  '''a:b;'''loose'''}",
        """\
'''one line'''
entity e {
    '''
    two
    lines
      here
    '''
    a : b;
    '''loose'''
}
""",
    ),
    "documentation that ends in a quotation mark": (
        "'''it's 'fine' '''const a = 1",
        "'''it's 'fine' '''\nconst a = 1;\n",
    ),
    "a behavior tree": (
        "action a{tree Go within 2 s;tree Drive ( Target :doing Drive . Target,Speed:-0.2 )within "
        "20 sec then resume else b;} rule r: if ahead  Drive( Target :Room )then{a;}",
        """\
action a {
    tree Go within 2 s;
    tree Drive(Target: doing Drive.Target, Speed: -0.2) within 20 sec then resume else b;
}

rule r: if ahead Drive(Target: Room) then { a; };
""",
    ),
    "a long behavior tree": (
        "action a { tree GiveWay(Robot: doing Drive.Robot, Start: doing Drive.Start, Seconds: 8) "
        "within 60 sec then replan else stop; }",
        """\
action a {
    tree GiveWay(
        Robot: doing Drive.Robot,
        Start: doing Drive.Start,
        Seconds: 8
    ) within 60 sec then replan else stop;
}
""",
    ),
    "documentation in front of a semicolon documents nothing": (
        "const a = 1 '''stray\nwords''' ; const b = 2",
        "const a = 1;\n// stray\n// words\nconst b = 2;\n",
    ),
    "nothing": (" \n\n ", ""),
    "only a comment": ("\n\n//  hm  \n\n", "//  hm\n"),
}


@pytest.mark.parametrize("name", CASES)
def test_the_canonical_text(accepted: Accepted, without_spans: WithoutSpans, name: str) -> None:
    text, expected = CASES[name]
    assert format_module(accepted(text)) == expected
    assert without_spans(accepted(expected)) == without_spans(accepted(text))


@pytest.mark.parametrize("name", CASES)
def test_canonical_text_stays_as_it_is(accepted: Accepted, name: str) -> None:
    expected = CASES[name][1]
    assert format_module(accepted(expected)) == expected


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.name)
def test_examples_keep_their_meaning(
    accepted: Accepted, without_spans: WithoutSpans, path: Path
) -> None:
    module = accepted(path.read_text(encoding="utf-8"))
    text = format_module(module)
    again = accepted(text)
    assert without_spans(again) == without_spans(module)
    assert format_module(again) == text
    lines = [line for line in text.split("\n") if not line.startswith('test "')]
    assert max(map(len, lines)) <= 100


def longer(inner: SearchStrategy[str]) -> SearchStrategy[str]:
    """Larger expressions of smaller ones."""
    signs = st.sampled_from(("and", "or", "+", "*", ">", "in"))
    return st.one_of(
        st.builds("({} {} {})".format, inner, signs, inner),
        st.builds("function_of_three({}, {}, {})".format, inner, inner, inner),
        st.builds("(not ({}))".format, inner),
        st.builds("any({} < {})".format, inner, inner),
    )


NAMES = st.integers(5, 30).map(lambda size: "n" * size)


@settings(max_examples=examples(1))
@given(expression=st.recursive(NAMES, longer, max_leaves=20))
def test_no_line_is_too_long(
    accepted: Accepted, without_spans: WithoutSpans, expression: str
) -> None:
    text = f"entity e {{ a : {expression} for 2 sec; }} rule r: if {expression} then {{ b; }};"
    module = accepted(text)
    formatted = format_module(module)
    widths = [len(line) for line in formatted.split("\n") if len(line.split()) > 2]
    assert max(widths) <= 100
    assert without_spans(accepted(formatted)) == without_spans(module)
    assert format_module(accepted(formatted)) == formatted


def test_windows_line_ends_become_plain(accepted: Accepted) -> None:
    text = "const a = 1 // one\r\n\r\n'''two\r\nlines'''\r\nconst b = 2\r\n"
    plain = format_module(accepted(text.replace("\r", "")))
    assert format_module(accepted(text)) == plain
    assert "\r" not in plain
