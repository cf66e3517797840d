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

from heron import demo
from heron.cli import main
from heron.cli.main import app
from heron.demo import Shot, page_of, shoot
from heron.demo.charts import chart_of, time_ticks
from heron.demo.frames import DemoFrames
from heron.demo.lanes import rules_of, tree_of
from heron.evaluation import Folder
from heron.experiments import EXPERIMENTS, run_placing
from heron.experiments.experiment import COMPLETED, INTERVENTIONS
from heron.tasks import SkillSpan, Status, TreeSkill
from heron.tasks.tree import running_of
from heron.variants import ExperimentArm, Table
from support.browser import document_of, needs_browser

# The least WebP that there is.
PICTURE = bytes.fromhex("524946461a000000574542505650384c0d0000002f00000010071011118888fe0700")


def shot_in_a_process(
    renderer: str, monkeypatch: pytest.MonkeyPatch, name: str = "place", variant: str = "high"
) -> Shot:
    """An episode. Only a new process looks at how to draw."""
    monkeypatch.setenv("MUJOCO_GL", renderer)
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        return pool.submit(shoot, name, variant, ExperimentArm.ROSSMARIE, 3).result()


def browns(picture: bytes) -> int:
    """The number of pixels with the color of a table."""
    with Image.open(io.BytesIO(picture)) as shown:
        pixels = np.asarray(shown.convert("RGB"), dtype=int)
    red, green, blue = pixels[..., 0], pixels[..., 1], pixels[..., 2]
    return int(np.sum((red > green + 20) & (green > blue + 20)))


@pytest.mark.deep  # `test_films.py` draws in each run
@needs(EGL)
def test_a_film_shows_the_episode_and_changes_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    shot = shot_in_a_process("egl", monkeypatch)
    plain = run_placing(ExperimentArm.ROSSMARIE, Table.HIGH, 3)
    assert (shot.reported, shot.duration) == (plain.reported, plain.measures.duration)
    assert shot.measures["above 30 N"] == f"{plain.measures.time_above_30_n:.2f} s"
    assert shot.frames.trouble == ""
    assert len(shot.frames.pictures) * shot.frames.period == pytest.approx(shot.duration, abs=0.3)
    assert len(set(shot.frames.pictures)) > 40, "it moves"
    with Image.open(io.BytesIO(shot.frames.pictures[-1])) as picture:
        assert picture.size == (480, 270)
        assert len(picture.convert("RGB").getcolors(2**18) or []) > 500, "there is something on it"
    assert [skill.label for skill in shot.tree] == ["place", "PutDown"]
    activated = [at for at, words in shot.reported if "soften_when_hammering activated" in words]
    assert shot.rules["soften_when_hammering"][0][0] == pytest.approx(activated[0], abs=0.021)
    assert 0.0 < activated[0] - shot.onsets["hammering"] < 0.5


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


def test_where_nothing_can_be_drawn_the_reason_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    shot = shot_in_a_process("disable", monkeypatch)
    assert shot.frames.pictures == ()
    assert shot.frames.trouble
    page = page_of([shot])
    assert "No pictures here" in page
    assert "libegl1" in page


def test_the_demo_shows_episodes_as_most_are() -> None:
    """The rows in the documentation say which outcome is the most frequent one of an arm."""
    rows = Folder(Path(__file__).parents[2] / "docs").results().experiments
    for name, experiment in EXPERIMENTS.items():
        variant = next(iter(experiment.variants))
        for arm in experiment.arms:
            outcomes = {
                row.seed: (row.numbers[COMPLETED.name], row.numbers[INTERVENTIONS.name])
                for row in rows[name]
                if (row.variant, row.arm) == (variant, arm.value)
            }
            usual = max(set(outcomes.values()), key=list(outcomes.values()).count)
            assert outcomes[main._SHOWN_SEED] == usual, (name, arm)


# --- the page --------------------------------------------------------------------------------

TREE = (
    TreeSkill("place", 0, (SkillSpan(0.5, 2.0, Status.FAILED),)),
    TreeSkill(
        "Reach(above)",
        1,
        (SkillSpan(0.5, 1.0, Status.SUCCEEDED), SkillSpan(1.5, 2.0, Status.FAILED)),
    ),
    TreeSkill("Reach(down)", 1, ()),
)


