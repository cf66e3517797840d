"""Rules together: their order, their plans, and missing parts."""
