// Which stretch of time is shown, and how pointer and keys move it.

class View {
  constructor(host, rows, card) {
    this.host = host;
    this.rows = rows;
    this.card = card;
    this.lanes = rows.filter((row) => row instanceof LaneRow);
    this.plots = rows.filter((row) => row instanceof PlotRow);
    this.length = Math.max(longest, 0.001);
    this.from = 0;
    this.to = this.length;
    this.instant = null;
    this.chosen = null;
    this.pinned = false;
    this.cursor = html("div", { class: "cursor", hidden: "" }, html("span"));
    this.selection = html("div", { class: "selection", hidden: "" });
    host.append(this.cursor, this.selection);
    this.listen();
  }

  // --- rows ----------------------------------------------------------------------------------

  add(row) {
    this.rows.push(row);
    this.plots.push(row);
    this.host.insertBefore(row.element, this.cursor);
    this.draw();
  }

  remove(row) {
    this.rows.splice(this.rows.indexOf(row), 1);
    this.plots.splice(this.plots.indexOf(row), 1);
    row.element.remove();
  }

  // --- drawing -------------------------------------------------------------------------------

  measure() {
    const width = Math.max(this.rows[0].drawing.getBoundingClientRect().width, 120);
    const narrow = width < 560 || innerWidth <= 760;
    const left = 46;
    const right = width - (narrow ? 14 : 178);
    const scale = (right - left) / (this.to - this.from);
    const toX = (instant) => left + (instant - this.from) * scale;
    this.frame = { width, narrow, left, right, toX };
  }

  draw() {
    this.measure();
    const { left, right } = this.frame;
    document.getElementById("frame-box").setAttribute("x", left);
    document.getElementById("frame-box").setAttribute("width", right - left);
    for (const row of this.rows) row.draw(this, this.frame, this.chosen);
    const decimals = Math.max(1, decimalsFor((this.to - this.from) / 100));
    document.getElementById("window").textContent =
      `${formatPosition(this.from, decimals)} – ${formatPosition(this.to, decimals)}`;
    const isSeen = this.instant >= this.from && this.instant <= this.to;
    if (this.instant !== null && isSeen) this.point(this.instant);
    else this.leave();
  }

  drawSoon() {
    if (this.waiting) return;
    this.waiting = requestAnimationFrame(() => {
      this.waiting = null;
      this.draw();
    });
  }

  show(from, to) {
    const shortest = Math.min(0.02, this.length);
    const length = Math.min(Math.max(to - from, shortest), this.length);
    const start = Math.min(Math.max((from + to - length) / 2, 0), this.length - length);
    this.from = start;
    this.to = start + length;
    this.drawSoon();
  }

  zoom(factor, around = (this.from + this.to) / 2) {
    this.show(around - (around - this.from) * factor, around + (this.to - around) * factor);
  }

  pan(seconds) {
    const shift = Math.min(Math.max(seconds, -this.from), this.length - this.to);
    this.show(this.from + shift, this.to + shift);
  }

  reset() {
    this.show(0, this.length);
  }

  // --- pointing ------------------------------------------------------------------------------

  instantAt(event) {
    const box = this.rows[0].drawing.getBoundingClientRect();
    const { left, right } = this.frame;
    const x = Math.min(Math.max(event.clientX - box.left, left), right);
    return this.from + ((x - left) / (right - left)) * (this.to - this.from);
  }

  laneOf(event) {
    return this.lanes.find((lane) => lane.drawing.contains(event.target));
  }

  point(instant) {
    this.instant = instant;
    const { left } = this.rows[0].drawing.getBoundingClientRect();
    const offset = left - this.host.getBoundingClientRect().left;
    const x = this.frame.toX(instant);
    this.cursor.hidden = false;
    this.cursor.style.left = offset + x + "px";
    this.cursor.classList.toggle("flipped", x > this.frame.right - 80);
    const decimals = Math.max(1, decimalsFor((this.to - this.from) / 400));
    this.cursor.firstChild.textContent = formatPosition(instant, decimals);
    for (const plot of this.plots) plot.read(instant, this.frame);
  }

  leave() {
    this.instant = null;
    this.cursor.hidden = true;
    for (const plot of this.plots) plot.read(null, this.frame);
    if (!this.pinned) this.choose(null);
  }

  choose(span) {
    const next = span ?? null;
    if (next === this.chosen) return;
    this.chosen = next;
    this.card.classList.remove("pinned");
    this.pinned = false;
    if (next) fillCard(this.card, next);
    else this.card.hidden = true;
    for (const row of this.lanes) row.draw(this, this.frame, next);
  }

  hover(event) {
    if (this.drag) return this.dragTo(event);
    if (!event.target.closest("svg")) return this.leave();
    const instant = this.instantAt(event);
    this.point(instant);
    if (this.pinned) return undefined;
    const lane = this.laneOf(event);
    const perPixel = (this.to - this.from) / (this.frame.right - this.frame.left);
    const box = lane?.drawing.getBoundingClientRect();
    this.choose(lane?.spanAt(instant, 5 * perPixel, lane.runAt(event.clientY - box.top)));
    if (this.chosen) {
      placeCard(this.card, event.clientX, box.top, box.bottom);
    }
    return undefined;
  }

