"""Random rules files: a few rules over inputs of every kind, with thresholds and durations."""

from __future__ import annotations

from hypothesis import strategies as st

from support.rule_skills import FILE

numbers = st.sampled_from(("0.3", "0.5", "1", "1.5", "2", "5"))
durations = st.sampled_from(("0.3 sec", "0.5 sec", "1 sec"))
signs = st.sampled_from(("<", "<=", ">", ">="))
filters = st.sampled_from(("mean", "median", "low_pass"))

NAMED = f"""\
skills "{FILE}";
system arm {{ unit sensor_msgs/JointState.velocity = rad/s; }}
input joints = topic /joint_states : sensor_msgs/JointState timeout 1 sec;
input efforts = topic /effort_states : std_msgs/Float64MultiArray .data
    names ["shoulder", "elbow", "wrist"] in Nm timeout 1 sec;
"""
"""Inputs of the elements by name, and skills, beside those of `support.testing`."""


SKILLS = st.sampled_from(
    ("Push", "Push(Object: Fragile)", "Push(Object: skiros.Box)", "Drive(Target: Shelf)", "Move")
)


@st.composite
def leaves(draw: st.DrawFn) -> str:
    """A comparison, a range, a flag, a string, or an age."""
    sign, number = draw(signs), draw(numbers)
    return draw(
        st.sampled_from(
            (
                f"speed {sign} {number} m/s",
                f"abs(speed) {sign} {number} m/s",
                f"orientation.pitch() {sign} {number} deg",
                f"norm(acceleration) {sign} {number} m/s^2",
                f"acceleration.x not in [-{number}, {number}] m/s^2",
                f"min(ranges) {sign} {number} m",
                f"any(ranges {sign} {number} m)",
                f"any(p in path: p.pose.position.x {sign} {number} m and p.pose.position.z < 1 m)",
                f"count(p in path: p.pose.position.y {sign} {number} m) > 1",
                f"min(p in path: p.pose.position.x) {sign} {number} m",
                f"all(p in path: p.pose.position.x {sign} {number} m)",
                f"max(p in path: norm(p.pose.position)) {sign} {number} m",
                f'abs(joints["elbow"].velocity) {sign} {number} rad/s',
                f'efforts["wrist"] {sign} {number} Nm',
                f"any(q in cloud: norm(q) {sign} {number} m and q.intensity < 1)",
                f"count(q in cloud: true) {sign} {number}",
                f"rate(speed) {sign} {number} m/s^2",
                f"{draw(filters)}(speed, {draw(durations)}) {sign} {number} m/s",
                f"rate(low_pass(speed, {draw(durations)})) {sign} {number} m/s^2",
                f"changed({draw(st.sampled_from(('ok', 'speed', 'acceleration')))})",
                "not ok",
                'state == "stuck"',
                f"doing {draw(SKILLS)}",
                f"(doing {draw(SKILLS)} or doing {draw(SKILLS)})",
                "age(fix) > 0.7 sec",
            )
        )
    )


@st.composite
def over_time(draw: st.DrawFn, leaf: str) -> str:
    """A leaf for a while, since another, once, answered by another, or as often as that."""
    other, duration, sign = draw(leaves()), draw(durations), draw(signs)
    return draw(
        st.sampled_from(
            (
                f"{leaf} for {duration}",
                f"{leaf} for {duration}",
                f"{leaf} since {other}",
                f"once {leaf} within {duration}",
                f"after {leaf}, {other} within {duration}",
                f"count(edges of {leaf} within {duration}) {sign} {draw(st.integers(1, 3))}",
            )
        )
    )


@st.composite
def conditions(draw: st.DrawFn) -> str:
    """One to three leaves, joined, some of them over time."""
    parts = []
    for leaf in draw(st.lists(leaves(), min_size=1, max_size=3, unique=True)):
        is_over_time = "rate" not in leaf and draw(st.booleans())
        parts.append(f"({draw(over_time(leaf)) if is_over_time else leaf})")
    return f" {draw(st.sampled_from(('and', 'or')))} ".join(parts)


@st.composite
def rules(draw: st.DrawFn) -> str:
    """One or two rules."""
    lines = []
    for index in range(draw(st.integers(1, 2))):
        contract = draw(
            st.sampled_from(("", f" clear for {draw(durations)}", " latched until reset"))
        )
        scope = f" while doing {draw(SKILLS)}" if draw(st.booleans()) else ""
        exemption = draw(exemptions()) if draw(st.booleans()) else ""
        head = f"rule r{index}: if {draw(conditions())}{scope}"
        lines.append(f"{head} then {{ slow; }}{exemption}{contract};\n")
    return "".join(lines)


@st.composite
def exemptions(draw: st.DrawFn) -> str:
    """An exemption of one of the three forms."""
    form = draw(st.sampled_from(("", " then {{ slow; }}", " then if {} then {{ slow; }}")))
    return f" unless doing {draw(SKILLS)}{form.format(draw(leaves()))}"
