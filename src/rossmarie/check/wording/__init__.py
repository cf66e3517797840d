"""The words of findings: types in the words of the user, names that may be meant, edits."""
