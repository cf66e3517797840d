"""The rules files of the experiments, in the package so that the command finds them."""

from __future__ import annotations

from pathlib import Path

FOLDER = Path(__file__).parent
