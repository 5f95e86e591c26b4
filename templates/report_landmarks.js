// A landmark under the pointer, or chosen by name or key, gets a tip with its ground truth, its
// estimate and its error, and is highlighted in every map of the same world.

const landmarks = new Map();  // <svg> → its landmarks.
const kReach = 14;  // Greatest distance of the pointer from a mark, in pixels.
let lit = "";  // The key of the highlighted landmark.
let tipIn = null;  // The <svg> that shows its tip.
let isPinned = false;  // Whether it stays when the pointer leaves.

const kMarkKinds = ["true", "anchor", "estimate"];

// Marks of one landmark in one panel have ids "FIGURE[-PANEL]-KIND-ROW".
function readLandmarks(svg) {
  const found = new Map();
  for (const mark of svg.querySelectorAll("use[data-landmark]")) {
    const { landmark: name, kind, x, y, error } = mark.dataset;
    const key = mark.id.replace(`-${kind}-`, "#");
    const entry = found.get(key) ?? { name, marks: [], byMethods: [] };
    found.set(key, entry);
    entry.marks.push({ element: mark });
    if (kind === "true" || kind === "anchor") entry.groundTruth = [x, y];
    if (kind === "anchor") entry.isAnchor = true;
    if (kind === "estimate") entry.estimate = [x, y];
    // A drawing of several methods has one mark each, whose kind is the method: "dead-reckoning".
    if (!kMarkKinds.includes(kind)) entry.byMethods.push({ method: kind, position: [x, y] });
    if (error !== undefined) entry.error = error;
  }
  return [...found.values()];
}

// Marks show the same landmark if its name and its true position are the same: two worlds may use
// one name.
function keyOf(svg, entry) {
  return `${entry.name}\n${entry.groundTruth?.join() ?? svg.id}`;
}

const kLeastError_m = 5e-7;  // What six decimals show as zero.
const kGreatestError_m = 1000;  // The error of a map that diverged is said in words.

// Three significant digits.
function errorWords(text) {
  const value = Number(text);
  if (value > kGreatestError_m) return "over 1\u00a0km";
  if (value < kLeastError_m) return "0 m";
  return `${value.toFixed(clamp(2 - Math.floor(Math.log10(Math.abs(value))), 0, 6))} m`;
}

function linesOf(entry) {
  const point = ([x, y]) => `(${Number(x).toFixed(3)}, ${Number(y).toFixed(3)})`;
  const unit = entry.groundTruth ? " m" : "";
  const lines = [];
  if (entry.groundTruth) lines.push(`ground truth ${point(entry.groundTruth)} m`);
  if (entry.estimate) lines.push(`estimate ${point(entry.estimate)}${unit}`);
  if (entry.error !== undefined) lines.push(`error ${errorWords(entry.error)}`);
  for (const { method, position } of entry.byMethods) {
    const off = entry.groundTruth && Math.hypot(position[0] - entry.groundTruth[0],
      position[1] - entry.groundTruth[1]);
    lines.push(`${method.replaceAll("-", " ")} ${point(position)}${unit}` +
      (off === undefined ? "" : `, ${errorWords(off)} off`));
  }
  if (entry.isAnchor) lines.push("an anchor: its position is given");
  else if (entry.groundTruth && !entry.estimate && entry.byMethods.length === 0) lines.push("not in the map");
  return lines;
}

function isWithin({ x, y, width, height }, point) {
  return point.x >= x && point.x <= x + width && point.y >= y && point.y <= y + height;
}

// Whether a mark is in sight: in the panel that is shown, and not zoomed away.
function isShown(svg, { element }) {
  if (element.classList.contains("outside") || element.closest(".off")) return false;
  return isWithin(zoomedParts.has(svg) ? panelOf(svg) : viewOf(svg).now,
    positionOfMark({ element }));
}

// The landmark with that key, in the visible panel if that panel has it.
function entryOf(svg, key) {
  const all = landmarks.get(svg).filter((entry) => keyOf(svg, entry) === key);
  return all.find((entry) => isShown(svg, entry.marks.at(-1))) ?? all[0];
}

function addRings(svg, entry) {
  const layer = svg.querySelector("g.lit") ??
    svg.appendChild(document.createElementNS(svg.namespaceURI, "g"));
  layer.setAttribute("class", "lit");
  const marks = entry.marks.filter((mark) => isShown(svg, mark));
  for (const { x, y } of marks.map(positionOfMark)) {
    const ring = document.createElementNS(svg.namespaceURI, "circle");
    for (const [name, value] of [["cx", x], ["cy", y], ["r", 6]]) ring.setAttribute(name, value);
    layer.append(ring);
  }
}

// A tip beside a place of the window, inside the drawing.
function putTip(svg, heading, lines, at) {
  const box = svg.parentElement;
  const tip = box.querySelector(".tip") ?? box.appendChild(document.createElement("p"));
  tip.className = "tip";
  const name = document.createElement("bdi");
  name.textContent = heading;
  tip.replaceChildren(name);
  for (const line of lines) {
    const part = document.createElement("span");
    part.textContent = line;
    tip.append(part);
  }
  const frame = box.getBoundingClientRect();
  const right = at.x - frame.left > frame.width / 2, low = at.y - frame.top > frame.height / 2;
  tip.style.left = right ? "auto" : `${at.x - frame.left + 12}px`;
  tip.style.right = right ? `${frame.right - at.x + 12}px` : "auto";
  tip.style.top = low ? "auto" : `${at.y - frame.top + 12}px`;
  tip.style.bottom = low ? `${frame.bottom - at.y + 12}px` : "auto";
  return tip;
}

function showTip(svg, entry) {
  const { x, y } = positionOfMark(entry.marks.at(-1));
  putTip(svg, entry.name, linesOf(entry), new DOMPoint(x, y).matrixTransform(svg.getScreenCTM()));
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

// After a change of the view the tip stays with its landmark.
function followView(svg) {
  lightIn(svg);
  svg.parentElement.querySelector(".tip")?.remove();
  if (tipIn !== svg) return;
  const entry = entryOf(svg, lit);
  if (entry && isShown(svg, entry.marks.at(-1))) showTip(svg, entry);
}

function nearest(svg, event) {
  const at = pointOf(svg, { x: event.clientX, y: event.clientY });
  const reach = kReach / svg.getScreenCTM().a;
  let best = null, least = reach;
  for (const entry of landmarks.get(svg)) {
    const marks = entry.marks.filter((mark) => isShown(svg, mark));
    for (const { x, y } of marks.map(positionOfMark)) {
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

// The key of each landmark once, ordered by name: "L2" before "L10".
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

// A list of names, for readers without a pointer.
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
