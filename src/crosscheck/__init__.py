"""The rules and the skills of one robot, looked at together.

Each language checks its own files. Here stands all that only both together can tell: exemptions and
permissions, skills that rules never let work, rules and skills that fight.
"""
