"""One mistake, one finding; and all mistakes in one run."""

from __future__ import annotations

import pytest

from support.programs import check_text, errors_of

HEAD = """
action stop;
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 1 sec
"""


@pytest.mark.parametrize(
    "declaration",
    [
        "const limit = nowhere",
        "const limit = 3 nonsense",
        "const limit = 1 m/s / 0",
        "const limit = 3 m + 2 sec",
        "const limit = limit",
        "const limit = [1, 2, 3] m",
        "const limit = fnord(3)",
        "const limit = [2, 1] m/s",
        "input limit = topic /limit : no_msgs/Nothing timeout 1 sec",
        "input limit = topic /limit .value timeout 1 sec",
        "input limit = topic /odom : nav_msgs/Odometry .no.such.field timeout 1 sec",
        "input limit = topic /odom : nav_msgs/Odometry .pose.pose in m timeout 1 sec",
    ],
)
def test_what_rests_on_a_mistake_is_not_reported_again(declaration: str) -> None:
    uses = """
        entity drive {
            fast : speed > limit and any(limit.ranges[3] * 2 > limit + 3 sec);
            other : abs(limit) in limit or (not limit for limit);
            odd : oscillates(limit, 3 times, within limit, by limit) and norm(limit.x) > age(limit);
        }
        if drive.fast or drive.other or drive.odd then { stop; } clear for limit;
    """
    errors = errors_of(HEAD + declaration + uses)
    assert len(errors) == 1, errors


def test_all_mistakes_are_found_in_one_run() -> None:
    errors = errors_of(
        HEAD
        + """
        const limit = 3 N
        entity drive {
            fast : speed > limit;
            vague : sped > 3 m/s;
            number : speed;
        }
        if drive.fast or drive.vague or drive.nubmer then { stopp; };
        """
    )
    assert errors == [
        ("ROSS301", "limit"),
        ("ROSS101", "sped"),
        ("ROSS201", "speed"),
        ("ROSS103", "nubmer"),
        ("ROSS104", "stopp"),
    ]


def test_what_could_not_be_parsed_is_passed_over() -> None:
    broken = """
        const limit = 3 m/s +
        entity drive { fast : speed > limit > 3; slow : speed < limit; }
        if drive.fast or drive.slow then { stop; };
    """
    codes = {code for code, _ in errors_of(HEAD + broken)}
    assert codes
    assert all(code.startswith("ROSS0") for code in codes)


def test_unused_names_are_not_looked_for_where_parsing_failed() -> None:
    _, found = check_text(HEAD + "if stop > then { stop; };")
    assert not any(finding.code == "ROSS401" for finding in found)


def test_a_misspelt_use_is_not_an_unused_declaration_as_well() -> None:
    _, found = check_text(HEAD + "if spede > 3 m/s then { stop; };")
    assert [finding.code for finding in found] == ["ROSS101"]


@pytest.mark.parametrize(
    "mistake",
    [
        "topic /a std_msgs/Bool timeout 1 sec",
        "topic /a : std_msgs Bool timeout 1 sec",
        "topic /a : std_msgs/Bool time out 1 sec",
        "/a : std_msgs/Bool timeout 1 sec",
    ],
)
def test_an_input_that_could_not_be_parsed_lacks_no_timeout(mistake: str) -> None:
    _, found = check_text(f"action stop;\ninput a = {mistake}\nif a then {{ stop; }};")
    assert len(found) == 1, found
    assert found[0].code.startswith("ROSS0")
