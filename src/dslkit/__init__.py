"""The common base of both languages: source files, and findings about them.

This package contains no domain knowledge. `dslkit.source` holds files and spans;
`dslkit.diagnostics` holds findings as data and their renderers; `dslkit.campaign` runs many
episodes and keeps a journal.
"""
