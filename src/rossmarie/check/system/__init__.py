"""System models and inputs: topics, message types, the units of fields, rates."""
