"""Write which rules of the library the robots in the box use, and how."""

from __future__ import annotations

from written_page import written_page

from support.library_reuse import page

if __name__ == "__main__":
    written_page(__doc__).write_text(page(), encoding="utf-8")
