// What the picture shows: a row for the axis, one for each rule, one for each signal.
// A row has `draw(view, frame)`; the frame is the room of its drawing, in pixels.

const LANE = 32;
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
    for (const [at, back] of replay.jumps) {
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
  for (const [at] of replay.jumps) {
    if (at < view.from || at > view.to) continue;
    const x = frame.toX(at);
    drawing.append(svg("path", { class: "backward", d: `M${x} 0V${height}` }));
  }
}

class LaneRow extends Row {
  constructor(rule) {
    super("lane", LANE, rule.name);
    this.rule = rule;
    const count = rule.spans.length;
    this.drawing.setAttribute("tabindex", "0");
    this.drawing.setAttribute("role", "img");
    this.drawing.setAttribute("aria-label",
      `Rule ${rule.name}: ${count} active span${count === 1 ? "" : "s"}`);
  }

  draw(view, frame, chosen) {
    this.start(frame);
    drawBackground(this.drawing, view, frame, LANE);
    let rightmost = -1;
    this.rule.spans.forEach((span) => {
      if (span.to < view.from || span.from > view.to) return;
      const from = Math.max(frame.toX(span.from), frame.left);
      const to = Math.min(Math.max(frame.toX(span.to), from + 3), frame.right);
      // Spans that share their pixels with the one before would only thicken the page.
      if (to <= rightmost && span !== chosen) return;
      rightmost = to;
      const state = span === chosen ? " chosen" : "";
      this.drawing.append(svg("rect", {
        class: "span " + span.kind + state,
        x: from, y: 7, width: Math.max(to - from, 1), height: LANE - 14, rx: 2.5,
      }));
      if (span.open && frame.toX(span.to) <= frame.right + 1 && to - from > 12) {
        const middle = LANE / 2;
        this.drawing.append(svg("path", {
          class: "open-end", d: `M${to - 8} ${middle - 4}l4 4l-4 4`,
        }));
      }
    });
    this.drawTotal(frame);
  }

  drawTotal(frame) {
    if (frame.narrow) return;
    const count = this.rule.spans.length;
    this.drawing.append(svg("text", { x: frame.right + 10, y: LANE / 2 + 4 },
      ...(count ? [svg("tspan", { class: "strong" }, `${count} ×`), `  ${this.rule.total}`]
        : ["never active"])));
  }

  // The span at or nearest to an instant, if it is within a few pixels.
  spanAt(instant, tolerance) {
    let best = null;
    let distance = tolerance;
    for (const span of this.rule.spans) {
      const away = Math.max(span.from - instant, instant - span.to, 0);
      if (away < distance || (away === 0 && distance === 0)) [best, distance] = [span, away];
      if (span.from > instant + tolerance) break;
    }
    return best;
  }
}

class PlotRow extends Row {
  constructor(plot, place) {
    const reading = html("span", { class: "reading" });
    const unit = plot.unit && plot.unit !== "1" ? plot.unit : "";
    super("plot", PLOT, plot.text, unit ? html("small", {}, "in " + unit) : null, reading);
    this.plot = plot;
    this.unit = unit;
    this.reading = reading;
    this.clip = "beyond-" + place;
    this.range = valueRange(plot);
    const activating = plot.thresholds.filter((one) => !one.releases);
    const rules = new Set(activating.flatMap((one) => one.rules));
    this.rules = replay.rules.filter((rule) => rules.has(rule.name));
    this.regions = activating.flatMap((one) => one.regions)
      .map((ends) => ends.map(Number.parseFloat))
      .filter((ends) => !isUsual(plot, ends));
    this.drawing.setAttribute("role", "img");
    this.drawing.setAttribute("aria-label", `Signal ${plot.text}${unit ? " in " + unit : ""}`);
  }

  toY(value) {
    const [low, high] = this.range;
    const share = (Math.min(Math.max(value, low), high) - low) / (high - low);
    return 6 + (1 - share) * (PLOT - 12);
  }

  draw(view, frame) {
    this.start(frame);
    drawBackground(this.drawing, view, frame, PLOT);
    this.drawValueTicks(frame);
    this.drawSpans(view, frame);
    this.drawRegions(frame);
    this.drawLine(view, frame);
    this.drawLimits(frame);
    this.dot = svg("circle", { class: "dot", r: 3.5, visibility: "hidden" });
    this.drawing.append(this.dot);
  }

