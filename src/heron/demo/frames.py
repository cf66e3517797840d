"""The pictures of a film in the form for a page."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from dataclasses import dataclass

from PIL import Image

from heron.appearance import Camera
from heron.films import CannotDrawError, Film, Pixels

_MOST = 80
_LEAST_PERIOD = 0.1  # s
_SIZE = (480, 270)
_QUALITY = 72


@dataclass(frozen=True)
class DemoFrames:
    """Pictures (WebP) at equal distances (s); none, and why, where nothing can be drawn."""

    pictures: tuple[bytes, ...]
    period: float
    trouble: str = ""


def frames_of(film: Film, cameras: Sequence[Camera]) -> DemoFrames:
    """All of a film, in a limited number of pictures."""
    period = max(_LEAST_PERIOD, film.duration / _MOST)
    times = [index * period for index in range(math.ceil(film.duration / period))]
    try:
        pictures = tuple(map(_encoded, film.pictures(cameras, times, _SIZE)))
    except CannotDrawError as error:
        return DemoFrames((), period, str(error))
    return DemoFrames(pictures, period)


def _encoded(pixels: Pixels) -> bytes:
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, "webp", quality=_QUALITY)
    return file.getvalue()
