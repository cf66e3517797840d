// Plays the films of a section in step, shows the values at the pointer, and hides what is not chosen.
"use strict";

const ROOM = 1.025; // the time axis goes on a little, so that the sign of an end is seen

for (const section of document.querySelectorAll("section[data-experiment]")) {
  const data = JSON.parse(section.querySelector("script").textContent);
  const slider = section.querySelector(".slider input");
  const button = section.querySelector(".player button");
  const speed = section.querySelector("select");
  const output = section.querySelector("output");
  const plots = section.querySelector(".plots");
  const track = section.querySelector(".cursor-track");
  const pointer = section.querySelector(".pointer");
  const boxes = [...section.querySelectorAll(".arms input")];
  const figures = [...section.querySelectorAll("figure")];
  const charts = [...section.querySelectorAll(".chart")].map(read);
  const sources = data.films.map((film) =>
    film.pictures.map((picture) => "data:image/webp;base64," + picture));
  let before = null;

  // A chart as numbers: what is drawn is also what is reported at the pointer.
  function read(element) {
    const { low, high, digits, unit } = element.dataset;
    const { width, height } = element.querySelector("svg").viewBox.baseVal;
    const toValue = (y) => Number(high) - (Number(high) - Number(low)) * y / height;
    const curves = [...element.querySelectorAll("polyline")].map((line) => ({
      arm: line.classList[1],
      points: line.getAttribute("points").split(" ").map((point) => point.split(",").map(Number))
        .map(([x, y]) => [x / width * data.duration, toValue(y)]),
    }));
    return { curves, digits: Number(digits), unit, reported: element.querySelector(".values") };
  }

  // Between the two points that an instant lies between; nothing after the end.
  function valueAt(points, time) {
    const after = points.findIndex(([at]) => at >= time);
    if (after < 0) return null;
    if (after === 0) return points[0][1];
    const [[t0, v0], [t1, v1]] = [points[after - 1], points[after]];
    return t1 === t0 ? v1 : v0 + (v1 - v0) * (time - t0) / (t1 - t0);
  }

  // No zero with a sign.
  function text(value, digits) {
    return (Number(value.toFixed(digits)) + 0).toFixed(digits);
  }

  function chosen() {
    return boxes.filter((box) => box.checked).map((box) => box.value);
  }

  function tell(time) {
    const arms = chosen();
    for (const { curves, digits, unit, reported } of charts) {
      reported.replaceChildren(...curves.filter(({ arm }) => arms.includes(arm)).map(({ arm, points }) => {
        const value = valueAt(points, time);
        const span = document.createElement("span");
        span.className = arm;
        span.textContent = value === null ? "over" : text(value, digits) + " " + unit;
        return span;
      }));
    }
  }

  // The names of those spans that an instant is in.
  function at(spans, time) {
    return spans.filter(([, from, to]) => from <= time && time < to).map(([name]) => name).join(", ");
  }

  function show(time) {
    data.films.forEach((film, index) => {
      const last = sources[index].length - 1;
      const image = figures[index].querySelector("img");
      if (image) image.src = sources[index][Math.min(last, Math.floor(time / film.period))];
      const isOver = time >= film.duration;
      figures[index].querySelector(".skill").textContent = isOver ? "over" : at(film.skills, time);
      figures[index].querySelector(".rules").textContent = isOver ? "" : at(film.rules, time);
    });
    section.querySelector(".cursor").style.left = 100 * time / data.duration + "%";
    output.textContent = time.toFixed(1) + " s";
    tell(time);
  }

  function seek(time) {
    slider.value = Math.max(0, Math.min(time, end()));
    show(Number(slider.value));
  }

  function step(now) {
    if (button.textContent !== "pause") return;
    const passed = before === null ? 0 : (now - before) / 1000 * Number(speed.value);
    before = now;
    seek(Number(slider.value) + passed);
    if (Number(slider.value) >= end()) button.textContent = "play";
    requestAnimationFrame(step);
  }

  // When the last of the chosen films is over.
  function end() {
    const arms = chosen();
    const ends = data.films.filter((film) => arms.includes(film.arm)).map((film) => film.duration);
    return Math.min(data.duration, Math.max(0.1, ...ends));
  }

  function choose() {
    const arms = chosen();
    for (const element of section.querySelectorAll(".of")) {
      element.classList.toggle("absent", !arms.some((arm) => element.classList.contains(arm)));
    }
    section.style.setProperty("--zoom", data.duration / (end() * ROOM));
    section.style.setProperty("--slider-zoom", data.duration / end());
    slider.max = end();
    show(Number(slider.value));
  }

  function timeOf(event) {
    const { left, width } = track.getBoundingClientRect();
    return (event.clientX - left) / width * end() * ROOM;
  }

  button.addEventListener("click", () => {
    const isPlaying = button.textContent === "pause";
    button.textContent = isPlaying ? "play" : "pause";
    if (isPlaying) return;
    if (Number(slider.value) >= end()) slider.value = 0;
    before = null;
    requestAnimationFrame(step);
  });
  slider.addEventListener("input", () => show(Number(slider.value)));
  for (const box of boxes) box.addEventListener("change", choose);
  for (const jump of section.querySelectorAll(".jumps button")) {
    jump.addEventListener("click", () => seek(Number(jump.dataset.time)));
  }
  plots.addEventListener("pointermove", (event) => {
    const time = timeOf(event);
    const isInside = time >= 0 && time <= end();
    pointer.style.display = isInside ? "block" : "none";
    pointer.style.left = 100 * time / data.duration + "%";
    tell(isInside ? time : Number(slider.value));
  });
  plots.addEventListener("pointerleave", () => {
    pointer.style.display = "none";
    tell(Number(slider.value));
  });
  plots.addEventListener("click", (event) => {
    const time = timeOf(event);
    if (time >= 0 && time <= end()) seek(time);
  });
  choose();
}
