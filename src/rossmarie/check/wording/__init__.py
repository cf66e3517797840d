"""The wording of findings: types in the user's words, suggested names, and edits."""
