"""Lessons from runs: effects of rules on running skills, for the next plan and the next check."""
