// The card that says why a rule became active or cleared.

const GLYPHS = { true: "✓", false: "✗", unknown: "?", stale: "?" };
const TRUTH_VALUE_WORDS = { true: "true", false: "false", unknown: "unknown", stale: "unknown" };
const STATE_WORDS = {
  never: "has never been received",
  expired: "is older than its timeout",
  unusable: "has no usable value",
};

function spanTimes(span) {
  const until = span.open ? "still active at the end" : "until " + formatPosition(span.to);
  return `from ${formatPosition(span.from)} ${until}, ${span.length}`;
}

function conditionRow(condition) {
  const measured = condition.values.map((value) => `${value.signal} = ${value.shown}`).join(", ");
  const named = condition.name && condition.name !== condition.text;
  return html("tr", {},
    html("td", {},
      html("span", { class: "truth " + condition.truth, "aria-hidden": "true" },
        GLYPHS[condition.truth]),
      TRUTH_VALUE_WORDS[condition.truth]),
    html("td", {},
      named ? html("strong", {}, condition.name) : null,
      named ? html("small", {}, condition.text) : condition.text,
      measured ? html("span", { class: "measured" }, measured) : null),
    html("td", { class: "since" }, "since " + formatPosition(condition.since_s)));
}

function causeBlock(change) {
  if (!change) return [html("p", { class: "because" }, "Its cause is in the verdicts file.")];
  const stale = change.cause.stale_inputs.map((input) => html("p", { class: "because" },
    html("span", { class: "truth stale", "aria-hidden": "true" }, "?"),
    html("strong", {}, input.name), ` (${input.topic}) ${STATE_WORDS[input.state]}`));
  const rows = change.cause.conditions.map(conditionRow);
  return [...stale, ...(rows.length ? [html("table", {}, html("tbody", {}, ...rows))] : [])];
}

function fillCard(card, span) {
  const { rule, opened, closed } = span;
  const fill = { class: "span " + span.kind, x: 1, y: 1, width: 20, height: 9, rx: 2 };
  const facts = html("dl");
  const fact = (term, ...texts) => facts.append(html("dt", {}, term), html("dd", {}, ...texts));
  if (isCompared) fact("Run", rule.run.label);
  fact("Rule", html("a", { href: `#line-${rule.source}-${rule.line}` }, `line ${rule.line} of ${rule.file}`));
  if (rule.categories.length) fact("Category", rule.categories.join(", "));
  if (rule.actions.length) fact("Actions", rule.actions.join(", "));
  if (opened?.done.length) fact("Would do", ...opened.done.map((line) => html("div", {}, line)));
  fact("Contract", rule.contract);
  if (closed) fact("Cleared", `${formatPosition(span.to)}: ${closed.cause.text}`);
  card.replaceChildren(
    html("h3", {}, svg("svg", { viewBox: "0 0 22 11" }, svg("rect", fill)), rule.name),
    html("p", { class: "when" }, "Active " + spanTimes(span)),
    ...causeBlock(opened),
    facts);
}

function spoken({ rule, opened, ...span }) {
  const run = isCompared ? ` in ${rule.run.label}` : "";
  return `${rule.name}${run}, active ${spanTimes(span)}. ${opened ? opened.cause.text : ""}`;
}

// Beside the pointer or span, on the side where there is room.
function placeCard(card, x, top, bottom) {
  card.hidden = false;
  const { width, height } = card.getBoundingClientRect();
  const left = Math.min(Math.max(12, x + 14), innerWidth - width - 12);
  const below = bottom + 12;
  const y = below + height < innerHeight ? below : Math.max(8, top - height - 12);
  card.style.left = left + "px";
  card.style.top = y + "px";
}
