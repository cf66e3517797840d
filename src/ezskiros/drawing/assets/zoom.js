// A picture that fills its window: the wheel zooms, dragging pans. In another page it stays still.

const root = document.documentElement;
const isAlone = root.nodeName === "svg";
const all = root.querySelector(".all");
const view = { x: 0, y: 0, scale: 1 };
const LEAST = 0.05;
const MOST = 8;
let tools = null;

function make(name, attributes, ...children) {
  const element = document.createElementNS(root.namespaceURI, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}

function draw() {
  all.setAttribute("transform", `translate(${view.x} ${view.y}) scale(${view.scale})`);
}

function fit() {
  const box = all.getBBox();
  const margin = 24;
  const room = [innerWidth / (box.width + 2 * margin), innerHeight / (box.height + 2 * margin)];
  view.scale = Math.max(Math.min(1, ...room), LEAST);
  view.x = (margin - box.x) * view.scale;
  view.y = (margin - box.y) * view.scale;
  draw();
}

function zoom(factor, x = innerWidth / 2, y = innerHeight / 2) {
  const scale = Math.min(Math.max(view.scale * factor, LEAST), MOST);
  view.x = x - ((x - view.x) * scale) / view.scale;
  view.y = y - ((y - view.y) * scale) / view.scale;
  view.scale = scale;
  draw();
}

// Buttons are groups with a frame and a text, in the lower left corner.
function addButton(label, title, act) {
  const width = 20 + 8 * label.length;
  const left = [...tools.children].reduce((sum, each) => sum + Number(each.dataset.width) + 6, 0);
  const button = make("g", {
    class: "button", role: "button", tabindex: 0, "data-width": width, "aria-label": title,
    transform: `translate(${left} 0)`,
  },
  make("rect", { width, height: 28, rx: 6 }),
  make("text", { x: width / 2, y: 19, "text-anchor": "middle" }, label),
  make("title", {}, title));
  onPress(button, act);
  tools.append(button);
}

function onPress(element, act) {
  element.addEventListener("click", act);
  element.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    act(event);
  });
}

function placeTools() {
  tools.setAttribute("transform", `translate(12 ${innerHeight - 40})`);
}

function listen() {
  let from = null;
  root.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoom(Math.exp(-Math.min(Math.max(event.deltaY, -60), 60) * 0.005), event.clientX, event.clientY);
  }, { passive: false });
  root.addEventListener("pointerdown", (event) => {
    if (event.button === 0) from = { x: event.clientX - view.x, y: event.clientY - view.y, event };
  });
  root.addEventListener("pointermove", (event) => {
    if (!from) return;
    if (Math.hypot(event.clientX - from.event.clientX, event.clientY - from.event.clientY) > 4) {
      from.isDragged = true;
    }
    if (!from.isDragged) return;
    view.x = event.clientX - from.x;
    view.y = event.clientY - from.y;
    draw();
  });
  root.addEventListener("pointerup", () => {
    root.toggleAttribute("data-dragged", Boolean(from?.isDragged));
    from = null;
  });
  root.addEventListener("click", (event) => {
    if (root.hasAttribute("data-dragged")) event.stopPropagation();
  }, { capture: true });
  const keys = { "+": () => zoom(1.25), "=": () => zoom(1.25), "-": () => zoom(0.8), 0: fit };
  root.addEventListener("keydown", (event) => {
    if (!event.ctrlKey && !event.metaKey) keys[event.key]?.();
  });
  addEventListener("resize", placeTools);
}

function start() {
  root.setAttribute("width", "100%");
  root.setAttribute("height", "100%");
  root.setAttribute("role", "group");
  root.removeAttribute("viewBox");
  root.setAttribute("style", "touch-action: none");
  root.querySelector(".paper").setAttribute("width", "100%");
  root.querySelector(".paper").setAttribute("height", "100%");
  tools = root.appendChild(make("g", { class: "tools" }));
  placeTools();
  addButton("−", "Zoom out (−)", () => zoom(0.8));
  addButton("+", "Zoom in (+)", () => zoom(1.25));
  addButton("Fit", "Show all of it (0)", fit);
  listen();
  fit();
}

if (isAlone) start();
