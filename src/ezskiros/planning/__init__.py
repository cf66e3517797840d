"""Plans: which skills lead from a scene to a goal."""
