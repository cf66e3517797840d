"""Skills in rules: the file of skills, and the queries of rules about skills."""
