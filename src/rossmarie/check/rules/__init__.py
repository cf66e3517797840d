"""Rules together: their order, what follows from them, and what is missing."""
