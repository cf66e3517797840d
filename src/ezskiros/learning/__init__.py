"""Lessons of runs: what rules did while skills ran, for the next plan and the next check."""