  // --- dragging ------------------------------------------------------------------------------

  press(event) {
    if (event.button !== 0 || !event.target.closest("svg")) return;
    if (event.pointerType === "touch") return;
    this.drag = {
      x: event.clientX, instant: this.instantAt(event), from: this.from, pans: event.shiftKey,
    };
    this.host.setPointerCapture(event.pointerId);
  }

  dragTo(event) {
    const { drag } = this;
    if (drag.pans) {
      const perPixel = (this.to - this.from) / (this.frame.right - this.frame.left);
      this.pan(drag.from - (event.clientX - drag.x) * perPixel - this.from);
      return;
    }
    const ends = [drag.instant, this.instantAt(event)].sort((one, other) => one - other);
    const offset = this.rows[0].drawing.getBoundingClientRect().left
      - this.host.getBoundingClientRect().left;
    this.selection.hidden = Math.abs(event.clientX - drag.x) < 4;
    this.selection.style.left = offset + this.frame.toX(ends[0]) + "px";
    this.selection.style.width = this.frame.toX(ends[1]) - this.frame.toX(ends[0]) + "px";
  }

  cancel() {
    this.drag = null;
    this.selection.hidden = true;
  }

  release(event) {
    const { drag } = this;
    if (!drag) return;
    const selected = !this.selection.hidden;
    this.cancel();
    if (selected) {
      const ends = [drag.instant, this.instantAt(event)].sort((one, other) => one - other);
      this.show(...ends);
    } else if (Math.abs(event.clientX - drag.x) < 4) {
      this.pinned = Boolean(this.chosen) && !this.pinned;
      this.card.classList.toggle("pinned", this.pinned);
      if (!this.pinned) this.choose(null);
    }
  }

  // --- keys ----------------------------------------------------------------------------------

  key(event) {
    const step = (this.to - this.from) / 5;
    const actions = {
      "+": () => this.zoom(0.6), "=": () => this.zoom(0.6), "-": () => this.zoom(1 / 0.6),
      0: () => this.reset(), Escape: () => this.choose(null),
      PageUp: () => this.pan(-step), PageDown: () => this.pan(step),
    };
    const lane = this.lanes.find((one) => one.drawing === event.target);
    if (lane) {
      actions.ArrowRight = () => this.walk(lane, 1);
      actions.ArrowLeft = () => this.walk(lane, -1);
    }
    if (event.ctrlKey || event.metaKey || event.altKey || !actions[event.key]) return;
    event.preventDefault();
    actions[event.key]();
  }

  walk(lane, direction) {
    const { spans } = lane;
    const place = spans.indexOf(this.chosen);
    const next = place < 0 ? (direction > 0 ? 0 : spans.length - 1) : place + direction;
    if (spans[next]) this.visit(lane, spans[next]);
  }

  // Shows a span with its cause, moving the view to it if need be.
  visit(lane, span) {
    const length = this.to - this.from;
    if (span.from < this.from || span.from > this.to) {
      this.show(span.from - length / 3, span.from + (2 * length) / 3);
      this.draw();
    }
    this.choose(span);
    this.point(span.from);
    const box = lane.drawing.getBoundingClientRect();
    placeCard(this.card, box.left + this.frame.toX(span.from), box.top, box.bottom);
    document.getElementById("spoken").textContent = spoken(span);
  }

  // --- listening -----------------------------------------------------------------------------

  listen() {
    const on = (type, act, options) => this.host.addEventListener(type, act, options);
    on("pointermove", (event) => this.hover(event));
    on("pointerleave", () => this.leave());
    on("pointerdown", (event) => this.press(event));
    on("pointerup", (event) => this.release(event));
    on("pointercancel", () => this.cancel());
    on("dblclick", () => this.reset());
    on("keydown", (event) => this.key(event));
    on("wheel", (event) => this.wheel(event), { passive: false });
    new ResizeObserver(() => this.drawSoon()).observe(this.host);
    const click = (id, act) => document.getElementById(id).addEventListener("click", act);
    click("zoom-in", () => this.zoom(0.6));
    click("zoom-out", () => this.zoom(1 / 0.6));
    click("zoom-reset", () => this.reset());
  }

  // A plain wheel scrolls the page, as everywhere; pinching on a touchpad arrives as Ctrl + wheel.
  wheel(event) {
    const sideways = event.shiftKey ? event.deltaY || event.deltaX : event.deltaX;
    if (event.ctrlKey || event.metaKey) {
      this.zoom(Math.exp(Math.min(Math.max(event.deltaY, -60), 60) * 0.006), this.instantAt(event));
    } else if (event.shiftKey || Math.abs(sideways) > Math.abs(event.deltaY)) {
      this.pan((sideways / 600) * (this.to - this.from));
    } else {
      return;
    }
    event.preventDefault();
  }
}
