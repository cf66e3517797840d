"""Any program gets an answer, and soon."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rossmarie.ir import verify
from rossmarie.lowering import lower
from support.depth import examples
from support.effort import takes_at_most
from support.programs import check_text

NAMES = st.sampled_from(["a", "b", "scan", "imu", "mode", "flag", "stop", "e", "c", "d", "ranges"])
LEAVES = st.one_of(
    NAMES,
    st.sampled_from(["1", "-2.5 m/s", "3 N", "2 sec", "10 degC", "true", '"x"', "5 nope", "1e300"]),
    st.sampled_from(
        ["[1, 2] m", "[2, 1]", "[1, 2, 3]", "[-1, 1, -1, 1, -1, 1] m", "imu.orientation"]
    ),
    st.sampled_from(
        ["scan.ranges", "imu.linear_acceleration", "scan.ranges[0]", "scan.scan_time", "e.c", "e.d"]
    ),
)
FUNCTIONS = st.sampled_from(
    (
        "abs",
        "norm",
        "min",
        "max",
        "any",
        "all",
        "count",
        "roll",
        "pitch",
        "yaw",
        "rate",
        "age",
        "nope",
    )
)
OPERATORS = st.sampled_from(
    ["+", "-", "*", "/", "<", "<=", ">", ">=", "==", "!=", "and", "or", "in", "not in"]
)


def _grown(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    return st.one_of(
        st.builds("({} {} {})".format, inner, OPERATORS, inner),
        st.builds("{}({})".format, FUNCTIONS, inner),
        st.builds("{}({}, {})".format, FUNCTIONS, inner, inner),
        st.builds("(not {})".format, inner),
        st.builds("(-{})".format, inner),
        st.builds("({} for {})".format, inner, inner),
        st.builds("({}).{}".format, inner, NAMES),
        st.builds("({})[1]".format, inner),
        st.builds("[{}, {}]".format, inner, inner),
        st.builds("(count(edges of {} within {}) > {})".format, inner, inner, inner),
        st.builds("changed({})".format, inner),
        st.builds("{}(edges of {} within {})".format, FUNCTIONS, inner, inner),
        st.builds("oscillates({}, 3 times, within {}, by {})".format, inner, inner, inner),
    )


EXPRESSIONS = st.recursive(LEAVES, _grown, max_leaves=8)


@settings(max_examples=examples(12))
@given(EXPRESSIONS, EXPRESSIONS, EXPRESSIONS, EXPRESSIONS)
def test_every_program_has_an_error_or_can_be_lowered(
    constant: str, timeout: str, condition: str, rule: str
) -> None:
    program, found = check_text(f"""
        action stop;
        const a = {constant}
        const b = 3 m
        input scan = topic /scan : sensor_msgs/LaserScan timeout {timeout}
        input imu = topic /imu : sensor_msgs/Imu
        input mode = topic /mode : std_msgs/String
        input flag = topic /flag : std_msgs/Bool
        entity e {{ c : {condition}; d : flag; }}
        if {rule} then {{ stop; }} clear when {condition};
    """)
    has_errors = any(finding.severity.value == "error" for finding in found)
    assert (program is None) == has_errors
    if program is not None:
        verify(lower(program))


def circle(count: int) -> str:
    conditions = "".join(f"c{number} : c{(number + 1) % count};" for number in range(count))
    return f"entity e {{{conditions}}}"


def ranges(count: int) -> str:
    conditions = "".join(f"c{number} : 2 in n;" for number in range(count))
    return f"const n = 3\nentity e {{{conditions}}}"


def each(line: str) -> Callable[[int], str]:
    """So many times a line, with a number and the next one."""

    def lines(count: int) -> str:
        return "".join(line.format(number, number + 1) for number in range(count))

    return lines


FLOODS: dict[str, Callable[[int], str]] = {
    "undeclared names": each("const name{0} = undeclared{0}\n"),
    "constants in a chain": each("const c{0} = c{1}\n"),
    "conditions in a circle": circle,
    "numbers as ranges": ranges,
    "unknown message types": each("input i{0} = topic /t{0} : x_msgs/T{0}\n"),
    "one very long name": lambda count: f"const {'a' * count * 30} = 3\nconst b = {'a' * count}b\n",
}


@pytest.mark.parametrize("kind", FLOODS)
def test_a_flood_of_mistakes_takes_time_in_proportion(kind: str) -> None:
    assert takes_at_most(8, check_text, FLOODS[kind](750), FLOODS[kind](3000))