def made_up(arm: ExperimentArm, rules: dict[str, list[tuple[float, float]]]) -> Shot:
    return Shot(
        experiment="place",
        arm=arm,
        title="a <table>",
        is_completed=arm is ExperimentArm.ROSSMARIE,
        duration=8.0 if arm is ExperimentArm.DEROS else 2.0,
        measures={"task": "completed", "peak force": f"{len(rules)}17 N"},
        reported=((0.5, "</script><b>said</b>"),),
        onsets={"hammering": 0.25},
        rules=rules,
        tree=TREE,
        curves={
            signal.label: [(0.0, -1e-9), (1.0, 42.0), (2.0, 3.0)]
            for signal in EXPERIMENTS["place"].signals
        },
        frames=DemoFrames((PICTURE,) * 3, 1.0),
    )


def test_the_page_needs_nothing_else_and_names_stay_names() -> None:
    page = page_of(
        [
            made_up(ExperimentArm.NONE, {}),
            made_up(ExperimentArm.ROSSMARIE, {"</script>": [(0.0, 1.0)]}),
        ]
    )
    assert not re.findall(r"(?:src|href)=|url\(|https?://|@import", page.replace("image.src", ""))
    assert page.count("</script>") == 2, "that of the data, and that of the code"
    assert "a &lt;table&gt;" in page
    assert "117 N" in page


def test_a_chart_has_a_grid_and_its_limit() -> None:
    signal = next(one for one in EXPERIMENTS["place"].signals if one.limit == 30.0)
    chart = chart_of(signal, [made_up(ExperimentArm.NONE, {})], 4.0)
    assert chart.low < 0.0 < 42.0 < chart.high
    assert [tick.text for tick in chart.ticks] == ["0", "20", "40"]
    zero, twenty, forty = (tick.at for tick in chart.ticks)
    assert 0 < forty < twenty < zero < 100
    assert chart.limit is not None
    assert chart.limit.at == pytest.approx((twenty + forty) / 2, abs=0.02)
    (line,) = chart.lines
    assert [point.split(",")[0] for point in line.points.split()] == ["0", "250", "500"]
    assert [tick.text for tick in time_ticks(4.0)][:2] == ["0 s", "0.5 s"]


def test_rules_are_shown_in_the_order_in_which_they_became_active() -> None:
    shot = made_up(
        ExperimentArm.ROSSMARIE, {"late": [(1.5, 2.0)], "early": [(0.5, 1.0), (1.2, 1.3)]}
    )
    first, second = rules_of(shot, 4.0).rows
    assert (first.name, second.name) == ("early", "late")
    assert [(bar.kind, bar.left, bar.width) for bar in first.bars] == [
        ("active", 12.5, 12.5),
        ("active", 30.0, 2.5),
    ]
    assert second.bars[-1].left + second.bars[-1].width <= 100


def test_a_skill_is_shown_while_it_runs_and_with_what_came_of_it() -> None:
    root, reach, never = tree_of(made_up(ExperimentArm.ROSSMARIE, {}), 4.0).rows
    assert [bar.kind for bar in root.bars] == ["running", "failed"]
    assert [bar.kind for bar in reach.bars] == ["running", "succeeded", "running", "failed"]
    assert [bar.left for bar in reach.bars] == [12.5, 25.0, 37.5, 50.0]
    assert reach.bars[1].left + reach.bars[1].width == pytest.approx(reach.bars[2].left)
    assert (root.depth, never.depth, never.bars) == (0, reach.depth, ())


def test_what_still_runs_in_the_end_has_no_result() -> None:
    tree = (TreeSkill("place", 0, (SkillSpan(1.0, None, Status.RUNNING),)),)
    shot = replace(made_up(ExperimentArm.NONE, {}), tree=tree)
    (row,) = tree_of(shot, 4.0).rows
    (bar,) = row.bars
    assert (bar.kind, bar.left, bar.width) == ("running", 25.0, 25.0)
    assert running_of(tree, shot.duration) == [("place", 1.0, 2.0)]


def test_of_a_tree_the_leaves_are_reported_while_they_run() -> None:
    assert [name for name, _, _ in running_of(TREE, 2.0)] == ["Reach(above)", "Reach(above)"]


