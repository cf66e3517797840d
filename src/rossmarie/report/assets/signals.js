// Signals that a reader adds: every recorded number on the topics of the rules.

function signalChooser(view) {
  const select = document.getElementById("add-signal");
  const signals = paired((run) => run.recorded, (plot) => plot.text).map(mergedPlot);
  select.parentElement.hidden = signals.length === 0;
  const groups = new Map();
  signals.forEach((plot, place) => {
    const [topic] = plot.text.split(" ");
    if (!groups.has(topic)) groups.set(topic, html("optgroup", { label: topic }));
    const words = plot.text.slice(topic.length + 1) || topic;
    groups.get(topic).append(html("option", { value: place }, words));
  });
  select.append(...groups.values());
  select.addEventListener("change", () => {
    const option = select.selectedOptions[0];
    const row = new PlotRow(signals[Number(select.value)]);
    const remove = html("button", { type: "button", class: "remove", title: "Remove this signal" },
      "Remove");
    remove.addEventListener("click", () => {
      view.remove(row);
      option.disabled = false;
    });
    row.element.firstChild.append(remove);
    option.disabled = true;
    select.value = "";
    view.add(row);
    row.element.scrollIntoView({ block: "nearest" });
  });
}
