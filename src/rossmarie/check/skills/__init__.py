"""Skills in rules: the skills file, and the queries of rules about skills."""
