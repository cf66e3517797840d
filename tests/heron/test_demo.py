"""The demo: films of real episodes, and a page that needs nothing else."""

from __future__ import annotations

import io
import math
import multiprocessing
import re
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from pathlib import Path

import pytest

from support.parts import EGL, MUJOCO, needs, require

require(MUJOCO)

import numpy as np
from PIL import Image
from typer.testing import CliRunner

from heron.cli.main import app
from heron.demo import Shot, page_of, shoot
from heron.demo.charts import WIDTH
from heron.demo.film import Frames
from heron.demo.lanes import axis_of, rules_of, running_of, tree_of
from heron.experiments import EXPERIMENTS, run_placing
from heron.tasks import Span, Status, TreeSkill
from heron.variants import Arm, Table
from support.browser import document_of, needs_browser

# The least WebP that there is.
PICTURE = bytes.fromhex("524946461a000000574542505650384c0d0000002f00000010071011118888fe0700")


def shot_in_a_process(
    renderer: str, monkeypatch: pytest.MonkeyPatch, name: str = "place", variant: str = "high"
) -> Shot:
    """An episode. Only a new process looks at how to draw."""
    monkeypatch.setenv("MUJOCO_GL", renderer)
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        return pool.submit(shoot, name, variant, Arm.ROSSMARIE, 3).result()


def browns(picture: bytes) -> int:
    """How many pixels are of the color of a table."""
    with Image.open(io.BytesIO(picture)) as shown:
        pixels = np.asarray(shown.convert("RGB"), dtype=int)
    red, green, blue = pixels[..., 0], pixels[..., 1], pixels[..., 2]
    return int(np.sum((red > green + 10) & (green > blue + 10)))


@needs(EGL)
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
    assert [skill.label for skill in shot.tree] == ["place", "PutDown"]
    activated = [at for at, words in shot.told if "soften_when_hammering activated" in words]
    assert shot.rules["soften_when_hammering"][0][0] == pytest.approx(activated[0], abs=0.021)


@pytest.mark.deep
@needs(EGL)
def test_the_film_of_a_drive_goes_on_until_the_block_is_picked_up(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    shot = shot_in_a_process("egl", monkeypatch, "nav", "flat")
    assert shot.is_completed
    frames = shot.frames
    assert len(frames.pictures) * frames.period == pytest.approx(shot.duration, abs=0.6)
    arrived_s = next(one.spans[0].end for one in shot.tree if one.label == "Drive(Target)")
    assert arrived_s is not None
    arrived = math.ceil(arrived_s / frames.period)
    assert 2 < len(set(frames.pictures[arrived:])) <= len(frames.pictures) - arrived, "it moves"
    brown = [browns(picture) for picture in frames.pictures[arrived - 2 : arrived + 2]]
    assert max(brown[:2]) < 100 < 1000 < min(brown[2:]), "only the arm's scene has a table"
    assert all(
        curve[-1][0] == pytest.approx(shot.duration, abs=0.1) for curve in shot.curves.values()
    )


def test_where_nothing_can_be_drawn_the_reason_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    shot = shot_in_a_process("disable", monkeypatch)
    assert shot.frames.pictures == ()
    assert shot.frames.trouble
    page = page_of([shot])
    assert "No pictures here" in page
    assert "libegl1" in page


TREE = (
    TreeSkill("place", 0, (Span(0.5, 2.0, Status.FAILED),)),
    TreeSkill("Reach(above)", 1, (Span(0.5, 1.0, Status.SUCCEEDED), Span(1.5, 2.0, Status.FAILED))),
    TreeSkill("Reach(down)", 1, ()),
)


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
        tree=TREE,
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
document.title = document.querySelector("output").textContent
  + ", " + document.querySelector(".skill").textContent;
document.querySelector("button").click();
</script></body>"""


def test_names_have_room_before_their_bars() -> None:
    early, late = "slow_down", "soften_when_hammering_on_a_table"
    shot = made_up(Arm.ROSSMARIE, {late: [(1.5, 2.0)], early: [(0.5, 1.0), (1.2, 1.3)]})
    axis = axis_of([shot])
    first, second = rules_of(shot, axis).rows
    assert (first.name, second.name) == (early, late)
    assert [bar.kind for bar in first.bars] == ["active", "active"]
    assert axis.left > 7 * len(late), "as wide as letters are"
    assert second.bars[-1].x + second.bars[-1].width <= WIDTH


def test_a_skill_is_shown_while_it_runs_and_with_what_came_of_it() -> None:
    shot = made_up(Arm.ROSSMARIE, {})
    axis = axis_of([made_up(Arm.NONE, {}), shot])
    root, reach, never = tree_of(shot, axis).rows
    assert [bar.kind for bar in root.bars] == ["running", "failed"]
    assert [bar.kind for bar in reach.bars] == ["running", "succeeded", "running", "failed"]
    begins = [bar.x for bar in reach.bars]
    assert begins == [axis.x_of(time) for time in (0.5, 1.0, 1.5, 2.0)]
    assert reach.bars[1].x + reach.bars[1].width == pytest.approx(reach.bars[2].x, abs=0.2)
    assert (root.x, never.x, never.bars) == (0.0, reach.x, ())
    assert root.x < reach.x


def test_what_still_runs_in_the_end_has_no_result() -> None:
    tree = (TreeSkill("place", 0, (Span(1.0, None, Status.RUNNING),)),)
    shot = replace(made_up(Arm.NONE, {}), tree=tree)
    axis = axis_of([shot])
    (row,) = tree_of(shot, axis).rows
    (bar,) = row.bars
    assert bar.kind == "running"
    assert bar.x + bar.width == pytest.approx(axis.x_of(shot.duration), abs=0.1)
    assert running_of(tree, shot.duration) == [("place", 1.0, 4.0)]


def test_of_a_tree_the_leaves_are_told_while_they_run() -> None:
    assert [name for name, _, _ in running_of(TREE, 2.0)] == ["Reach(above)", "Reach(above)"]


@needs_browser
def test_the_player_shows_frames_and_active_rules(tmp_path: Path) -> None:
    shots = [made_up(Arm.NONE, {}), made_up(Arm.ROSSMARIE, {"slow_down": [(0.0, 1.0)]})]
    path = tmp_path / "page.html"
    path.write_text(page_of(shots), encoding="utf-8")
    still = document_of(path)
    assert still.count('src="data:image/webp;base64,') == 2
    assert '<span class="rules">slow_down</span>' in still
    assert '<span class="skill"></span>' in still, "nothing has started"
    assert "0.0 s, 1.0 times as fast" in still
    path.write_text(page_of(shots).replace("</body>", DRIVEN), encoding="utf-8")
    played = document_of(path)
    assert "<title>1.5 s, 1.0 times as fast, Reach(above)</title>" in played
    assert re.search(r"<output>(1\.[5-9]|[234]\.)", played), "time has passed"
    assert '<span class="rules">slow_down</span>' not in played
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
