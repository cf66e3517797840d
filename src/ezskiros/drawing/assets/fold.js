// Folds the trees of the picture: a click on a box hides the boxes below it, and the others close
// the gap. The layout is that of `svg.py`; only heights change.

function childrenOf(node) {
  return [...node.querySelectorAll(":scope > .below > .node")];
}

function isFolded(node) {
  return node.hasAttribute("data-folded");
}

function boxOf(node) {
  node.place ??= (([x, y, width, height]) => ({ x, y, width, height, drawnY: y }))(
    node.dataset.box.split(" ").map(Number));
  return node.place;
}

const middleOf = (node) => boxOf(node).y + boxOf(node).height / 2;

function shift(node, distance) {
  boxOf(node).y += distance;
  if (!isFolded(node)) childrenOf(node).forEach((child) => shift(child, distance));
}

// Places a node and all below it from a height downwards; the height at which they end.
function place(node, top) {
  const box = boxOf(node);
  const children = isFolded(node) ? [] : childrenOf(node);
  let bottom = top;
  for (const child of children) bottom = place(child, bottom) + BELOW;
  if (!children.length) {
    box.y = top;
    return top + box.height;
  }
  bottom -= BELOW;
  box.y = (middleOf(children[0]) + middleOf(children[children.length - 1]) - box.height) / 2;
  const missing = Math.max(top - box.y, 0);
  if (missing) shift(node, missing);
  return Math.max(bottom + missing, box.y + box.height);
}

function drawNode(node) {
  const box = boxOf(node);
  node.querySelector(":scope > .own")
    .setAttribute("transform", `translate(0 ${box.y - box.drawnY})`);
  const below = node.querySelector(":scope > .below");
  if (!below) return;
  below.setAttribute("display", isFolded(node) ? "none" : "inline");
  const start = box.x + box.width;
  for (const child of isFolded(node) ? [] : childrenOf(node)) {
    const end = boxOf(child).x;
    const [bend, from, to] = [(start + end) / 2, middleOf(node), middleOf(child)];
    child.previousElementSibling
      .setAttribute("d", `M${start} ${from}C${bend} ${from} ${bend} ${to} ${end} ${to}`);
    drawNode(child);
  }
}

function layOut() {
  let top = MARGIN;
  for (const tree of root.querySelectorAll(".tree")) {
    const caption = tree.querySelector(":scope > text");
    const node = tree.querySelector(":scope > .node");
    if (caption) {
      caption.setAttribute("y", top + FONT);
      top += 2 * LINE;
    }
    top = place(node, top) + 2 * LINE;
    drawNode(node);
  }
}

function fold(node, folded) {
  node.toggleAttribute("data-folded", folded);
  const handle = node.querySelector(":scope > .own");
  handle.setAttribute("aria-expanded", String(!folded));
  handle.querySelector(".sign").textContent = folded ? "+" : "−";
}

function foldAll(folded) {
  for (const node of foldable) fold(node, folded && !node.parentElement.classList.contains("tree"));
  layOut();
  fit();
}

const foldable = isAlone ? [...root.querySelectorAll(".node")].filter((each) => childrenOf(each).length) : [];
for (const node of foldable) {
  const { x, y, width, height } = boxOf(node);
  const own = node.querySelector(":scope > .own");
  const count = node.querySelectorAll(".node").length;
  own.setAttribute("role", "button");
  own.setAttribute("tabindex", 0);
  own.append(
    make("circle", { class: "handle", cx: x + width, cy: y + height / 2, r: 8 }),
    make("text", { class: "sign", x: x + width, y: y + height / 2 + 4, "text-anchor": "middle" }, "−"),
    make("title", {}, `Fold or unfold ${count} ${count === 1 ? "box" : "boxes"} (click, or Enter)`));
  own.setAttribute("aria-expanded", "true");
  onPress(own, () => {
    fold(node, !isFolded(node));
    layOut();
  });
}
if (foldable.length) {
  addButton("Fold", "Fold all boxes but the first", () => foldAll(true));
  addButton("Unfold", "Unfold all boxes", () => foldAll(false));
}
