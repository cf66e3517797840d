"""Units: the quantities that fit together, and the meaning of a written unit."""
