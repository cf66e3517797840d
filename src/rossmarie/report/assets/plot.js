// The row of a signal: its line, its limits, and the spans of the rules that compare it.

class PlotRow extends Row {
  constructor(plot) {
    const reading = html("span", { class: "reading" });
    const unit = plot.unit && plot.unit !== "1" ? plot.unit : "";
    const small = (text) => (text ? html("small", { "data-image": "" }, text) : null);
    super("plot", PLOT, html("span", { class: "text", "data-image": "" }, plot.text),
      small(unit && "in " + unit), small(plot.only && `only in ${plot.only}`), reading);
    this.plot = plot;
    this.unit = unit;
    this.reading = reading;
    PlotRow.count = (PlotRow.count ?? 0) + 1;
    this.clip = "beyond-" + PlotRow.count;
    this.range = valueRange(plot);
    const activating = plot.thresholds.filter((one) => !one.releases && !one.isOther);
    const rules = new Set(activating.flatMap((one) => one.rules));
    this.rules = plot.run.rules.filter((rule) => rules.has(rule.name));
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
    const endOf = (plot) => Math.min(frame.toX(plot.run.duration), frame.right);
    if (this.plot.other) {
      const other = linePaths(this.plot.other, view, frame.toX, toY, endOf(this.plot.other));
      this.drawing.append(svg("path", {
        class: "line other", d: other.line, "clip-path": "url(#frame)",
      }));
    }
    const end = endOf(this.plot);
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
        const kind = (threshold.releases ? " releases" : "") + (threshold.isOther ? " other" : "");
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
    const { other } = this.plot;
    this.reading.textContent = instant === null ? ""
      : this.readingOf(value) + (other ? ` / ${this.readingOf(valueAt(other, instant))}` : "");
    if (Number.isNaN(value)) return;
    this.dot.setAttribute("cx", frame.toX(instant));
    this.dot.setAttribute("cy", this.toY(value));
  }

  readingOf(value) {
    return Number.isNaN(value) ? "unknown" : `${formatNumber(value)} ${this.unit}`;
  }
}
