// From the data in the page to the picture.

const host = document.getElementById("rows");
const lanes = paired((run) => run.rules, (rule) => rule.name).map((pair) => new LaneRow(pair));
const plots = paired((run) => run.plots, (plot) => plot.text);
const rows = [
  new AxisRow(),
  ...lanes,
  ...plots.map((pair) => new PlotRow(mergedPlot(pair))),
];
host.append(...rows.map((row) => row.element));
document.querySelector(".patterns").append(
  svg("clipPath", { id: "frame" }, svg("rect", { id: "frame-box", y: 0, height: PLOT })));
const view = new View(host, rows, document.getElementById("card"));
document.querySelector(".zoom").hidden = false;
signalChooser(view);
imageButtons(view);
view.draw();

for (const button of document.querySelectorAll(".jump")) {
  button.addEventListener("click", () => {
    const lane = view.lanes[Number(button.dataset.rule)];
    lane.drawing.scrollIntoView({ block: "center" });
    lane.drawing.focus();
    view.visit(lane, lane.spans.find((span) => span.rule.run === runs[0]));
  });
}

// A link to a line of the rules opens the file that the line is in.
function openSource() {
  const line = document.getElementById(location.hash.slice(1));
  const source = line?.closest("details");
  if (!source || source.open) return;
  source.open = true;
  line.scrollIntoView({ block: "center" });
}
window.addEventListener("hashchange", openSource);
openSource();

const CHANGE_WORDS = { activated: "active", activated_stale: "active, an input is stale", cleared: "cleared" };
const changes = document.getElementById("changes");
changes.addEventListener("toggle", () => {
  const all = runs.flatMap((run) => run.changes).sort((one, other) => one.at - other.at);
  const rowsOfChanges = all.map((change) => html("tr", {},
    html("td", {}, formatPosition(change.at)),
    isCompared ? html("td", {}, change.rule.run.label) : null,
    html("td", {}, change.rule.name),
    html("td", {}, CHANGE_WORDS[change.change]),
    html("td", {}, change.cause.text)));
  changes.append(html("table", {}, html("tbody", {}, ...rowsOfChanges)));
}, { once: true });

document.documentElement.dataset.ready = "true";
