// Seconds -> text, and where to put the ticks of an axis.

const STEPS = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120,
  300, 600, 900, 1800, 3600, 7200, 14400, 43200, 86400];

function formatPosition(seconds, decimals = 1) {
  const scale = 10 ** decimals;
  const units = Math.round(Math.abs(seconds) * scale);
  const whole = Math.floor(units / scale);
  const two = (number) => String(number).padStart(2, "0");
  const hours = Math.floor(whole / 3600);
  const start = (seconds < 0 && units > 0 ? "−" : "") + (hours ? hours + ":" : "");
  const fraction = decimals ? "." + String(units % scale).padStart(decimals, "0") : "";
  return start + two(Math.floor(whole / 60) % 60) + ":" + two(whole % 60) + fraction;
}

function formatNumber(value) {
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  return String(Number(value.toPrecision(4))).replace("-", "−");
}

// As many decimals as tell neighbouring ticks, or neighbouring pixels, apart.
function decimalsFor(step) {
  return Math.min(3, Math.max(0, Math.ceil(-Math.log10(step) - 1e-9)));
}

function timeTicks(from, to, width) {
  const wanted = (to - from) / Math.max(2, width / 92);
  const step = STEPS.find((candidate) => candidate >= wanted) ?? STEPS[STEPS.length - 1];
  const ticks = [];
  for (let count = Math.ceil(from / step - 1e-9); count * step <= to + step * 1e-9; count += 1) {
    ticks.push(count * step);
  }
  return { ticks, decimals: decimalsFor(step) };
}

function valueTicks(low, high) {
  const rough = (high - low) / 4;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 2.5, 5, 10].map((factor) => factor * power).find((size) => size >= rough);
  const ticks = [];
  for (let count = Math.ceil(low / step); count * step <= high; count += 1) ticks.push(count * step);
  return ticks;
}
