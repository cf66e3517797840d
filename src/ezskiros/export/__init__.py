"""Export of skills to a file for other tools: `skills.json` (docs/reference/skills-file.md)."""

from ezskiros.export.read import Export, changed_sources, not_exported, read_export
from ezskiros.export.write import export_skills

__all__ = ["Export", "changed_sources", "export_skills", "not_exported", "read_export"]
