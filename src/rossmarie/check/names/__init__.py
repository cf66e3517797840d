"""Names and fields: the meaning of each, and the unused ones."""
