// A landmark under the pointer, or chosen by name or key, is named with its true place, its estimate
// and its error, and lights up in every map that has it.

const landmarks = new Map();  // <svg> → its landmarks.
const kReach = 14;  // Pixels from a mark that still mean it.
let lit = "";  // The key of the landmark that is lit.
let tipIn = null;  // The <svg> that names it.
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

function isWithin({ x, y, width, height }, place) {
  return place.x >= x && place.x <= x + width && place.y >= y && place.y <= y + height;
}

// The landmark of that key in the panel that is looked at, if it is in one.
function entryOf(svg, key) {
  const all = landmarks.get(svg).filter((entry) => keyOf(svg, entry) === key);
  return all.find((entry) => isWithin(panelOf(svg), entry.places.at(-1))) ?? all[0];
}

function addRings(svg, entry) {
  const layer = svg.querySelector("g.lit") ??
    svg.appendChild(document.createElementNS(svg.namespaceURI, "g"));
  layer.setAttribute("class", "lit");
  const panel = panelOf(svg);
  for (const { x, y } of entry.places.filter((place) => isWithin(panel, place))) {
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
  tipIn = entry ? svg : null;
  if (entry) showTip(svg, entry);
}

// What is shown of the drawing has changed: the words go with their landmark.
function followView(svg) {
  lightIn(svg);
  svg.parentElement.querySelector(".tip")?.remove();
  if (tipIn !== svg) return;
  const entry = entryOf(svg, lit);
  if (entry && isWithin(viewOf(svg).now, entry.places.at(-1))) showTip(svg, entry);
}

function nearest(svg, event) {
  const at = pointOf(svg, { x: event.clientX, y: event.clientY });
  const reach = kReach / svg.getScreenCTM().a;
  let best = null, least = reach;
  for (const entry of landmarks.get(svg)) {
    for (const { x, y } of entry.places.filter((place) => isWithin(panelOf(svg), place))) {
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

// Every landmark's key once, by name: "L2" before "L10".
function keysByName(svg) {
  const names = new Map(landmarks.get(svg).map((entry) => [keyOf(svg, entry), entry.name]));
  return [...names].sort(([, a], [, b]) => a.localeCompare(b, "en", { numeric: true }));
}

function stepLandmark(svg, count) {
  const keys = keysByName(svg).map(([key]) => key);
  const at = keys.indexOf(lit);
  const next = at < 0 ? (count > 0 ? 0 : keys.length - 1) : at + count;
  chooseLandmark(svg, entryOf(svg, keys[(next + keys.length) % keys.length]));
}

// By name, for those who use no pointer.
function addLandmarkList(figure, svg) {
  const list = document.createElement("select");
  list.className = "landmark";
  list.setAttribute("aria-label", `Landmark in ${titleOf(figure)}`);
  list.append(new Option("Landmark \u2026", ""));
  for (const [key, name] of keysByName(svg)) list.append(new Option(name, key));
  list.addEventListener("change", () => chooseLandmark(svg, entryOf(svg, list.value)));
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
  box.addEventListener("viewchange", () => followView(svg));
  addLandmarkList(figure, svg);
  lightIn(svg);
}
