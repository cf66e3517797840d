// The rows of the picture: one for the axis, one for each rule; `plot.js` has those of signals.
// A row has `draw(view, frame)`; the frame is the room of its drawing, in pixels.

const LANE = 32;
const STRIP = 20;
const PLOT = 112;
const AXIS = 26;

class Row {
  constructor(kind, height, ...name) {
    this.height = height;
    this.drawing = svg("svg");
    this.element = html("div", { class: "row " + kind },
      html("div", { class: "name" }, ...name), this.drawing);
  }

  start(frame) {
    this.drawing.setAttribute("viewBox", `0 0 ${frame.width} ${this.height}`);
    this.drawing.replaceChildren();
  }
}

class AxisRow extends Row {
  constructor() {
    super("axis", AXIS, "");
    this.drawing.setAttribute("aria-hidden", "true");
  }

  draw(view, frame) {
    this.start(frame);
    const { ticks, decimals } = timeTicks(view.from, view.to, frame.right - frame.left);
    for (const tick of ticks) {
      const x = frame.toX(tick);
      this.drawing.append(
        svg("path", { class: "axis-line", d: `M${x} ${AXIS - 5}V${AXIS}` }),
        svg("text", { x, y: AXIS - 10, "text-anchor": "middle" }, formatPosition(tick, decimals)));
    }
    for (const [at, back] of jumps) {
      if (at < view.from || at > view.to) continue;
      const label = `↶ clock back ${back}`;
      this.drawing.append(svg("text", { class: "strong halo", x: frame.toX(at) + 4, y: 12 }, label));
    }
  }
}

function drawBackground(drawing, view, frame, height) {
  for (const tick of timeTicks(view.from, view.to, frame.right - frame.left).ticks) {
    const x = frame.toX(tick);
    drawing.append(svg("path", { class: "grid", d: `M${x} 0V${height}` }));
  }
  for (const [at] of jumps) {
    if (at < view.from || at > view.to) continue;
    const x = frame.toX(at);
    drawing.append(svg("path", { class: "backward", d: `M${x} 0V${height}` }));
  }
}

// A rule: its spans in one strip, or those of two runs in two strips, one above the other.
class LaneRow extends Row {
  constructor(pair) {
    const rules = pair.filter(Boolean);
    const [{ name, source, line, file }] = rules;
    const title = `Line ${line} of ${file}`;
    super("lane", isCompared ? 2 * STRIP + 8 : LANE,
      html("a", { href: `#line-${source}-${line}`, title, "data-image": "" }, name));
    this.name = name;
    this.pair = pair;
    this.spans = rules.flatMap((rule) => rule.spans).sort((one, other) => one.from - other.from);
    this.drawing.setAttribute("tabindex", "0");
    this.drawing.setAttribute("role", "img");
    const counts = rules.map((rule) => {
      const count = rule.spans.length;
      const run = isCompared ? ` in ${rule.run.label}` : "";
      return `${count} active span${count === 1 ? "" : "s"}${run}`;
    });
    this.drawing.setAttribute("aria-label", `Rule ${name}: ${counts.join(", ")}`);
  }

  // The strip of a run: where it begins, and its height.
  strip(number) {
    return isCompared ? { top: 4 + number * STRIP, height: STRIP } : { top: 0, height: LANE };
  }

  draw(view, frame, chosen) {
    this.start(frame);
    drawBackground(this.drawing, view, frame, this.height);
    this.pair.forEach((rule, number) => {
      const strip = this.strip(number);
      if (rule) this.drawStrip(rule, strip, view, frame, chosen);
      this.drawTotal(rule, runs[number], strip, frame);
    });
  }

  drawStrip(rule, { top, height }, view, frame, chosen) {
    const space = isCompared ? 2 : 7;
    let rightmost = -1;
    for (const span of rule.spans) {
      if (span.to < view.from || span.from > view.to) continue;
      const from = Math.max(frame.toX(span.from), frame.left);
      const to = Math.min(Math.max(frame.toX(span.to), from + 3), frame.right);
      // Spans that share their pixels with the one before would only thicken the page.
      if (to <= rightmost && span !== chosen) continue;
      rightmost = to;
      const state = span === chosen ? " chosen" : "";
      this.drawing.append(svg("rect", {
        class: "span " + span.kind + state,
        x: from, y: top + space, width: Math.max(to - from, 1), height: height - 2 * space, rx: 2.5,
      }));
      if (span.open && frame.toX(span.to) <= frame.right + 1 && to - from > 12) {
        this.drawing.append(svg("path", {
          class: "open-end", d: `M${to - 8} ${top + height / 2 - 4}l4 4l-4 4`,
        }));
      }
    }
  }

  drawTotal(rule, run, { top, height }, frame) {
    if (frame.narrow) return;
    const count = rule?.spans.length ?? 0;
    const words = !rule ? ["no such rule"]
      : count ? [svg("tspan", { class: "strong" }, `${count} ×`), `  ${rule.total}`] : ["never active"];
    const label = isCompared ? svg("tspan", {}, `${shorten(run.label, 14)}: `) : null;
    const text = svg("text", { x: frame.right + 10, y: top + height / 2 + 4 }, label, ...words);
    if (isCompared) text.append(svg("title", {}, run.label));
    this.drawing.append(text);
  }

  // The run whose strip is at a height of the drawing, in pixels.
  runAt(y) {
    return runs[isCompared && y >= 4 + STRIP ? 1 : 0];
  }

  // The span of a run at or nearest to an instant, if it is within some seconds.
  spanAt(instant, tolerance, run) {
    let best = null;
    let distance = tolerance;
    for (const span of this.spans) {
      if (span.rule.run !== run) continue;
      const away = Math.max(span.from - instant, instant - span.to, 0);
      if (away < distance || (away === 0 && distance === 0)) [best, distance] = [span, away];
      if (span.from > instant + tolerance) break;
    }
    return best;
  }
}
