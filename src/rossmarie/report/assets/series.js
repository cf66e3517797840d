// The samples of a plot: decoding, looking up, and the shape of its line. A value holds until the
// next time; NaN is unknown.

function decode(text, Type) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  return new Type(bytes.buffer);
}

function decodeSeries(plot, duration) {
  const ticks = decode(plot.times, Uint32Array);
  plot.times = Float64Array.from(ticks, (tick) => (tick / 4294967295) * duration);
  plot.values = decode(plot.values, Float32Array);
}

// The place of the last sample at or before an instant; -1 before the first.
function placeAt(times, instant) {
  let low = 0;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle] <= instant) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

function valueAt(plot, instant) {
  const place = placeAt(plot.times, instant);
  return place < 0 ? NaN : plot.values[place];
}

// The range of the axis. Limits belong to it unless they would flatten the signal: those are
// pointed at from the edge.
function valueRange(plot) {
  let low = Infinity;
  let high = -Infinity;
  for (const value of [plot, plot.other].flatMap((each) => (each ? [...each.values] : []))) {
    if (Number.isFinite(value)) {
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  }
  const limits = plot.thresholds.flatMap((threshold) => threshold.limits);
  if (low > high) [low, high] = limits.length ? [Math.min(...limits), Math.max(...limits)] : [0, 1];
  const extent = high - low || Math.abs(high) || 1;
  for (const limit of limits) {
    if (limit > low - 5 * extent && limit < high + 5 * extent) {
      low = Math.min(low, limit);
      high = Math.max(high, limit);
    }
  }
  const margin = (high - low || Math.abs(high) || 1) * 0.08;
  return [low - margin, high + margin];
}

// Whether the signal is in a stretch for most of its time. A limit that is usually passed, such as
// "the robot moves", is drawn, but passing it is nothing to point at.
function isUsual(plot, [low, high]) {
  let inside = 0;
  let known = 0;
  for (let i = 0; i + 1 < plot.times.length; i += 1) {
    const value = plot.values[i];
    if (Number.isNaN(value)) continue;
    const length = plot.times[i + 1] - plot.times[i];
    known += length;
    if (value >= low && value <= high) inside += length;
  }
  return inside > known / 2;
}

// One path for the known stretches and one for the gaps. Samples that fall into one column of
// pixels become its first, least, greatest and last value, so no spike is lost.
function linePaths(plot, view, toX, toY, right) {
  const known = [];
  const gaps = [];
  const last = Math.min(placeAt(plot.times, view.to) + 1, plot.times.length - 1);
  let column = null;
  let drawing = false;
  let gapFrom = null;
  const flush = () => {
    if (!column) return;
    const { x, first, low, high, end } = column;
    known.push(drawing ? `H${x}V${first}` : `M${x} ${first}`);
    if (low !== high) known.push(`V${low}V${high}`);
    known.push(`V${end}`);
    drawing = true;
    column = null;
  };
  for (let i = Math.max(placeAt(plot.times, view.from), 0); i <= last; i += 1) {
    const x = Math.round(toX(plot.times[i]) * 2) / 2;
    if (Number.isNaN(plot.values[i])) {
      flush();
      if (drawing) known.push(`H${x}`);
      drawing = false;
      gapFrom ??= x;
      continue;
    }
    if (gapFrom !== null) gaps.push([gapFrom, x]);
    gapFrom = null;
    const y = Math.round(toY(plot.values[i]) * 10) / 10;
    if (column && column.x !== x) flush();
    column ??= { x, first: y, low: y, high: y };
    column.low = Math.min(column.low, y);
    column.high = Math.max(column.high, y);
    column.end = y;
  }
  flush();
  if (drawing) known.push(`H${right}`);
  if (gapFrom !== null) gaps.push([gapFrom, right]);
  return { line: known.join(""), gaps };
}
