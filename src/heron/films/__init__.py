"""Episodes as films: pictures of what happened, and files that play them."""

from heron.films.clip import Clip, film_of
from heron.films.film import CannotDrawError, Film, Pixels, Size
from heron.films.rules_watch import RulesWatch, Spans

__all__ = [
    "CannotDrawError",
    "Clip",
    "Film",
    "Pixels",
    "RulesWatch",
    "Size",
    "Spans",
    "film_of",
]
