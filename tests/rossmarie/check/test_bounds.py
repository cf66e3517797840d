"""Any program gets an answer, and soon."""

from __future__ import annotations

import time

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rossmarie.ir import verify
from rossmarie.lowering import lower
from support.depth import examples
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


COUNT = 3000
FLOODS = {
    "undeclared names": "".join(
        f"const name{number} = undeclared{number}\n" for number in range(COUNT)
    ),
    "constants in a chain": "".join(
        f"const c{number} = c{number + 1}\n" for number in range(COUNT)
    ),
    "conditions in a circle": "entity e {"
    + "".join(f"c{number} : c{(number + 1) % COUNT};" for number in range(COUNT))
    + "}",
    "numbers as ranges": "const n = 3\nentity e {"
    + "".join(f"c{number} : 2 in n;" for number in range(COUNT))
    + "}",
    "unknown message types": "".join(
        f"input i{number} = topic /t{number} : x_msgs/T{number}\n" for number in range(COUNT)
    ),
    "one very long name": f"const {'a' * 10**5} = 3\nconst b = {'a' * 10**5}b\n",
}


@pytest.mark.parametrize("kind", FLOODS)
def test_a_flood_of_mistakes_takes_seconds_at_most(kind: str) -> None:
    start = time.process_time()
    check_text(FLOODS[kind])
    assert time.process_time() - start < 10
