// The picture as a file: the rows as they are in view, with their colours written into each shape,
// so that a drawing program or a document shows the same.

const SHOWN = ["fill", "stroke", "stroke-width", "stroke-dasharray", "stroke-linejoin",
  "paint-order", "font-family", "font-size", "font-weight"];
const IMAGE_MARGIN = 18;
const LINE_HEIGHT = 16;

function withStyles(node) {
  if (node.nodeType !== Node.ELEMENT_NODE) return node.cloneNode();
  const copy = node.cloneNode(false);
  copy.removeAttribute("class");
  const style = getComputedStyle(node);
  for (const name of SHOWN) setStyle(copy, name, style.getPropertyValue(name));
  for (const child of node.childNodes) {
    if (child.nodeName !== "title") copy.append(withStyles(child));
  }
  return copy;
}

// Not every drawing program knows rgba(): the opacity becomes an attribute of its own.
function setStyle(element, name, value) {
  const [, red, green, blue, alpha] = value.match(/^rgba\((.+), (.+), (.+), (.+)\)$/) ?? [];
  element.setAttribute(name, alpha ? `rgb(${red}, ${green}, ${blue})` : value.replaceAll('"', ""));
  if (alpha) element.setAttribute(`${name}-opacity`, alpha);
}

function textAt(x, y, text, element, attributes = {}) {
  const style = getComputedStyle(element);
  return svg("text", {
    x, y, fill: style.color, "font-family": style.fontFamily.replaceAll('"', ""),
    "font-size": style.fontSize, "font-weight": style.fontWeight, ...attributes,
  }, text);
}

// A text in lines of at most so many pixels.
function wrapped(text, element, width) {
  const style = getComputedStyle(element);
  const context = document.createElement("canvas").getContext("2d");
  context.font = `${style.fontWeight} ${style.fontSize} ${style.fontFamily}`;
  const lines = [""];
  for (const part of text.split(/(?<=[ ._()\[\]])/)) {
    const longer = lines[lines.length - 1] + part;
    if (context.measureText(longer.trim()).width > width && lines[lines.length - 1]) lines.push(part);
    else lines[lines.length - 1] = longer;
  }
  return lines.map((line) => line.trim());
}

function rowImage(row, label, top) {
  const group = svg("g", { transform: `translate(0 ${top})` });
  const name = row.element.querySelector(".name");
  const parts = [...name.children].filter((each) => each.dataset.image !== undefined);
  const texts = parts.flatMap((each) => wrapped(each.textContent, each, label - 10)
    .map((line) => [line, each]));
  const middle = row instanceof LaneRow ? row.height / 2 - (texts.length - 1) * LINE_HEIGHT / 2 + 4 : 20;
  texts.forEach(([line, element], place) =>
    group.append(textAt(IMAGE_MARGIN, middle + place * LINE_HEIGHT, line, element)));
  const drawing = svg("g", { transform: `translate(${IMAGE_MARGIN + label} 0)` });
  drawing.append(...[...row.drawing.childNodes].map(withStyles));
  group.append(drawing);
  return { group, height: Math.max(row.height, middle + texts.length * LINE_HEIGHT - 6) };
}

function legendImage(top, width) {
  const group = svg("g");
  let [x, y] = [IMAGE_MARGIN, top];
  for (const item of document.querySelectorAll(".legend li")) {
    const length = item.getBoundingClientRect().width || 120;
    if (x + length > width - IMAGE_MARGIN && x > IMAGE_MARGIN) [x, y] = [IMAGE_MARGIN, y + LINE_HEIGHT];
    const key = svg("g", { transform: `translate(${x} ${y})` });
    key.append(...[...item.querySelector("svg").children].map(withStyles));
    group.append(key, textAt(x + 33, y + 10, item.textContent.trim(), item));
    x += length + 18;
  }
  return { group, bottom: y + LINE_HEIGHT + 4 };
}

// The whole picture as an element, with its width and height in pixels.
function imageOf(view) {
  const label = view.frame.narrow ? 130 : 186;
  const width = view.frame.width + label + 2 * IMAGE_MARGIN;
  const title = document.querySelector("h1");
  const picture = svg("svg");
  const patterns = document.querySelector(".patterns").cloneNode(false);
  patterns.append(...[...document.querySelector(".patterns").children].map(withStyles));
  const titles = wrapped(title.textContent.replace(/\s+/g, " ").trim(), title, width - 2 * IMAGE_MARGIN);
  picture.append(svg("defs", {}, ...patterns.childNodes),
    svg("rect", { width: "100%", height: "100%", fill: getComputedStyle(document.querySelector(".chart")).backgroundColor }),
    ...titles.map((line, place) => textAt(IMAGE_MARGIN, 36 + place * 28, line, title)));
  const legend = legendImage(50 + (titles.length - 1) * 28, width);
  picture.append(legend.group);
  let top = legend.bottom;
  for (const row of view.rows) {
    const { group, height } = rowImage(row, label, top);
    picture.append(group);
    top += height + 1;
  }
  const height = Math.ceil(top + IMAGE_MARGIN);
  picture.setAttribute("width", Math.ceil(width));
  picture.setAttribute("height", height);
  picture.setAttribute("viewBox", `0 0 ${Math.ceil(width)} ${height}`);
  return picture;
}

function save(blob, ending) {
  const address = URL.createObjectURL(blob);
  html("a", { href: address, download: `timeline.${ending}` }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

function imageBlob(view) {
  const text = new XMLSerializer().serializeToString(imageOf(view));
  return new Blob([text], { type: "image/svg+xml" });
}

const LONGEST_SIDE = 16_000; // pixels: browsers draw no longer canvas

// Twice as many pixels as on the page, for papers and slides; fewer for a very long page.
function savePixels(view) {
  const address = URL.createObjectURL(imageBlob(view));
  const image = new Image();
  image.addEventListener("load", () => {
    const scale = Math.min(2, LONGEST_SIDE / Math.max(image.width, image.height));
    const canvas = html("canvas", { width: scale * image.width, height: scale * image.height });
    canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
    canvas.toBlob((blob) => save(blob, "png"));
    URL.revokeObjectURL(address);
  });
  image.src = address;
}

function imageButtons(view) {
  const click = (id, act) => document.getElementById(id).addEventListener("click", act);
  click("save-svg", () => save(imageBlob(view), "svg"));
  click("save-png", () => savePixels(view));
}