  drawValueTicks(frame) {
    for (const tick of valueTicks(...this.range)) {
      const y = this.toY(tick);
      this.drawing.append(
        svg("path", { class: "grid", d: `M${frame.left} ${y}H${frame.right}` }),
        svg("text", { x: frame.left - 7, y: y + 4, "text-anchor": "end" }, formatNumber(tick)));
    }
  }

  // The rules that watch this signal, as a tint behind it. Of a latched rule only the beginning:
  // what follows says nothing of the signal.
  drawSpans(view, frame) {
    for (const rule of this.rules) {
      let rightmost = -1;
      for (const span of rule.spans) {
        const to = rule.latched ? span.from : span.to;
        if (to < view.from || span.from > view.to) continue;
        const x = Math.max(frame.toX(span.from), frame.left);
        const right = Math.min(Math.max(frame.toX(to), x + 1.5), frame.right);
        if (right <= rightmost) continue;
        rightmost = right;
        this.drawing.append(svg("rect", {
          class: "band " + span.kind, x, y: 0, width: right - x, height: PLOT,
        }));
      }
    }
  }

  drawRegions(frame) {
    const clip = svg("clipPath", { id: this.clip });
    for (const [low, high] of this.regions) {
      const bottom = low === -Infinity ? PLOT : this.toY(low);
      const top = high === Infinity ? 0 : this.toY(high);
      const box = { x: frame.left, y: top, height: bottom - top, width: frame.right - frame.left };
      clip.append(svg("rect", box));
      this.drawing.append(svg("rect", { class: "region", ...box }));
    }
    this.drawing.append(clip);
  }

  drawLine(view, frame) {
    const toY = (value) => this.toY(value);
    const end = Math.min(frame.toX(replay.duration), frame.right);
    const { line, gaps } = linePaths(this.plot, view, frame.toX, toY, end);
    const bottom = PLOT - 4;
    const group = svg("g", { "clip-path": "url(#frame)" },
      svg("path", { class: "line", d: line }),
      svg("path", { class: "line beyond", d: line, "clip-path": `url(#${this.clip})` }),
      svg("path", {
        class: "unknown", d: gaps.map(([from, to]) => `M${from} ${bottom}H${to}`).join(""),
      }));
    for (const [from, to] of gaps) {
      const [left, right] = [Math.max(from, frame.left), Math.min(to, frame.right)];
      if (right - left < 60) continue;
      const middle = (left + right) / 2;
      group.append(svg("text", { x: middle, y: bottom - 5, "text-anchor": "middle" }, "unknown"));
    }
    this.drawing.append(group);
  }

  drawLimits(frame) {
    const labels = [];
    const [low, high] = this.range;
    for (const threshold of this.plot.thresholds) {
      for (const limit of threshold.limits) {
        const kind = threshold.releases ? " releases" : "";
        const y = this.toY(limit);
        const arrow = limit > high ? "↑ " : limit < low ? "↓ " : "";
        if (!arrow) {
          const d = `M${frame.left} ${y}H${frame.right}`;
          this.drawing.append(svg("path", { class: "limit" + kind, d }));
        }
        labels.push({ y, kind, text: arrow + formatNumber(limit) + " " + this.unit, threshold });
      }
    }
    spread(labels, 13, 6, PLOT - 8);
    for (const label of labels) this.drawLimitLabel(label, frame);
  }

  drawLimitLabel({ y, kind, text, threshold }, frame) {
    const room = frame.narrow ? 26 : Math.floor((frame.width - frame.right - 10) / 6.4) - text.length;
    const whole = `${threshold.text}, ${threshold.releases ? "clears" : "for"} ${threshold.rules.join(", ")}`;
    this.drawing.append(svg("text", {
      class: "limit-text" + kind + (frame.narrow ? " halo" : ""),
      x: frame.narrow ? frame.right - 3 : frame.right + 10,
      y: frame.narrow ? y - 4 : y + 4,
      "text-anchor": frame.narrow ? "end" : "start",
    }, text.trim(), svg("tspan", { class: "of", dx: 6 }, shorten(threshold.text, room)),
    svg("title", {}, whole)));
  }

  read(instant, frame) {
    const value = instant === null ? NaN : valueAt(this.plot, instant);
    this.dot?.setAttribute("visibility", Number.isNaN(value) ? "hidden" : "visible");
    this.reading.textContent = instant === null ? ""
      : Number.isNaN(value) ? "unknown" : `${formatNumber(value)} ${this.unit}`;
    if (Number.isNaN(value)) return;
    this.dot.setAttribute("cx", frame.toX(instant));
    this.dot.setAttribute("cy", this.toY(value));
  }
}
