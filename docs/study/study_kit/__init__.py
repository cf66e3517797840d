"""The study kit: prepares sessions, watches them, and analyses what they leave."""
