"""Planning: finding skills that lead from a scene to a goal."""
