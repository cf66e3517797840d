"""The rules files whose generated C is proved."""

from pathlib import Path

_ROOT = Path(__file__).parents[1]

EXAMPLES = (
    "examples/thesis/mobile_base.ross",
    "examples/thesis/arm.ross",
    "examples/thesis/peg_in_hole.ross",
    "examples/husky/husky.ross",
    "examples/demo/demo.ross",
)

LIBRARY = tuple(
    path.relative_to(_ROOT).as_posix()
    for path in sorted((_ROOT / "src/rossmarie/library").glob("*/*.ross"))
    if path.name.count(".") == 1 and path.name != "system.ross"
)
"""The files of the library that have rules."""
