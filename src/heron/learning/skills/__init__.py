"""The skills of the insertion, in EzSkiROS: a behavior tree whose parameters can be learned."""
