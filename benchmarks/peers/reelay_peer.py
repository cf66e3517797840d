"""reelay's discrete-time monitors on the workload: TRACE_FOLDER SAMPLES COPIES ROUNDS."""

from __future__ import annotations

from collections.abc import Iterator

import reelay
from peer import Arguments, measure


def patterns(arguments: Arguments) -> Iterator[str]:
    """The rules in past-time MTL, with a weak start. Durations are in samples."""
    for c in arguments.constants:
        pitch = f"{{pitch > {c.pitch:.6f}}} or {{pitch < -{c.pitch:.6f}}}"
        fast = f"historically[0:{c.fast_samples}]{{speed > {c.speed:.6f}}}"
        tilted = f"historically[0:{c.tilted_samples}]({pitch})"
        pushed = f"historically[0:{c.pushed_samples}]{{force_z > {c.force_z:.6f}}}"
        yield f"({fast}) and {{distance < {c.distance:.6f}}}"
        yield f"({tilted}) and {{speed > {c.creep:.6f}}}"
        yield f"({pushed}) and not {{contact}}"


def main() -> None:
    """Measure. Each round builds new monitors; the construction is not timed."""
    arguments = Arguments.read()
    rows = arguments.rows()

    def build() -> list[reelay.discrete_timed_monitor]:
        return [
            reelay.discrete_timed_monitor(pattern=text, condense=False)
            for text in patterns(arguments)
        ]

    def run(monitors: list[reelay.discrete_timed_monitor]) -> list[int]:
        counts = [0, 0, 0]
        updates = [monitor.update for monitor in monitors]
        for index, (speed, pitch, distance, force_z, contact) in enumerate(rows):
            sample = {
                "time": index,
                "speed": speed,
                "pitch": pitch,
                "distance": distance,
                "force_z": force_z,
                "contact": bool(contact),
            }
            for rule, update in enumerate(updates):
                counts[rule % 3] += update(sample)["value"]
        return counts

    measure(arguments, build, run)


if __name__ == "__main__":
    main()
