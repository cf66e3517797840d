"""Proofs that the generated C implements the rules."""
