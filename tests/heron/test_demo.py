"""The demo: films of real episodes, and a page that needs nothing else."""

from __future__ import annotations

import multiprocessing
import re
from concurrent.futures import ProcessPoolExecutor
from ctypes.util import find_library
from dataclasses import replace
from pathlib import Path

import pytest

pytest.importorskip("mujoco", reason="the simulation needs MuJoCo, which needs Python 3.11")

from PIL import Image
from typer.testing import CliRunner

from heron.cli.main import app
from heron.demo import Shot, page_of, shoot
from heron.demo.charts import strip_of
from heron.demo.film import Frames
from heron.experiments import EXPERIMENTS, run_placing
from heron.variants import Arm, Table
from support.browser import document_of, needs_browser

# The least WebP that there is.
PICTURE = bytes.fromhex("524946461a000000574542505650384c0d0000002f00000010071011118888fe0700")


def shot_in_a_process(renderer: str, monkeypatch: pytest.MonkeyPatch) -> Shot:
    """A short episode. Only a new process looks at how to draw."""
    monkeypatch.setenv("MUJOCO_GL", renderer)
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        return pool.submit(shoot, "place", "high", Arm.ROSSMARIE, 3).result()


@pytest.mark.skipif(find_library("EGL") is None, reason="no EGL here: nothing draws off a screen")
def test_a_film_shows_the_episode_and_changes_nothing(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    shot = shot_in_a_process("egl", monkeypatch)
    plain = run_placing(Arm.ROSSMARIE, Table.HIGH, 3)
    assert (shot.told, shot.duration) == (plain.told, plain.measures.duration)
    assert shot.measures["above 30 N"] == f"{plain.measures.time_above_30_n:.2f} s"
    assert shot.frames.trouble == ""
    assert len(shot.frames.pictures) * shot.frames.period == pytest.approx(shot.duration, abs=0.2)
    assert len(set(shot.frames.pictures)) > 50, "it moves"
    path = tmp_path / "frame.webp"
    path.write_bytes(shot.frames.pictures[-1])
    with Image.open(path) as picture:
        assert picture.size == (480, 270)
        assert len(picture.convert("RGB").getcolors(2**18) or []) > 500, "there is something on it"
    activated = [at for at, words in shot.told if "soften_when_hammering activated" in words]
    assert shot.rules["soften_when_hammering"][0][0] == pytest.approx(activated[0], abs=0.021)


def test_where_nothing_can_be_drawn_the_reason_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    shot = shot_in_a_process("disable", monkeypatch)
    assert shot.frames.pictures == ()
    assert shot.frames.trouble
    page = page_of([shot])
    assert "No pictures here" in page
    assert "libegl1" in page


def made_up(arm: Arm, rules: dict[str, list[tuple[float, float]]]) -> Shot:
    return Shot(
        experiment="place",
        arm=arm,
        title="a <table>",
        is_completed=arm is Arm.ROSSMARIE,
        duration=4.0 if arm is Arm.NONE else 2.0,
        measures={"task": "completed", "peak force": f"{len(rules)}17 N"},
        told=((0.5, "</script><b>said</b>"),),
        rules=rules,
        curves={
            signal.label: [(0.0, -1e-9), (1.0, 42.0), (2.0, 3.0)]
            for signal in EXPERIMENTS["place"].signals
        },
        frames=Frames((PICTURE,) * 3, 1.0),
    )


def test_the_page_needs_nothing_else_and_names_stay_names() -> None:
    page = page_of([made_up(Arm.NONE, {}), made_up(Arm.ROSSMARIE, {"</script>": [(0.0, 1.0)]})])
    assert not re.findall(r"(?:src|href)=|url\(|https?://|@import", page.replace("image.src", ""))
    assert page.count("</script>") == 2, "that of the data, and that of the code"
    assert "a &lt;table&gt;" in page
    assert "117 N" in page
    assert "-0" not in re.findall(r">(-?[\d.]+)</text>", page)


DRIVEN = """<script>
document.querySelector("input").value = 1.5;
document.querySelector("input").dispatchEvent(new Event("input"));
document.title = document.querySelector("output").textContent;
document.querySelector("button").click();
</script></body>"""


def test_names_of_rules_stay_on_the_drawing() -> None:
    early, late = "slow_down", "soften_when_hammering"
    shot = made_up(Arm.ROSSMARIE, {late: [(1.5, 3.9)], early: [(0.5, 1.0), (1.2, 1.3)]})
    first, second = strip_of([shot], 4.0).rows
    assert (first.rule, second.rule) == (early, late)
    assert first.bars[1][0] < first.name_x
    assert not first.is_name_before
    assert second.name_x < second.bars[0][0]
    assert second.is_name_before


@needs_browser
def test_the_player_shows_frames_and_active_rules(tmp_path: Path) -> None:
    shots = [made_up(Arm.NONE, {}), made_up(Arm.ROSSMARIE, {"slow_down": [(0.0, 1.0)]})]
    path = tmp_path / "page.html"
    path.write_text(page_of(shots), encoding="utf-8")
    still = document_of(path)
    assert still.count('src="data:image/webp;base64,') == 2
    assert '<p class="now">slow_down</p>' in still
    assert "0.0 s, 1.0 times as fast" in still
    path.write_text(page_of(shots).replace("</body>", DRIVEN), encoding="utf-8")
    played = document_of(path)
    assert "<title>1.5 s, 1.0 times as fast</title>" in played
    assert re.search(r"<output>(1\.[5-9]|[234]\.)", played), "time has passed"
    assert '<p class="now">slow_down</p>' not in played
    assert ">pause<" in played


def test_the_comparison_is_printed_and_the_page_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("MUJOCO_GL", "disable")  # set by the command otherwise
    shots = [made_up(Arm.NONE, {}), made_up(Arm.ROSSMARIE, {})]
    shots += [
        replace(
            shot,
            experiment=name,
            curves={one.label: [(0.0, 0.0), (1.0, 1.0)] for one in EXPERIMENTS[name].signals},
        )
        for name in EXPERIMENTS
        if name != "place"
        for shot in shots
    ]
    monkeypatch.setattr("heron.cli.demonstrating.shoot_all", lambda *_: shots)
    page = tmp_path / "new" / "heron.html"
    found = CliRunner().invoke(app, ["demo", "--out", str(page)])
    assert found.exit_code == 0, found.output
    assert "no monitor" in found.output
    assert "Experiment II, placing" in found.output
    assert "<h1>Heron" in page.read_text(encoding="utf-8")
    found = CliRunner().invoke(app, ["demo", "--out", str(tmp_path)])
    assert found.exit_code == 2
    assert "cannot write" in found.output
