"""A robot that learns to insert a peg next to a fragile part and a person: the scene of figure 4 of
the thesis as Gymnasium environments, `heron/PegInHole-v1` and `heron/PegInHoleMoves-v1`.

The import registers them. It needs the extras `rossmarie[heron]` and `rossmarie[gym]`.
"""

import gymnasium

gymnasium.register("heron/PegInHole-v1", "heron.learning.environment:PegInHole")
gymnasium.register("heron/PegInHoleMoves-v1", "heron.learning.environment:PegInHoleMoves")
