"""Actions: what holds for any number of them, and what a suggestion says."""

from __future__ import annotations

import pytest

from dslkit.diagnostics import Diagnostic
from support.effort import calls_of
from support.programs import check_text, errors_of

SPEED = "input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec\n"
USE = "rule r: if speed > 1 m/s then { a0; };\n"


def found_in(text: str) -> Diagnostic:
    """The only finding on a text."""
    _, (found,) = check_text(SPEED + text)
    return found


def test_plans_that_double_with_each_action_are_refused_at_once() -> None:
    calls = "".join(
        f"action a{n} {{ call /x : std_srvs/Trigger else a{n + 1}; "
        f"call /y : std_srvs/Trigger else a{n + 1}; }}\n"
        for n in range(100)
    )
    text = f"{SPEED}{calls}action a100;\n{USE}"
    assert errors_of(text) == [("ROSS420", "r")]  # a look at all 2^100 would not end


def test_long_chains_of_escalations_are_lowered() -> None:
    calls = "".join(
        f"action a{n} {{ call /x : std_srvs/Trigger else a{n + 1}; }}\n" for n in range(2000)
    )
    assert errors_of(f"{SPEED}{calls}action a2000;\n{USE}") == []


def with_one_resource(count: int) -> str:
    """So many rules that need the same, in an order."""
    rules = "".join(
        f"action a{n} {{ set /n.p to {n}; }}\nrule r{n}: if speed > 1 m/s then {{ a{n}; }};\n"
        for n in range(count)
    )
    order = " over ".join(f"r{n}" for n in range(count))
    return f"{SPEED}{rules}priority {order};\n"


def test_the_work_grows_with_the_rules_with_one_resource_and_no_faster() -> None:
    _, found = check_text(with_one_resource(2))  # what is done once is done by now
    assert found == ()
    few, many = (calls_of(check_text, with_one_resource(count)) for count in (100, 400))
    assert many < 5 * few


@pytest.mark.parametrize(
    ("text", "help"),
    [
        ('action a0 { log warn "x"; }', "did you mean `warning`?"),
        ('action a0 { log information "x"; }', "did you mean `info`?"),
        ('action a0 { log loud "x"; }', "write one of `debug`, `info`, `warning` and `error`"),
        ("action a0 { call /x : std_srvs/Triger; }", "did you mean `std_srvs/Trigger`?"),
        (
            "action a0 { call /x; }",
            "declare it in a system model, `service /x : PACKAGE/TYPE;`, or write "
            "`/x : PACKAGE/TYPE`",
        ),
        (
            "action a0 { publish /x : std_msgs/Float64 { data = 3 m; }; }",
            "leave the unit out (the number is sent unchanged), or declare the unit of the field "
            "in a system model: `unit PACKAGE/TYPE.data = m;`",
        ),
        (
            "action a0 { limit /x : geometry_msgs/Twist { angular in [-1, 1] rad/s; }; }",
            "bound `angular.x`, `angular.y`, `angular.z`",
        ),
    ],
)
def test_help(text: str, help: str) -> None:
    assert found_in(f"{text}\n{USE}").help == help


def test_what_could_not_be_read_may_say_the_type() -> None:
    text = "action a0 { limit /c : geometry_msgs/Twist { linear.x in ; }; block /c; }\n"
    assert errors_of(SPEED + text + USE) == [("ROSS016", "in")]


def test_the_types_that_a_system_model_gives_are_looked_up() -> None:
    text = "system s { service /a : p/Nope; server /b : p/Nope; }\n"
    assert errors_of(text) == [("ROSS118", "p/Nope"), ("ROSS118", "p/Nope")]


@pytest.mark.parametrize(
    ("again", "expected"),
    [("geometry_msgs/Twist", []), ("std_msgs/Bool", [("ROSS111", "std_msgs/Bool")])],
)
def test_a_type_that_a_system_model_gives_may_be_said_again(
    again: str, expected: list[tuple[str, str]]
) -> None:
    system = "system s { topic /cmd_vel : geometry_msgs/Twist; }\n"
    text = f"action a0 {{ block /cmd_vel : {again}; }}\n"
    assert errors_of(system + SPEED + text + USE) == expected


def test_names_in_broken_effects_count_as_used() -> None:
    text = "const pace = [-1, 1] m/s\naction a0 { limit /nope { x in pace; }; }\n"
    assert errors_of(SPEED + text + USE) == [("ROSS119", "/nope")]
    _, found = check_text(SPEED + text + USE)
    assert [one.code for one in found] == ["ROSS119"]


@pytest.mark.parametrize(
    "name", ["limit", "scale", "block", "publish", "log", "also", "to", "at", "set", "priority"]
)
def test_the_words_of_effects_are_free_as_names(name: str) -> None:
    text = f"action {name};\nrule over: if speed > 1 m/s then {{ {name}; }};\n"
    _, found = check_text(SPEED + text)
    assert found == ()
