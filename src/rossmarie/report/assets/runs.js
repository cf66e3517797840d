// The runs of the page: one, or two to compare. Rules and signals of two runs meet by their names.

const { runs } = JSON.parse(document.getElementById("replay").textContent);
const isCompared = runs.length > 1;
const longest = Math.max(...runs.map((run) => run.duration));
const jumps = runs.flatMap((run) => run.jumps);

runs.forEach((run, number) => {
  for (const rule of run.rules) {
    rule.run = run;
    rule.spans = rule.spans.map(([from, to, stale, opened, closed, open, length]) => ({
      from, to, length, rule, open: Boolean(open), kind: stale ? "stale" : "active",
      opened: run.changes[opened], closed: run.changes[closed],
    }));
  }
  for (const change of run.changes) change.rule = run.rules[change.rule];
  for (const plot of [...run.plots, ...run.recorded]) {
    decodeSeries(plot, run.duration);
    plot.run = run;
  }
  run.number = number;
});

// Everything that goes by one name: in each run, or null where a run does not have it.
function paired(list, nameOf) {
  const names = new Set(runs.flatMap((run) => list(run).map(nameOf)));
  return [...names].map((name) =>
    runs.map((run) => list(run).find((each) => nameOf(each) === name) ?? null));
}

const isSame = (one, other) => one.length === other.length
  && one.every((value, place) => Object.is(value, other[place]));

// A signal of the first run that has it, with the signal of the second run as `other`. The line and
// the limits of the other run are left out where they are the same.
function mergedPlot(pair) {
  const [plot, other] = pair.filter(Boolean);
  if (!other) return { ...plot, only: isCompared ? plot.run.label : "" };
  const known = new Set(plot.thresholds.map((each) => JSON.stringify([each.limits, each.text])));
  const changed = other.thresholds
    .filter((each) => !known.has(JSON.stringify([each.limits, each.text])))
    .map((each) => ({ ...each, text: `${each.text} (${other.run.label})`, isOther: true }));
  const isOverlaid = isSame(plot.times, other.times) && isSame(plot.values, other.values);
  return {
    ...plot, thresholds: [...plot.thresholds, ...changed], other: isOverlaid ? null : other,
  };
}
