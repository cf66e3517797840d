"""Films as files, and the gallery."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import imageio_ffmpeg
import numpy as np
import pytest

from support.depth import is_deep
from support.parts import EGL, MOUNTS, MUJOCO, needs, require

require(MUJOCO)

from PIL import Image
from typer.testing import CliRunner

from heron.cli.main import _SHOWN_SEED, app
from heron.experiments import EXPERIMENTS, Experiment
from heron.films.clip import STRIP
from heron.films.gallery import EXHIBITS, PAGE, page_of
from heron.films.movie import encode, speed_for

DOCS = Path(__file__).parents[2] / "docs"


WIDTH, HEIGHT = (640, 360) if is_deep() else (160, 90)
RATE = 20 if is_deep() else 5
"""The size of pictures, and how many there are in a second: drawing takes a processor long."""
SMALL = f"""\
from heron.cli.choices import draw_without_display
draw_without_display()
from heron.cli import filming
from heron.cli.main import main
from heron.films import movie
filming._SIZE = ({WIDTH}, {HEIGHT})
movie._RATES[".mp4"] = {RATE}
main()
"""


def heron(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """The command in a process of its own, which alone looks at how to draw."""
    return started(Path(sys.executable).with_name("heron"), *arguments)


def started(*command: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_an_episode_is_shown_so_fast_that_nobody_waits() -> None:
    assert [speed_for(duration) for duration in (8.0, 15.0, 15.1, 38.0, 62.0, 300.0)] == [
        1, 1, 2, 4, 8, 8,
    ]  # fmt: skip


@needs(EGL)
def test_an_episode_becomes_a_film_that_players_read(tmp_path: Path) -> None:
    path = tmp_path / "placing.mp4"
    words = ("run", "place", "--seed", "3", "--arm", "none", "--film", path)
    done = heron(*words) if is_deep() else started(sys.executable, "-c", SMALL, *words)
    assert done.returncode == 0, done.stderr
    assert f"the film:  {path}" in done.stdout
    assert "none, table 4.2 cm too high, seed 3" in done.stdout
    decoded = subprocess.run(
        [imageio_ffmpeg.get_ffmpeg_exe(), "-i", path, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
        capture_output=True,
        check=True,
    )
    assert b"Video: h264" in decoded.stderr
    pictures = np.frombuffer(decoded.stdout, np.uint8).reshape(-1, HEIGHT + STRIP, WIDTH, 3)
    assert len(pictures) / RATE == pytest.approx(1.0 + 7.9 + 1.0, abs=0.2), "hazard, film, end"
    first, start, last = (
        pictures[index, :HEIGHT].astype(int) for index in (0, RATE + RATE // 4, -1)
    )
    assert np.abs(start - last).mean() > 3
    assert np.abs(first - start).mean() > 3, "the first picture shows the hazard"
    assert list(tmp_path.iterdir()) == [path], "nothing else is left"


def test_a_gif_is_a_film_too(tmp_path: Path) -> None:
    path = tmp_path / "placing.gif"
    encode(path, (np.full((36, 64, 3), 40 * index, np.uint8) for index in range(5)), 10)
    with Image.open(path) as film:
        assert (film.size, getattr(film, "n_frames", 1)) == ((64, 36), 5)
        assert (film.info["duration"], film.info["loop"]) == (100, 0)


def test_nothing_is_written_over(tmp_path: Path) -> None:
    path = tmp_path / "placing.gif"
    path.write_bytes(b"GIF89a")
    found = CliRunner().invoke(app, ["run", "place", "--film", str(path)])
    assert found.exit_code == 2
    assert "is there, and heron did not write it" in found.output


@needs(MOUNTS)
@pytest.mark.parametrize("suffix", [".mp4", ".gif"])
def test_a_film_that_does_not_fit_the_disk_is_no_film(suffix: str, tmp_path: Path) -> None:
    small = tmp_path / "small"
    small.mkdir()
    subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "none", small], check=True)
    noise = np.random.default_rng(0).integers(0, 256, (20, 90, 160, 3), np.uint8)
    try:
        with pytest.raises(OSError, match=r"(?i)no space left on device"):
            encode(small / f"a{suffix}", iter(noise), 20)
        assert list(small.iterdir()) == []
    finally:
        subprocess.run(["umount", small], check=True)


@pytest.mark.parametrize(
    ("arguments", "reported"),
    [
        (("--film", "drive.avi"), "the name of the film must end in .mp4 or .gif"),
        (("--film", "drive.mp4", "--view"), "leave out --view"),
        (("--film", "drive.mp4", "--ros1"), "leave out --ros1"),
        (("--film", "/dev/null/drive.mp4"), "cannot write"),
    ],
)
def test_a_film_that_cannot_be_is_reported_at_once(
    arguments: tuple[str, ...], reported: str
) -> None:
    found = CliRunner().invoke(app, ["run", "nav", *arguments])
    assert found.exit_code == 2
    assert reported in found.output


def test_without_egl_it_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("MUJOCO_GL", "disable")
    for command in (["run", "nav", "--film", str(tmp_path / "a.mp4")], ["gallery", "--out", "x"]):
        found = CliRunner().invoke(app, command)
        assert found.exit_code == 2
        assert "libegl1" in found.output


def test_a_renderer_that_is_not_there_is_reported(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("MUJOCO_GL", "crayon")
    for command in (["run", "place"], ["demo", "--out", tmp_path / "heron.html"]):
        done = heron(*command)
        assert done.returncode == 2
        assert "heron: MuJoCo cannot draw with MUJOCO_GL=crayon (" in done.stderr
        assert len(done.stderr.splitlines()) == 1


def test_the_gallery_in_the_documentation_is_what_the_command_writes() -> None:
    text = (DOCS / PAGE).read_text(encoding="utf-8")
    assert text == page_of(EXHIBITS, _SHOWN_SEED)
    for exhibit in EXHIBITS:
        with Image.open(DOCS / "gallery" / f"{exhibit.name}.webp") as film:
            assert getattr(film, "n_frames", 1) > 40
            assert film.size == (808, 225 + STRIP)


def test_every_command_of_the_gallery_is_one_that_there_is() -> None:
    commands = [line.split()[1:] for line in page_of(EXHIBITS, 1).splitlines() if "--film" in line]
    assert len(commands) == len(EXHIBITS)
    for command in commands:
        assert command[-1].endswith(".mp4")
        found = CliRunner().invoke(app, [*command[:-1], "no-film.txt"])
        assert "must end in .mp4" in found.output, "all that is before the name is understood"


@pytest.mark.parametrize("experiment", EXPERIMENTS.values(), ids=EXPERIMENTS)
def test_one_signal_of_each_experiment_is_reported_in_films(experiment: Experiment) -> None:
    assert len([each for each in experiment.signals if each.short]) == 1