SHOTS = [
    made_up(ExperimentArm.NONE, {}),
    made_up(ExperimentArm.DEROS, {"stop": [(0.5, 2.0)]}),
    made_up(ExperimentArm.ROSSMARIE, {"slow_down": [(0.0, 2.0)]}),
]


def document_after(tmp_path: Path, script: str = "") -> str:
    """The page in a browser, after what the script does in it."""
    path = tmp_path / "page.html"
    page = page_of(SHOTS).replace("</body>", f"<script>{script}</script></body>")
    path.write_text(page, encoding="utf-8")
    return document_of(path)


@needs_browser
def test_the_player_opens_at_the_hazard_and_shows_frames_rules_and_values(tmp_path: Path) -> None:
    still = document_after(tmp_path)
    assert still.count('src="data:image/webp;base64,') == 3
    later = EXPERIMENTS["place"].opening[1]
    assert f"<output>{min(0.25 + later, 2.0):.1f} s</output>" in still
    assert "hammering, ROSSMARie (0.2 s)" in still
    assert '<option value="1" selected="">1 × real time</option>' in still  # noqa: RUF001


@needs_browser
def test_the_player_plays_at_the_speed_that_is_chosen(tmp_path: Path) -> None:
    played = document_after(
        tmp_path,
        """
        const input = document.querySelector(".slider input");
        input.value = 0.1;
        input.dispatchEvent(new Event("input"));
        document.title = document.querySelector("output").textContent
          + ", " + document.querySelector(".values").textContent;
        document.querySelector("select").value = "4";
        let now = 0;  // a screen that is drawn every 100 ms
        window.requestAnimationFrame = (draw) => setTimeout(() => draw(now += 100), 1);
        document.querySelector(".player button").click();
        """,
    )
    assert "<title>0.1 s, 4.2 N4.2 N</title>" in played, "between two points of the curve"
    assert "<output>2.0 s</output>" in played, "it stops when the chosen films are over"
    assert ">play<" in played


@needs_browser
def test_arms_that_are_not_chosen_are_hidden_and_the_axis_follows(tmp_path: Path) -> None:
    script = """
        const box = (name) => document.querySelector(`input[value=${name}]`);
        const section = document.querySelector("section");
        const zoom = () => Number(section.style.getPropertyValue("--zoom")).toFixed(1);
        const shown = () => [...document.querySelectorAll("figure")]
          .filter((one) => one.offsetParent !== null).map((one) => one.classList[1]).join(" ");
        const before = shown() + " " + zoom();
        box("deros").click();
        document.title = before + " | " + shown() + " " + zoom();
        """
    found = document_after(tmp_path, script)
    assert "<title>none rossmarie 3.9 | none deros rossmarie 1.0</title>" in found


@needs_browser
def test_values_are_reported_at_the_pointer_and_a_click_goes_there(tmp_path: Path) -> None:
    script = """
        const track = document.querySelector(".cursor-track").getBoundingClientRect();
        const at = { clientX: track.left + track.width / 4, bubbles: true };
        const plots = document.querySelector(".plots");
        plots.dispatchEvent(new PointerEvent("pointermove", at));
        const reported = document.querySelector(".values").textContent;
        const before = document.querySelector("output").textContent;
        plots.dispatchEvent(new MouseEvent("click", at));
        document.title = reported + " | " + before + " | "
          + document.querySelector("output").textContent;
        """
    found = document_after(tmp_path, script)
    assert re.search(r"<title>21\.\d N21\.\d N \| 2\.0 s \| 0\.5 s</title>", found), "of 2.05 s"


# --- the command -----------------------------------------------------------------------------


def test_the_comparison_is_printed_and_the_page_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("MUJOCO_GL", "disable")  # set by the command otherwise
    shots = [made_up(ExperimentArm.NONE, {}), made_up(ExperimentArm.ROSSMARIE, {})]
    shots += [
        replace(
            shot,
            experiment=name,
            onsets={},
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


@pytest.mark.parametrize("arm", ExperimentArm)
def test_each_arm_has_a_color_in_light_and_in_dark(arm: ExperimentArm) -> None:
    style = (Path(demo.__file__).parent / "assets" / "demo.css").read_text(encoding="utf-8")
    assert len(re.findall(rf"--{arm.value}: #", style)) == 2
    assert f".{arm.value} {{ --arm: var(--{arm.value}); }}" in style
