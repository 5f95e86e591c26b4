// The parts of a drawing by panel, for what shows panels alone, one below the other, or zoomed.

const kNoShift = { x: 0, y: 0 };
const kShared = /^(title|note|legend-|panel-arrow)/;  // Classes of what belongs to no panel.
const partsOfDrawings = new WeakMap();  // <svg> → its parts.
const shifts = new WeakMap();  // A part of a panel → how far it was moved, { x, y }.

// The frames of the panels in their order, with what their axes count: "linear 0 2000".
function framesOf(svg) {
  return [...svg.querySelectorAll(":scope > defs > clipPath > rect")].map((rect) => {
    const [x, y, width, height] = ["x", "y", "width", "height"].map(
      (name) => Number(rect.getAttribute(name)));
    const axis = (text) => {
      const [scale, low, high] = (text ?? "").split(" ");
      return text ? { scale, low: Number(low), high: Number(high) } : null;
    };
    return { x, y, width, height, right: x + width, bottom: y + height, clip: rect,
      axes: [axis(rect.dataset.x), axis(rect.dataset.y)] };
  });
}

// What a part is: "tick-label"; other classes say how it is shown.
const kindOf = (part) => part.classList[0] ?? "";

function clipOf(part) {
  const clipped = part.hasAttribute("clip-path") ? part : part.querySelector("[clip-path]");
  const number = /-c(\d+)\)$/.exec(clipped?.getAttribute("clip-path") ?? "")?.[1];
  return number === undefined ? -1 : Number(number);
}

// The frame that a point is in, or that is nearest to it, among several.
function frameNear(frames, { x, y }) {
  const off = (frame) => Math.hypot(Math.max(0, frame.x - x, x - frame.right),
    Math.max(0, frame.y - y, y - frame.bottom));
  return frames.reduce((best, frame, i) => (off(frame) < off(frames[best]) ? i : best), 0);
}

// Names of marks are drawn last, those of all panels in one group: each panel gets its own.
function splitByFrame(part, frames) {
  const own = new Map();
  for (const child of [...part.children]) {
    const frame = frameNear(frames, positionOf(child));
    if (own.size === 0) own.set(frame, part);
    if (!own.has(frame)) {
      const group = part.cloneNode(false);
      part.after(group);
      own.set(frame, group);
    }
    if (own.get(frame) !== part) own.get(frame).append(child);
  }
  return own;
}

// What is drawn in each panel, from its heading on; the labels of the axes, which panels may share;
// and others. `panels` is empty where it is open which panel a part belongs to.
function partsOf(svg) {
  if (partsOfDrawings.has(svg)) return partsOfDrawings.get(svg);
  const frames = framesOf(svg);
  const parts = { frames, panels: frames.length === 1 ? [[]] : [], axes: [], rest: [],
    whole: viewBoxOf(svg) };
  let hasBody = true, isLate = false;  // Whether a panel has more than its heading.
  for (const part of svg.querySelectorAll(":scope > g:not(.lit)")) {
    const kind = kindOf(part), clip = clipOf(part);
    if (kind === "axis-label") parts.axes.push(...part.children);
    else if (kShared.test(kind)) {
      parts.rest.push(part);
      isLate ||= kind.startsWith("legend-");
    } else if (frames.length === 1) parts.panels[0].push(part);
    else {
      const isHead = kind === "panel-title", isFirst = /^(grid|image)$/.test(kind);
      if ((isHead || isFirst) && hasBody) {
        parts.panels.push([]);
        isLate = false;
      }
      hasBody = !isHead;
      if (isLate && kind === "mark-label") {
        for (const [frame, own] of splitByFrame(part, frames)) parts.panels[frame]?.push(own);
        continue;
      }
      parts.panels[isLate && clip >= 0 ? clip : parts.panels.length - 1]?.push(part);
      if (clip >= 0 && clip !== parts.panels.length - 1 && !isLate) parts.isMixed = true;
    }
  }
  if (parts.isMixed || parts.panels.length !== frames.length) parts.panels = [];
  partsOfDrawings.set(svg, parts);
  return parts;
}

// Where an element is, in the units of the drawing before anything was moved.
function boxIn(svg, element) {
  const { left, top, width, height } = element.getBoundingClientRect();
  const { a } = svg.getScreenCTM(), { x, y } = pointOf(svg, { x: left, y: top });
  const shift = shiftOf(element);
  return { x: x - shift.x, y: y - shift.y, width: width / a, height: height / a };
}

function shiftOf(element) {
  return shifts.get(element.closest("svg > g")) ?? kNoShift;
}

function setTransform(part, text) {
  if (text) part.setAttribute("transform", text);
  else part.removeAttribute("transform");
}

// Moves all parts of a panel; what is zoomed in it stays so.
function movePanel(panel, shift) {
  for (const part of panel) {
    shifts.set(part, shift);
    placePart(part);
  }
}

function placePart(part) {
  const { x, y } = shifts.get(part) ?? kNoShift;
  const moved = x === 0 && y === 0 ? "" : `translate(${x} ${y})`;
  setTransform(part, [moved, part.dataset.zoom ?? ""].filter(Boolean).join(" "));
}

// Where a mark is shown, in the units of the drawing.
function positionOfMark({ element }) {
  const shift = shiftOf(element);
  return { x: Number(element.getAttribute("x")) + shift.x,
    y: Number(element.getAttribute("y")) + shift.y };
}

function positionOf(label) {
  const pattern = /translate\(([-\d.]+)(?:[ ,]([-\d.]+))?\)/;
  const [, x, y] = pattern.exec(label.getAttribute("transform")) ?? [];
  return { x: Number(x ?? 0), y: Number(y ?? 0) };
}

