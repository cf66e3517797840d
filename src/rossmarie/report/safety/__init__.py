"""The safety file of rules: their meaning in sentences, the hazards that they mitigate, and the
proofs.
"""

from rossmarie.report.safety.evidence import Evidence, EvidenceKind, evidence_text, parse_evidence
from rossmarie.report.safety.model import DeclaredItem, RulesFile, SafetyFile
from rossmarie.report.safety.page import open_points, render_safety_file

__all__ = [
    "DeclaredItem",
    "Evidence",
    "EvidenceKind",
    "RulesFile",
    "SafetyFile",
    "evidence_text",
    "open_points",
    "parse_evidence",
    "render_safety_file",
]
