"""The command `heron`, which is also `python -m heron`."""

from __future__ import annotations

from dslkit.garbage import look_seldom
from dslkit.signals import end_at_once


def main() -> None:
    """Run the command line. The import takes a while, and the user may interrupt it."""
    end_at_once()
    look_seldom()
    from heron.cli.main import main as run

    run()


if __name__ == "__main__":
    main()
