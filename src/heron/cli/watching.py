"""Windows on episodes, and films of them."""

from __future__ import annotations

import enum
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from heron.cli.choices import output, require_drawing, require_film, require_simulation
from heron.variants import ExperimentArm

if TYPE_CHECKING:  # needs MuJoCo
    from heron.experiments import Observer


def film_episode(
    name: str, arm: ExperimentArm, variant: enum.Enum, seed: int, out: Path, *, is_viewed: bool
) -> None:
    """Run an episode, and write a film of it."""
    if is_viewed:
        output.fail("--film draws without a window: leave out --view", exit_code=2)
    require_film(out)
    require_drawing()
    require_simulation()
    from heron.cli.filming import film as write_film

    write_film(output, name, variant, arm, seed, out)


@contextmanager
def observers(name: str, *, is_viewed: bool) -> Iterator[list[Observer]]:
    """A window on an experiment while it runs, if the user wants a window."""
    if not is_viewed:
        yield []
        return
    from heron.experiments import EXPERIMENTS
    from heron.viewing import Window, trouble

    reason = trouble()
    if reason is not None:
        output.fail(
            f"--view needs a display: {reason}; `heron demo` makes pictures without one",
            exit_code=2,
        )
    with Window(EXPERIMENTS[name].cameras) as window:
        yield [window]
