"""Writes `docs/reference/units.md` from the tables: `python -m rossmarie.types.reference FILE`.

A test asserts that the page in the repository is what this writes.
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

A unit stands directly after a number or a bracket: `0.5 m/s`, `[-10, 10] deg`. It is a product
of the symbols below:

- `*` or `.` multiplies, `/` divides what follows, from left to right: `kg*m^2`, `kgm.m`,
  `J/kg/K`, `N/sec`;
- `^` raises to a whole power: `m/s^2`, `m.s^-2`;
- no white space inside: `5 m / t` is a division;
- upper and lower case matter: `Hz`, `kPa`, and `mPa` would be something else than `MPa`.

Units convert where their dimensions are equal. **An angle is a dimension of its own**: `deg` and
`rad` convert, and a plain number is neither. So `rad/s` times `m` is `rad*m/s`, which is no speed;
divide by `1 rad` to say that the angle is meant as a ratio. Torque and energy have one dimension
(`N*m` and `J` convert).

`degC` has an offset, so it stands alone: `20 degC`, but `5 K/s`. Two temperatures in `degC` can be
compared and subtracted (the difference is in `K`), but not added, scaled or negated.
"""

_FIELDS = """\
## Units of message fields

Message definitions do not say the units of their fields. For the common messages this table does,
from the comments in the definitions and REP 103. It also holds for these messages inside others:
`nav_msgs/Odometry` gets its units from the rows for `geometry_msgs/Pose` and `geometry_msgs/Twist`.
Times and durations are in `s` everywhere. The components of a quaternion are plain numbers.

Of a field that is not here the unit is *not known*: it can be compared with plain numbers, and with
other values once an input says its unit (`input q = topic /joint_states :
sensor_msgs/JointState .position in rad`) or a system model does
(`unit my_msgs/Wheel.speed = rad/s;`, which also overrides the table). Positions, velocities and
efforts of joints are left open on purpose: they are of angles or of lengths, by the kind of joint.
"""


def render() -> str:
    """The whole page, as Markdown."""
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
