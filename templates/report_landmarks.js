// A landmark under the pointer, or chosen by name or key, is named with its true place, its estimate
// and its error, and lights up in every map that has it.

const landmarks = new Map();  // <svg> → its landmarks.
const kReach = 14;  // Pixels from a mark that still mean it.
let lit = "";  // The key of the landmark that is lit.
let isPinned = false;  // It stays when the pointer leaves.

// Marks of one landmark in one panel have ids "FIGURE[-PANEL]-KIND-ROW".
function readLandmarks(svg) {
  const found = new Map();
  for (const mark of svg.querySelectorAll("use[data-landmark]")) {
    const { landmark: name, kind, x, y, error } = mark.dataset;
    const place = mark.id.replace(`-${kind}-`, "#");
    const entry = found.get(place) ?? { name, places: [] };
    found.set(place, entry);
    entry.places.push({ x: Number(mark.getAttribute("x")), y: Number(mark.getAttribute("y")) });
    if (kind === "true" || kind === "anchor") entry.truth = [x, y];
    if (kind === "estimate") entry.estimate = [x, y];
    if (error !== undefined) entry.error = error;
  }
  return [...found.values()];
}

// The same landmark elsewhere: of the same name at the same true place. A name alone may stand for
// another landmark in another world.
function keyOf(svg, entry) {
  return `${entry.name}\n${entry.truth?.join() ?? svg.id}`;
}

function metres(text) {
  const value = Number(text);
  return value === 0 ? "0" : value.toFixed(Math.max(0, Math.min(6, 2 - Math.floor(Math.log10(Math.abs(value))))));
}

function linesOf(entry) {
  const point = ([x, y]) => `(${Number(x).toFixed(3)}, ${Number(y).toFixed(3)})`;
  const unit = entry.truth ? " m" : "";
  const lines = [];
  if (entry.truth) lines.push(`true ${point(entry.truth)} m`);
  if (entry.estimate) lines.push(`estimate ${point(entry.estimate)}${unit}`);
  if (entry.error !== undefined) lines.push(`error ${metres(entry.error)} m`);
  if (entry.truth && !entry.estimate) lines.push("an anchor, or without a place");
  return lines;
}

function addRings(svg, entry) {
  const layer = svg.querySelector("g.lit") ??
    svg.appendChild(document.createElementNS(svg.namespaceURI, "g"));
  layer.setAttribute("class", "lit");
  for (const { x, y } of entry.places) {
    const ring = document.createElementNS(svg.namespaceURI, "circle");
    for (const [name, value] of [["cx", x], ["cy", y], ["r", 6]]) ring.setAttribute(name, value);
    layer.append(ring);
  }
}

function showTip(svg, entry) {
  const box = svg.parentElement;
  const tip = box.querySelector(".tip") ?? box.appendChild(document.createElement("p"));
  tip.className = "tip";
  const name = document.createElement("bdi");
  name.textContent = entry.name;
  tip.replaceChildren(name);
  for (const line of linesOf(entry)) {
    const part = document.createElement("span");
    part.textContent = line;
    tip.append(part);
  }
  const { x, y } = entry.places.at(-1);
  const at = new DOMPoint(x, y).matrixTransform(svg.getScreenCTM());
  const frame = box.getBoundingClientRect();
  const right = at.x - frame.left > frame.width / 2, low = at.y - frame.top > frame.height / 2;
  tip.style.left = right ? "auto" : `${at.x - frame.left + 12}px`;
  tip.style.right = right ? `${frame.right - at.x + 12}px` : "auto";
  tip.style.top = low ? "auto" : `${at.y - frame.top + 12}px`;
  tip.style.bottom = low ? `${frame.bottom - at.y + 12}px` : "auto";
}

function lightIn(svg) {
  svg.querySelector("g.lit")?.remove();
  for (const entry of landmarks.get(svg) ?? []) {
    if (lit !== "" && keyOf(svg, entry) === lit) addRings(svg, entry);
  }
}

function light(svg, entry) {
  const key = entry ? keyOf(svg, entry) : "";
  for (const tip of document.querySelectorAll(".tip")) tip.remove();
  if (key !== lit) {
    lit = key;
    for (const each of landmarks.keys()) {
      lightIn(each);
      const list = each.closest("figure").querySelector("select.landmark");
      if (list) list.value = [...list.options].some((option) => option.value === lit) ? lit : "";
    }
  }
  if (entry) showTip(svg, entry);
}

function nearest(svg, event) {
  const at = pointOf(svg, event);
  const reach = kReach / svg.getScreenCTM().a;
  let best = null, least = reach;
  for (const entry of landmarks.get(svg)) {
    for (const { x, y } of entry.places) {
      const distance = Math.hypot(x - at.x, y - at.y);
      if (distance < least) [best, least] = [entry, distance];
    }
  }
  return best;
}

function chooseLandmark(svg, entry) {
  isPinned = entry !== undefined && entry !== null;
  light(svg, entry);
  announce(entry ? [entry.name, ...linesOf(entry)].join(", ") : "");
}

function stepLandmark(svg, count) {
  const entries = landmarks.get(svg);
  const at = entries.findIndex((entry) => keyOf(svg, entry) === lit);
  const next = at < 0 ? (count > 0 ? 0 : entries.length - 1) : at + count;
  chooseLandmark(svg, entries[(next + entries.length) % entries.length]);
}

// By name, for those who use no pointer.
function addLandmarkList(figure, svg) {
  const list = document.createElement("select");
  list.className = "landmark";
  list.setAttribute("aria-label", `Landmark in ${titleOf(figure)}`);
  list.append(new Option("Landmark \u2026", ""));
  const seen = new Set();
  for (const entry of landmarks.get(svg)) {
    const key = keyOf(svg, entry);
    if (!seen.has(key)) list.append(new Option(entry.name, key));
    seen.add(key);
  }
  list.addEventListener("change", () => chooseLandmark(svg,
    landmarks.get(svg).find((entry) => keyOf(svg, entry) === list.value)));
  figure.querySelector(".tools").append(list);
}

function followLandmarks(figure, svg) {
  const entries = readLandmarks(svg);
  if (entries.length === 0) return;
  landmarks.set(svg, entries);
  const box = svg.parentElement;
  box.addEventListener("pointermove", (event) => {
    const entry = event.buttons === 0 ? nearest(svg, event) : null;
    if (entry) isPinned = false;
    if (entry || !isPinned) light(svg, entry);
  });
  box.addEventListener("pointerleave", () => { if (!isPinned) light(svg, null); });
  box.addEventListener("click", (event) => {
    const entry = nearest(svg, event);
    if (entry) chooseLandmark(svg, entry);
  });
  box.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "n") stepLandmark(svg, 1);
    else if (event.key === "p") stepLandmark(svg, -1);
    else if (event.key === "Escape") chooseLandmark(svg, null);
  });
  box.addEventListener("viewchange", () => box.querySelector(".tip")?.remove());
  addLandmarkList(figure, svg);
  lightIn(svg);
}
