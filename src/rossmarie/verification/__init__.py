"""Proofs that the generated C is what the rules mean."""
