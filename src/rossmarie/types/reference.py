"""Write `docs/reference/units.md` from the tables: `python -m rossmarie.types.reference FILE`.

A test compares the page in the repository with the output of this module.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable
from pathlib import Path

from rossmarie.types.field_units import FIELD_UNITS, RATIOS
from rossmarie.units import ALIASES, SYMBOLS, parse_unit

_INTRODUCTION = """\
# Units

<!-- Written by `python -m rossmarie.types.reference docs/reference/units.md`; do not edit. -->

A unit follows directly after a number or a bracket: `0.5 m/s`, `[-10, 10] deg`. A unit is a product
of the symbols below:

- `*` or `.` multiplies, and `/` divides by the next symbol, from left to right: `kg*m^2`, `kgm.m`,
  `J/kg/K`, `N/sec`;
- `^` raises to an integer power: `m/s^2`, `m.s^-2`;
- a unit contains no white space: `5 m / t` is a division;
- units are case-sensitive: `Hz`, `kPa`. `mPa` and `MPa` are different.

Units of the same dimension are converted automatically. **An angle is a dimension of its own**:
`deg` and `rad` convert into each other, and a plain number is not an angle. Therefore `rad/s` times
`m` is `rad*m/s`, which is not a speed; divide by `1 rad` to use the angle as a ratio. Torque and
energy have the same dimension (`N*m` and `J` convert).

`degC` has an offset and cannot be part of a product: `20 degC`, but `5 K/s`. Two temperatures in
`degC` can be compared and subtracted (the difference is in `K`), but not added, scaled or negated.
"""

_FIELDS = """\
## Units of message fields

Message definitions contain no units. This table contains the units of common messages, from the
comments in the definitions and REP 103. It also applies to these messages inside other messages:
`nav_msgs/Odometry` gets its units from the rows for `geometry_msgs/Pose` and `geometry_msgs/Twist`.
Times and durations are always in `s`. The components of a quaternion are plain numbers.

The unit of a field that is not in the table is *not known*. Such a field can be compared with plain
numbers. To compare it with other values, declare its unit in an input
(`input q = topic /joint_states : sensor_msgs/JointState .position in rad`) or in a system model
(`unit my_msgs/Wheel.speed = rad/s;`, which also overrides the table). Positions, velocities and
efforts of joints are deliberately not in the table: the kind of joint determines if they are angles
or lengths.
"""


def render() -> str:
    """The text of the page, as Markdown."""
    return "\n".join(
        (
            _INTRODUCTION,
            "## Symbols\n",
            *_table(("Unit", "Name", "In SI units", "Dimension"), map(_symbol_row, SYMBOLS)),
            "\nAlso accepted:\n",
            *_table(("Spelling", "Means"), ((f"`{a}`", f"`{b}`") for a, b in ALIASES.items())),
            "",
            _FIELDS,
            *_table(("Message", "Field", "Unit"), _field_rows()),
            "",
        )
    )


def _symbol_row(symbol: str) -> tuple[str, ...]:
    unit = parse_unit(symbol)
    offset = f" + {unit.offset!r}" if unit.offset else ""
    return f"`{symbol}`", SYMBOLS[symbol].meaning, f"x {unit.scale!r}{offset}", str(unit.dimension)


def _field_rows() -> Iterable[tuple[str, ...]]:
    for message, fields in FIELD_UNITS.items():
        for field, symbol in fields.items():
            is_ratio = f"{message}.{field}" in RATIOS
            shown = "plain number from 0 to 1" if is_ratio else _shown(symbol)
            yield f"`{message}`", f"`{field}`", shown


def _shown(symbol: str | None) -> str:
    if symbol is None:
        return "not known"
    return "plain number" if symbol == "1" else f"`{symbol}`"


def _table(head: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> Iterable[str]:
    yield from map(_line, (head, ("---",) * len(head), *rows))


def _line(cells: tuple[str, ...]) -> str:
    return f"| {' | '.join(cells)} |"


def main() -> None:
    """Write the page to the file named on the command line."""
    Path(sys.argv[1]).write_text(render(), encoding="utf-8")


if __name__ == "__main__":
    main()
