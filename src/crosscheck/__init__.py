"""Joint checks of the rules and the skills of one robot.

Each language checks its own files. This package finds errors that only both together show:
exemptions and permissions, skills that rules never let work, rules and skills that fight.
"""
