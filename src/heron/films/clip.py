"""The content of a film of an episode: its pictures, and the text below each picture."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import matplotlib as mpl
import numpy as np
from PIL import Image, ImageDraw, ImageFont

from heron.appearance import Pixels, Size

STRIP = 62
"""The height of the words (pixels)."""
MUTED, DONE, ACTIVE = (98, 108, 118), (11, 127, 100), (207, 79, 23)
"""Colors of words: for additional words, for completed tasks, and for active rules or hazards."""
Words = tuple[str, tuple[int, int, int]]
"""Words, and their color."""
NO_WORDS: Words = ("", MUTED)
_PAPER, _INK = (255, 255, 255), (29, 35, 41)
_LINES = (5, 23, 41)
_LETTERS = 13
_MARGIN = 10
_FOLDER = Path(mpl.get_data_path()) / "fonts" / "ttf"
_PLAIN = ImageFont.truetype(str(_FOLDER / "DejaVuSans.ttf"), _LETTERS)
_BOLD = ImageFont.truetype(str(_FOLDER / "DejaVuSans-Bold.ttf"), _LETTERS)


class Clip(Protocol):
    """One episode, over, of any kind."""

    @property
    def duration(self) -> float:
        """The length of the episode (s)."""

    @property
    def opening(self) -> float:
        """The most interesting time (s), for readers who see only one picture."""

    def pictures(self, times: Sequence[float], speed: float, size: Size) -> Iterable[Pixels]:
        """Pictures at these times (s), with the words below each. Raises `CannotDrawError`."""


@dataclass(frozen=True)
class Caption:
    """The text below a picture: the name of the arm in the first line, the state or the measures in
    the second line, and names, such as names of rules, in the third line, if there is room.
    """

    title: str
    time: Words
    state: Words = NO_WORDS
    signal: Words = NO_WORDS
    names: Sequence[str] = ()
    names_color: tuple[int, int, int] = ACTIVE


def time_words(time: float, speed: float) -> Words:
    """The time (s) in an episode that is shown so many times as fast."""
    words = f"{time:.1f} s" if speed == 1 else f"{time:.1f} s, {speed:g} times as fast"
    return words, MUTED


def with_caption(pixels: Pixels, caption: Caption) -> Pixels:
    """A picture with its words below."""
    width = pixels.shape[1]
    strip = Image.new("RGB", (width, STRIP), _PAPER)
    draw = ImageDraw.Draw(strip)
    right = width - _MARGIN
    draw.text((_MARGIN, _LINES[0]), caption.title, _INK, _BOLD)
    for line, (words, color) in zip(_LINES, (caption.time, caption.signal), strict=False):
        draw.text((right, line), words, color, _PLAIN, anchor="ra")
    words, color = caption.state
    draw.text((_MARGIN, _LINES[1]), words, color, _PLAIN)
    names = _fitting(caption.names, width - 2 * _MARGIN)
    draw.text((_MARGIN, _LINES[2]), names, caption.names_color, _PLAIN)
    return np.vstack((pixels, np.asarray(strip)))


def _fitting(names: Sequence[str], width: int) -> str:
    """As many names as there is room for (pixels), and how many more there are."""
    shown = ", ".join(names)
    for count in range(len(names) - 1, -1, -1):
        if _PLAIN.getlength(shown) <= width:
            break
        shown = ", ".join((*names[:count], f"+{len(names) - count}"))
    return shown
