"""The command `rossmarie`; `python -m rossmarie` is the same."""

from __future__ import annotations

from dslkit.garbage import look_seldom
from dslkit.signals import end_at_once


def main() -> None:
    """Run the command line. Its imports are slow, and Ctrl-C may interrupt them."""
    end_at_once()
    look_seldom()
    from rossmarie.cli.main import main as run

    run()


if __name__ == "__main__":
    main()
