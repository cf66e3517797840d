"""A real browser, without a screen and without a network."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

from support.parts import CHROMIUM, needs

BROWSER = next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None
)

needs_browser = needs(CHROMIUM)


def document_of(page: Path, query: str = "") -> str:
    """The document of a page after its scripts have run; the browser's profile lies beside it.

    `query` follows the address of the page, as `?q=word`.
    """
    return _run(page, "--window-size=1400,1000", "--dump-dom", page.as_uri() + query)


def printed_sheets(page: Path) -> int:
    """The number of sheets that a browser prints a page on."""
    printed = page.with_suffix(".pdf")
    _run(page, f"--print-to-pdf={printed}", page.as_uri())
    return len(re.findall(rb"/Type\s*/Page\b", printed.read_bytes()))


def _run(page: Path, *arguments: str) -> str:
    """The output of a browser without a network."""
    assert BROWSER is not None
    done = subprocess.run(
        [
            BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run",
            "--disable-background-networking", "--disable-component-update", "--disable-sync",
            f"--user-data-dir={page.parent / 'profile'}", "--virtual-time-budget=2000", *arguments,
        ],
        capture_output=True, text=True, timeout=120, check=True,
    )  # fmt: skip
    return done.stdout
