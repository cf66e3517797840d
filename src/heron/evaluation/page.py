"""The page of an evaluation in Markdown: tables, plots, and the expectations that were met. Every
figure on it is computed from the rows.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib.resources import files

from heron.evaluation.expectation import between
from heron.evaluation.expectations import expectations_of
from heron.evaluation.reasons import REASONS
from heron.evaluation.rows import EpisodeRow, StudyRow
from heron.evaluation.sample import Sample, samples_of
from heron.evaluation.statistics import median, share
from heron.evaluation.study_section import section_of
from heron.evaluation.summary import ReportedExpectation, summary_of, table_of
from heron.experiments import EXPERIMENTS, STUDIES, Experiment, Measure
from heron.experiments.experiment import ARM_NAMES, COMPLETED
from heron.variants import ExperimentArm

_HEAD = """\
# The experiments

<!-- Written by `heron evaluate`; do not edit. -->

The thesis describes its experiments, but gives no figures. So the figures below can neither confirm
nor contradict the thesis. The expectations for the experiment arms come from the text of the
thesis. The thesis does not mention a collision monitor. There the expectation is that ROSSMARie is
no worse. Every experiment runs on the same seeds in these arms:

- *no monitor*
- *collision monitor*: the usual protection of ROS 2 robots. Zones of a range scan slow the robot
  down and stop it, as in [Nav2's collision monitor][nav2]. The robot continues when the zones are
  free. A base never drives faster than 0.25 m/s, the highest speed at which the maker of such a
  base allows bumps (Neobotix MP-500, data sheet). The joystick has precedence, as in
  [twist_mux][mux]. There is no recovery. This arm has no effect in experiment II, because a range
  scan does not measure the height of a table.
- *DeROS*: rules stop the robot until an operator arrives, half a minute later.
- *ROSSMARie*: rules let the robot recover.
- *ROSSMARie with skills*: the rules also know the running skills; in experiments IV and V.
- *ROSSMARie with places*: the rules also know the places ahead; in experiment V only. In that
  experiment, the rules of the arm *ROSSMARie* know only the sensors.
- *ROSSMARie with trees*: the rules let the robot run a behavior tree, and let the planner find
  another path; in experiments VI and VII only.
- *ROSSMARie after learning*: like *ROSSMARie with trees*, but the planner also knows the results of
  earlier runs, which have other seeds; in experiment VII only. In that experiment, the planner of
  the arm *ROSSMARie with trees* knows no earlier runs.

The thesis proposes the last four arms as future work (chapter 5). Their expectations were written
before the runs.

[How to run the experiments](how-to/run-the-experiments.md) describes the random choices of a seed,
and the commands that generate this page.

A cell shows the median over the episodes, and in brackets its 95 % interval (bootstrap). If all
values are the same, there are no brackets. A cell of completed tasks has the interval of the share
(Wilson). If some episodes have no value, the number of the other episodes follows. Arms are
compared seed by seed: the page shows the median of the differences with its interval, and the p of
Wilcoxon's signed-rank test, one-sided.

[nav2]: https://docs.nav2.org/tutorials/docs/using_collision_monitor.html
[mux]: https://docs.ros.org/en/jazzy/p/twist_mux/
"""


@dataclass(frozen=True)
class Results:
    """Rows by the names of the experiments and of the studies."""

    experiments: Mapping[str, Sequence[EpisodeRow]]
    studies: Mapping[str, Sequence[StudyRow]]


def _changes() -> str:
    """The section on changes against the thesis."""
    return files("heron.evaluation").joinpath("assets/changes.md").read_text("utf-8")


def page_of(results: Results, plots: str) -> str:
    """The whole page. `plots` is the folder of the pictures as seen from the page."""
    samples = {
        name: samples_of(EXPERIMENTS[name], rows) for name, rows in results.experiments.items()
    }
    reported = [
        each for found in samples.values() for sample in found for each in _reported(sample)
    ]
    lines = [_HEAD, *summary_of(reported), _changes()]
    if results.studies:
        lines += ["## Influence of our choices", ""]
    for name, rows in results.studies.items():
        lines += section_of(STUDIES[name], rows, results.experiments, plots)
    for name, found in samples.items():
        lines += [f"## Experiment {EXPERIMENTS[name].title}", ""]
        lines += _missing(EXPERIMENTS[name], results.experiments[name])
        for sample in found:
            lines += _section(sample)
        lines += [f"![{EXPERIMENTS[name].title}: every episode]({plots}/{name}.svg)", ""]
    return "\n".join(lines)


# --- expectations --------------------------------------------------------------------------


def _reported(sample: Sample) -> Iterator[ReportedExpectation]:
    for expectation in expectations_of(sample):
        reason = REASONS.get((sample.experiment.name, sample.variant, expectation.key))
        yield ReportedExpectation(_place(sample), expectation, reason)


def _place(sample: Sample) -> str:
    return f"{sample.experiment.title}, {sample.variant}"


# --- tables ----------------------------------------------------------------------------------


def _section(sample: Sample) -> Iterator[str]:
    yield f"### {_place(sample)}"
    yield ""
    yield f"| | {' | '.join(ARM_NAMES[arm] for arm in sample.arms)} |"
    yield f"|---|{'---|' * len(sample.arms)}"
    for measure in sample.experiment.measures:
        if any(sample.values(arm, measure.name) for arm in sample.arms):
            cells = " | ".join(_cell(sample, arm, measure) for arm in sample.arms)
            yield f"| {measure.title} | {cells} |"
    yield ""
    yield from table_of(expectations_of(sample))


def _cell(sample: Sample, arm: ExperimentArm, measure: Measure) -> str:
    total = sample.count(arm)
    if measure is COMPLETED:
        done = sample.completed(arm)
        found = share(done, total)
        return f"{done} of {total} [{100 * found.low:.0f}, {100 * found.high:.0f} %]"
    values = sample.values(arm, measure.name)
    if not values:
        return "-"
    text = between(median(values), measure.digits)
    return text if len(values) == total else f"{text}, of {len(values)}"


def _missing(experiment: Experiment, rows: Sequence[EpisodeRow]) -> Iterator[str]:
    """The episodes that were not finished, although others of their seed were."""
    there = {(row.variant, row.arm, row.seed) for row in rows}
    variants = list(dict.fromkeys(row.variant for row in rows))
    wanted = [
        (variant, arm.value, seed)
        for variant in variants
        for arm in experiment.arms
        for seed in sorted({row.seed for row in rows})
    ]
    missing = [f"{variant}/{arm}/{seed}" for variant, arm, seed in wanted
               if (variant, arm, seed) not in there]  # fmt: skip
    if missing:
        yield f"Not finished: {', '.join(missing)}."
        yield ""
    yield f"Seeds: {len({row.seed for row in rows})}."
    yield ""
