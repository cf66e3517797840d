"""Names and fields: what each stands for, and which are never used."""
