"""Episodes as films: pictures of what happened, and files that play them.

Films of a robot that learns need the extra `rossmarie[gym]`: `heron.films.insertion` has them.
"""

from heron.appearance import CannotDrawError, Pixels, Size
from heron.films.clip import Clip
from heron.films.episode import EpisodeClip, film_of
from heron.films.film import Film
from heron.films.rules_watch import RulesWatch, Spans

__all__ = [
    "CannotDrawError",
    "Clip",
    "EpisodeClip",
    "Film",
    "Pixels",
    "RulesWatch",
    "Size",
    "Spans",
    "film_of",
]
