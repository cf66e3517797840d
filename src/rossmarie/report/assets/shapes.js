// Elements. Text from the replay only ever becomes a text node or an attribute, never markup.

function build(create, tag, attributes, children) {
  const element = create(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== null && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

function html(tag, attributes = {}, ...children) {
  return build((name) => document.createElement(name), tag, attributes, children);
}

function svg(tag, attributes = {}, ...children) {
  const space = "http://www.w3.org/2000/svg";
  return build((name) => document.createElementNS(space, name), tag, attributes, children);
}

function shorten(text, length) {
  return text.length > length ? text.slice(0, length - 1) + "…" : text;
}

// Moves labels apart that would overlap, and keeps them between two heights.
function spread(labels, distance, top, bottom) {
  labels.sort((one, other) => one.y - other.y);
  let next = top;
  for (const label of labels) {
    label.y = Math.max(label.y, next);
    next = label.y + distance;
  }
  let previous = bottom;
  for (const label of [...labels].reverse()) {
    label.y = Math.min(label.y, previous);
    previous = label.y - distance;
  }
}
