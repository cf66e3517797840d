"""Write the page about the rules of the library that the included robots use."""

from __future__ import annotations

from written_page import written_page

from support.library_reuse import page

if __name__ == "__main__":
    written_page(__doc__).write_text(page(), encoding="utf-8")
