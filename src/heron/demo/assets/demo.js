// Plays the films of a section in step, and moves the cursors of its charts along.
"use strict";

for (const section of document.querySelectorAll("section[data-experiment]")) {
  const data = JSON.parse(section.querySelector("script").textContent);
  const slider = section.querySelector("input");
  const button = section.querySelector("button");
  const output = section.querySelector("output");
  const cursors = [...section.querySelectorAll(".cursor")];
  const figures = [...section.querySelectorAll("figure")];
  const axis = section.querySelector("svg .axis");
  const left = axis.x1.baseVal.value;
  const right = axis.ownerSVGElement.viewBox.baseVal.width - 12;
  const sources = data.films.map((film) =>
    film.pictures.map((picture) => "data:image/webp;base64," + picture));
  let before = null;

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
    const x = left + (right - left) * time / data.duration;
    for (const cursor of cursors) {
      cursor.setAttribute("x1", x);
      cursor.setAttribute("x2", x);
    }
    output.textContent = time.toFixed(1) + " s, " + data.speed.toFixed(1) + " times as fast";
  }

  function step(now) {
    if (button.textContent !== "pause") return;
    const time = Number(slider.value) + (before === null ? 0 : (now - before) / 1000 * data.speed);
    before = now;
    slider.value = Math.min(time, data.duration);
    if (time >= data.duration) button.textContent = "play";
    show(Number(slider.value));
    requestAnimationFrame(step);
  }

  button.addEventListener("click", () => {
    const isPlaying = button.textContent === "pause";
    button.textContent = isPlaying ? "play" : "pause";
    if (isPlaying) return;
    if (Number(slider.value) >= data.duration) slider.value = 0;
    before = null;
    requestAnimationFrame(step);
  });
  slider.addEventListener("input", () => show(Number(slider.value)));
  show(0);
}
