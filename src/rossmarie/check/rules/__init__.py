"""Rules together: their priorities, their plans, and missing parts."""
