"""The ground floor of both languages: where things are written, and what is wrong with them.

Knows no domain. `dslkit.source` holds files and spans; `dslkit.diagnostics` holds findings as data
and their renderers; `dslkit.campaign` runs many episodes and keeps a journal.
"""
