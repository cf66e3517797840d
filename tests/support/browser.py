"""A real browser, without a screen and without a network."""

from __future__ import annotations

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
    assert BROWSER is not None
    done = subprocess.run(
        [
            BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run",
            "--disable-background-networking", "--disable-component-update", "--disable-sync",
            f"--user-data-dir={page.parent / 'profile'}", "--window-size=1400,1000",
            "--virtual-time-budget=2000", "--dump-dom",
            page.as_uri() + query,
        ],
        capture_output=True, text=True, timeout=120, check=True,
    )  # fmt: skip
    return done.stdout
