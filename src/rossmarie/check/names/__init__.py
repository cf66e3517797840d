"""Names and fields: the meaning of each name, and the unused names."""
