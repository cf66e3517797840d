"""Values that an import gives share lines."""

from __future__ import annotations

from rossmarie.driver.formatting import format_text

LONG = (
    'import "rossmarie/arm/torque.ross" with joints = joints, base = "fr3_joint1", '
    'shoulder = "fr3_joint2", elbow = "fr3_joint4", wrist_1 = "fr3_joint5" as load;\n'
)


def test_as_many_values_as_fit_stand_in_a_line() -> None:
    assert format_text(LONG) == (
        'import "rossmarie/arm/torque.ross"\n'
        '    with joints = joints, base = "fr3_joint1", shoulder = "fr3_joint2", '
        'elbow = "fr3_joint4",\n'
        '        wrist_1 = "fr3_joint5"\n'
        "    as load;\n"
    )
