"""Units: which quantities fit together, and what a unit as written means."""