const isUpright = (label) => /rotate/.test(label.getAttribute("transform"));

// Whether a tick label is one of the x axis: the lowest one of the y axis reaches below the frame.
const isBelowFrame = (label, frame) => positionOf(label).y > frame.bottom + 8;

// The tick labels of a panel: those left of its frame, and those below it.
function tickLabelsOf(panel, frame) {
  const all = panel.filter((part) => part.classList.contains("tick-label"))
    .flatMap((part) => [...part.children]);
  const isBelow = (label) => isBelowFrame(label, frame);
  return { left: all.filter((label) => !isBelow(label)), below: all.filter(isBelow) };
}

function addCopy(layer, label, right, down) {
  const moved = layer.appendChild(document.createElementNS(layer.namespaceURI, "g"));
  moved.setAttribute("transform", `translate(${right} ${down})`);
  moved.setAttribute("fill", label.parentElement.getAttribute("fill") ?? "currentColor");
  moved.append(label.cloneNode(true));
  return moved;
}

// How far right of a label of an axis, or above it, a frame is: none has its label on another side.
function gapOfLabel(label, frame) {
  const { x, y } = positionOf(label);
  return isUpright(label) ? frame.x - x : y - frame.bottom;
}

function middleOfLabel(label) {
  const { x, y, width, height } = boxIn(label.ownerSVGElement, label);
  return { x: x + width / 2, y: y + height / 2 };
}

// Whether a label of an axis stands in the row or column of a frame.
function isInLine(label, frame) {
  const { x, y } = middleOfLabel(label);
  return isUpright(label) ? frame.y < y && y < frame.bottom : frame.x < x && x < frame.right;
}

// The frame that a label of an axis belongs to, among those of its row or column the nearest one.
function frameOfLabel(label, frames) {
  const gap = (frame) => gapOfLabel(label, frame);
  return frames.filter((frame) => gap(frame) > 0)
    .sort((a, b) => isInLine(label, b) - isInLine(label, a) || gap(a) - gap(b))[0];
}

// The label of each axis of a panel, with all of its lines: of several on its side of the panel, the one
// in its row or column that is nearest to it.
function axisLabelsOf(parts, frame) {
  const off = (label) => {
    const at = middleOfLabel(label);
    return Math.hypot(at.x - frame.x - frame.width / 2, at.y - frame.y - frame.height / 2);
  };
  const kMostBeside = 40;  // Lines of one label, which have one middle.
  const areOne = (a, b) => a.dataset.words === b.dataset.words &&
    Math.abs(middleOfLabel(a).y - middleOfLabel(b).y) < 2 &&
    Math.abs(middleOfLabel(a).x - middleOfLabel(b).x) < kMostBeside;
  return [true, false].flatMap((upright) => {
    const labels = parts.axes
      .filter((label) => isUpright(label) === upright && gapOfLabel(label, frame) > 0)
      .sort((a, b) => isInLine(b, frame) - isInLine(a, frame) || off(a) - off(b));
    return labels.filter((label) => areOne(label, labels[0]))
      .map((label) => ({ label, upright, middle: middleOfLabel(label) }));
  });
}

// The labels of the axes that a panel shares with others, moved to this panel.
// `shown`: its frame as it is shown, which may be larger.
function sharedAxes(svg, parts, step, shift = kNoShift, shown = parts.frames[step]) {
  const layer = document.createElementNS(svg.namespaceURI, "g");
  layer.setAttribute("class", "step-axes");
  const { frames } = parts, frame = frames[step];
  const numbers = parts.panels.map((panel, i) => tickLabelsOf(panel, frames[i]));
  for (const side of ["left", "below"]) {
    const from = numbers.findIndex((each) => each[side].length > 0);
    if (from < 0 || numbers[step][side].length > 0) continue;
    for (const label of numbers[from][side]) {
      addCopy(layer, label, frame.x - frames[from].x, frame.y - frames[from].y)
        .classList.add("tick-copy");
    }
  }
  for (const { label, upright, middle } of axisLabelsOf(parts, frame)) {
    const from = frameOfLabel(label, frames);
    addCopy(layer, label, upright ? shown.x - from.x : shown.x + shown.width / 2 - middle.x,
      upright ? shown.y + shown.height / 2 - middle.y : shown.bottom - from.bottom);
  }
  shifts.set(layer, shift);
  placePart(layer);
  return layer;
}

const kEdge = 4;  // Between what stands around a frame and the edge.

// What a panel needs around its frame, the greatest of all panels, for headings and labels.
function roomsOf(svg, parts) {
  const rooms = { left: kEdge, above: kEdge, right: 6, below: 6 };
  const see = (box, frame) => {
    rooms.left = Math.max(rooms.left, frame.x - box.x + kEdge);
    rooms.above = Math.max(rooms.above, frame.y - box.y + kEdge);
    rooms.right = Math.max(rooms.right, box.x + box.width - frame.right + kEdge);
    rooms.below = Math.max(rooms.below, box.y + box.height - frame.bottom);
  };
  parts.panels.forEach((panel, i) => {
    const seen = panel.filter(
      (part) => /^(panel-title|tick-label|tick|mark-label)$/.test(kindOf(part)));
    for (const part of seen) see(boxIn(svg, part), parts.frames[i]);
  });
  for (const label of parts.axes) {
    const box = boxIn(svg, label), frame = frameOfLabel(label, parts.frames);
    if (!frame) return null;  // Of a colour bar.
    if (isUpright(label)) rooms.left = Math.max(rooms.left, frame.x - box.x + kEdge);
    else rooms.below = Math.max(rooms.below, box.y + box.height - frame.bottom + kEdge);
  }
  return rooms;
}
