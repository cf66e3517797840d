"""Films as files: MP4 for talks, GIF and WebP for pages."""

from __future__ import annotations

import contextlib
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from itertools import chain
from pathlib import Path

import imageio_ffmpeg
import numpy as np
from PIL import Image

from heron.appearance import Pixels, Size
from heron.films.clip import Clip

_RATES = {".mp4": 20, ".gif": 10, ".webp": 8}  # pictures in a second
_SPEEDS = (1, 2, 4, 8)
_LONGEST_S = 15.0
_GAP = 8  # pixels between clips
_QUALITY = 60


def speed_for(duration: float) -> int:
    """The least speed at which an episode (s) is short enough, or the greatest; 1 is real time."""
    return next((speed for speed in _SPEEDS if duration / speed <= _LONGEST_S), _SPEEDS[-1])


def write_movie(path: Path, clips: Sequence[Clip], size: Size) -> None:
    """Write a film of clips side by side. Each picture of a clip has the given size. The suffix
    sets the format. The first second shows the hazard, for viewers that show only the first
    picture.

    Raises `CannotDrawError` and `OSError`; then there is no file.
    """
    duration = max(clip.duration for clip in clips)
    speed, rate = speed_for(duration), _RATES[path.suffix.lower()]
    count = round(duration / speed * rate) + rate  # for a second, how it ended
    opening = max(clip.opening for clip in clips)
    times = [opening] * rate + [index * speed / rate for index in range(count)]
    encode(path, _beside(clips, times, speed, size), rate)


def encode(path: Path, pictures: Iterator[Pixels], rate: int) -> None:
    """Pictures of one size, so many in a second, in the format that the suffix says. Raises
    `OSError`; then there is no file.
    """
    with tempfile.TemporaryDirectory(dir=path.parent) as folder:
        written = Path(folder) / path.name
        write = _write_mp4 if path.suffix.lower() == ".mp4" else _write_animation
        write(written, pictures, rate)
        written.replace(path)


def _beside(
    clips: Sequence[Clip], times: Sequence[float], speed: float, size: Size
) -> Iterator[Pixels]:
    for pictures in zip(*(clip.pictures(times, speed, size) for clip in clips), strict=True):
        first, *others = pictures
        gap = np.full((first.shape[0], _GAP, 3), 255, np.uint8)
        yield np.hstack([first, *(part for other in others for part in (gap, other))])


def _write_mp4(path: Path, pictures: Iterator[Pixels], rate: int) -> None:
    """H.264, as every player has it."""
    try:
        program = imageio_ffmpeg.get_ffmpeg_exe()
    except RuntimeError as error:  # of a machine that the package brings no program for
        raise OSError(f"there is no FFmpeg: {error}") from error
    first = next(pictures)
    height, width, _ = first.shape
    raw = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", str(rate)]
    coded = ["-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "20", "-movflags", "+faststart"]
    command = [program, "-loglevel", "error", *raw, "-i", "-", *coded, str(path)]
    with tempfile.TemporaryFile() as reported:
        with subprocess.Popen(command, stdin=subprocess.PIPE, stderr=reported) as running:
            assert running.stdin is not None
            with contextlib.suppress(BrokenPipeError):  # it tells why it has ended
                for pixels in chain([first], pictures):
                    running.stdin.write(pixels.tobytes())
            with contextlib.suppress(BrokenPipeError):
                running.stdin.close()
        reported.seek(0)
        reasons = reported.read().decode(errors="replace").splitlines()
    if running.returncode or reasons:
        raise OSError(f"FFmpeg failed: {reasons[-1] if reasons else running.returncode}")


def _write_animation(path: Path, pictures: Iterator[Pixels], rate: int) -> None:
    first, *others = map(Image.fromarray, pictures)
    first.save(
        path,
        save_all=True,
        append_images=others,
        duration=round(1000 / rate),
        loop=0,
        quality=_QUALITY,
    )
