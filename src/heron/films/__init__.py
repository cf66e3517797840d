"""Films of episodes: their pictures, and files to play them.

Films of a learning robot need the extra `rossmarie[gym]`; they are in `heron.films.insertion`.
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
