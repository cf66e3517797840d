// From the data in the page to the picture.

const replay = JSON.parse(document.getElementById("replay").textContent);

for (const rule of replay.rules) {
  rule.spans = rule.spans.map(([from, to, stale, opened, closed, open, length]) => ({
    from, to, length, opened, closed, open: Boolean(open), kind: stale ? "stale" : "active",
  }));
}
for (const plot of replay.plots) decodeSeries(plot, replay.duration);

const host = document.getElementById("rows");
const rows = [
  new AxisRow(),
  ...replay.rules.map((rule) => new LaneRow(rule)),
  ...replay.plots.map((plot, place) => new PlotRow(plot, place)),
];
host.append(...rows.map((row) => row.element));
document.querySelector(".patterns").append(
  svg("clipPath", { id: "frame" }, svg("rect", { id: "frame-box", y: 0, height: PLOT })));
const view = new View(host, rows, document.getElementById("card"));
document.querySelector(".zoom").hidden = false;
view.draw();

for (const button of document.querySelectorAll(".jump")) {
  button.addEventListener("click", () => {
    const lane = view.lanes[Number(button.dataset.rule)];
    lane.drawing.scrollIntoView({ block: "center" });
    lane.drawing.focus();
    view.visit(lane, lane.rule.spans[0]);
  });
}

const CHANGE_WORDS = { activated: "active", activated_stale: "active, an input is stale", cleared: "cleared" };
const changes = document.getElementById("changes");
changes.addEventListener("toggle", () => {
  const rowsOfChanges = replay.changes.map((change) => html("tr", {},
    html("td", {}, formatPosition(change.at)),
    html("td", {}, replay.rules[change.rule].name),
    html("td", {}, CHANGE_WORDS[change.change]),
    html("td", {}, change.cause.text)));
  changes.append(html("table", {}, html("tbody", {}, ...rowsOfChanges)));
}, { once: true });

document.documentElement.dataset.ready = "true";
