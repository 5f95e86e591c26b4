// A drawing with axes is zoomed in its frames: all panels show the same part of them, with new
// ticks and grid lines; lines, marks and words keep their size. The view is a share of a frame, so that
// panels with axes of their own stay side by side.

const kMostOfAxes = 1000;  // Greatest magnification.
const kWholeFrame = { x: 0, y: 0, width: 1, height: 1 };
const kMostTicks = 6, kTickLength = 3.6;
const zoomedParts = new WeakMap();  // <svg> → what of it follows the view.

// Numbers that count from low to high: 1, 2 or 5 times a power of ten apart; on logarithmic axes of
// more than a decade powers of ten, with 2 and 5 where there are few.
function ticksOf({ scale, low, high }, most = kMostTicks) {
  if (!(high > low)) return [];
  const decades = Math.log10(high / low);
  if (scale === "log" && decades > 1) {
    const from = Math.floor(Math.log10(low)), to = Math.ceil(Math.log10(high));
    const stride = Math.max(1, Math.ceil((to - from) / most)), ticks = [];
    for (let power = from; power <= to; power += stride) {
      const factors = stride === 1 && decades <= 3 ? [1, 2, 5] : [1];
      ticks.push(...factors.map((factor) => Number(`${factor}e${power}`)));
    }
    return ticks.filter((tick) => low <= tick && tick <= high);
  }
  const least = (high - low) / most, decade = 10 ** Math.floor(Math.log10(least));
  const step = [1, 2, 5, 10].map((factor) => factor * decade).find((each) => each >= least * .999);
  const ticks = [];
  for (let i = Math.ceil(low / step - 1e-9); i <= Math.floor(high / step + 1e-9); ++i) {
    ticks.push(Number((i * step).toPrecision(12)));
  }
  return ticks;
}

// As many digits as tell neighbours apart; powers of ten where a number would be long.
function tickWords(tick, ticks) {
  if (tick === 0) return "0";
  const size = Math.abs(tick);
  if (size >= 1e6 || size < 1e-4) return powerWords(tick.toExponential().replace("e+", "e"));
  const digits = (value) => (String(value).split(".")[1] ?? "").length;
  const isEven = ticks.length < 3 || Math.abs(ticks[2] - 2 * ticks[1] + ticks[0]) < 1e-9 * size;
  const decimals = isEven ? Math.max(...ticks.map(digits)) : digits(tick);
  const isGrouped = ticks.map(Math.abs).some((other) => other >= 1e4 && other < 1e6);
  const [whole, behind] = tick.toFixed(decimals).replace("-", "\u2212").split(".");
  const grouped = isGrouped ? whole.replace(/\B(?=(\d{3})+$)/g, ",") : whole;
  return behind ? `${grouped}.${behind}` : grouped;
}

// The part of an axis that a view shows, from the left or from below.
function rangeShown({ scale, low, high }, start, end) {
  const at = scale === "log" ? (share) => low * (high / low) ** share
    : (share) => low + (high - low) * share;
  return { scale, low: at(start), high: at(end) };
}

// Where a value is on an axis, as a share from its low end.
function shareOf({ scale, low, high }, value) {
  return scale === "log" ? Math.log(value / low) / Math.log(high / low)
    : (value - low) / (high - low);
}

// What moves with the view of a panel: clipped shapes are scaled, with their lines as wide as
// before; marks and words move.
function contentOf(panel, frame) {
  const within = (selector) => panel.flatMap((part) =>
    [...part.matches(selector) ? [part] : [], ...part.querySelectorAll(selector)]);
  const shapes = within("[clip-path]");
  const strokes = shapes.flatMap((shape) => [shape, ...shape.querySelectorAll("[stroke-width]")])
    .filter((each) => each.hasAttribute("stroke-width"))
    .map((element) => ({ element, width: Number(element.getAttribute("stroke-width")),
      dashes: element.getAttribute("stroke-dasharray") }));
  const marks = within("use").filter((use) => /-(s\d+|ring)$/.test(use.getAttribute("href") ?? ""))
    .map((element) => ({ element, x: Number(element.getAttribute("x")),
      y: Number(element.getAttribute("y")) }));
  const words = within(".mark-label > g, .cell-text > g, g.mark-label[aria-label]")
    .map((element) => ({ element, transform: element.getAttribute("transform"),
      ...positionOf(element) }));
  for (const word of words) word.anchor = anchorOf(word, marks, frame);
  return { shapes, strokes, marks, words };
}

// The mark that words stand beside, or where they stand.
function anchorOf(word, marks, frame) {
  const kReachOfWords = .25 * frame.width;
  const off = (mark) => Math.hypot(mark.x - word.x, mark.y - word.y);
  const nearest = marks.reduce((best, mark) => (off(mark) < off(best) ? mark : best),
    { x: Infinity, y: Infinity });
  return off(nearest) < kReachOfWords ? nearest : word;
}

// The names at the ends of lines, each with the line that leads to it and the points of its curve.
function endsOf(parts, frame, panel) {
  const kLeads = /^m(-?[\d.]+) (-?[\d.]+)l(-?[\d.]+) ?(-?[\d.]+)$/;
  return legendEntries(parts).flatMap((entry) => {
    const leads = entry[0].querySelector("path"), words = entry.at(-1).querySelector("[data-words]");
    const [x, height, width, down] =
      (kLeads.exec(leads?.getAttribute("d") ?? "") ?? []).slice(1).map(Number);
    const isBeside = frame.right < x && x < frame.right + width &&
      frame.y - 1 < height && height < frame.bottom + 1;
    if (!isBeside || !words?.hasAttribute("transform")) return [];
    const path = panel.flatMap((part) => [part, ...part.querySelectorAll("[data-curve]")])
      .filter((each) => each.dataset.curve === words.dataset.words && !each.closest("g.band"))
      .map((each) => (each.localName === "path" ? each : each.querySelector("path"))).find(Boolean);
    if (!path) return [];
    const marker = entry.map((part) => part.querySelector("use")).slice(0, -1).find(Boolean);
    const drawn = [[leads, "d"], [words, "transform"], ...marker ? [[marker, "y"]] : []].map(
      ([element, name]) => [element, name, element.getAttribute(name)]);
    return [{ leads, x, width, row: height + down, marker, words, drawn,
      transform: words.getAttribute("transform"), points: pointsOfPath(path.getAttribute("d")) }];
  });
}

function hasAxes(svg) {
  const { frames, panels } = partsOf(svg);
  return panels.length > 0 && frames.every(({ axes }) => axes[0] || axes[1]);
}

// A frame's part [x, y, width, height] under a view, as a mapping of points to where the frame is
// shown, which may be larger.
function mappingOf(frame, shown, { x, y, width, height }) {
  const scale = shown.width / frame.width / width;
  const right = shown.x - scale * (frame.x + x * frame.width);
  const down = shown.y - scale * (frame.y + y * frame.height);
  return {
    scale, transform: `matrix(${scale} 0 0 ${scale} ${right} ${down})`,
    at: (point) => ({ x: scale * point.x + right, y: scale * point.y + down }),
    clip: { x: frame.x + x * frame.width, y: frame.y + y * frame.height,
      width: width * frame.width, height: height * frame.height },
  };
}

function isInFrame(frame, { x, y }) {
  return frame.x - .1 <= x && x <= frame.right + .1 && frame.y - .1 <= y && y <= frame.bottom + .1;
}

function zoomShapes(frame, { shapes, strokes }, { scale, transform, clip }) {
  for (const name of ["x", "y", "width", "height"]) frame.clip.setAttribute(name, clip[name]);
  for (const shape of shapes) {
    shape.dataset.zoom = scale === 1 ? "" : transform;
    placePart(shape);
  }
  for (const { element, width, dashes } of strokes) {
    element.setAttribute("stroke-width", width / scale);
    if (dashes) {
      element.setAttribute("stroke-dasharray",
        dashes.split(" ").map((dash) => Number(dash) / scale).join(" "));
    }
  }
}

function zoomMarks(frame, { marks, words }, mapping) {
  for (const { element, x, y } of marks) {
    const at = mapping.at({ x, y });
    element.setAttribute("x", at.x);
    element.setAttribute("y", at.y);
    element.classList.toggle("outside", mapping.scale > 1 && !isInFrame(frame, at));
  }
  for (const { element, transform, x, y, anchor } of words) {
    const at = mapping.at(anchor);
    const moved = `translate(${x + at.x - anchor.x} ${y + at.y - anchor.y})`;
    element.setAttribute("transform", mapping.scale === 1 ? transform
      : transform.replace(/translate\([^)]*\)/, moved));
    element.classList.toggle("outside", mapping.scale > 1 && !isInFrame(frame, at));
  }
}

// The height of a curve where the view ends on the right.
function heightAtRight(points, { clip, at }) {
  const x = clip.x + clip.width, next = points.findIndex((point) => point.x >= x);
  if (next <= 0) return at(points.at(next)).y;
  const a = points[next - 1], b = points[next], share = (x - a.x) / (b.x - a.x);
  return at({ x, y: a.y + share * (b.y - a.y) }).y;
}

// Whether a part of a curve is in the view.
function isInView(frame, points, mapping) {
  const kSteps = 20;  // Between two points.
  return points.some((point, i) => i > 0 && Array.from({ length: kSteps + 1 }, (_, k) => k / kSteps)
    .some((share) => isInFrame(frame, mapping.at({
      x: points[i - 1].x + share * (point.x - points[i - 1].x),
      y: points[i - 1].y + share * (point.y - points[i - 1].y) }))));
}

// The names at the ends of lines take the order in which their lines leave the view; of lines that are
// not in it they are hidden.
function zoomEnds(frame, ends, mapping) {
  if (mapping.scale === 1) {
    for (const [element, name, value] of ends.flatMap(({ drawn }) => drawn)) {
      if (element.getAttribute(name) !== value) element.setAttribute(name, value);
      element.classList.remove("outside");
    }
    return;
  }
  const rows = ends.map(({ row }) => row).sort((a, b) => a - b);
  const placed = ends.map((end) => ({ end, at: heightAtRight(end.points, mapping) }))
    .sort((a, b) => a.at - b.at);
  for (const [i, { end, at }] of placed.entries()) {
    const row = rows[i], nearest = clamp(at, frame.y, frame.bottom);
    const from = Math.abs(at - nearest) > 1 ? row : nearest;  // It leads to no line.
    const isOutside = !isInView(frame, end.points, mapping);
    for (const [element] of end.drawn) element.classList.toggle("outside", isOutside);
    end.leads.setAttribute("d", `m${end.x} ${from}l${end.width} ${row - from}`);
    end.marker?.setAttribute("y", row);
    end.words.setAttribute("transform", end.transform.replace(/translate\((\S+) (\S+?)\)/,
      (all, x, y) => `translate(${x} ${Number(y) + row - end.row})`));
  }
}

function addElement(parent, name, attributes) {
  const element = document.createElementNS(parent.namespaceURI, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  return parent.appendChild(element);
}

// The ticks of one axis of a frame: where they are, in the drawing's units, with their words; fewer
// where words would reach what `isFree` says is taken.
function placesOf(axis, start, end, at, isFree = () => true) {
  const shown = rangeShown(axis, start, end);
  const tries = [kMostTicks, 4, 3, 2].map((most) => {
    const ticks = ticksOf(shown, most);
    return ticks.map((tick) => ({ at: at(shareOf(shown, tick)), words: tickWords(tick, ticks) }));
  });
  return tries.find((places) => places.length > 1 && places.every(isFree)) ?? tries[0];
}

// Whether a tick's words, left of a frame, do not reach the label of the axis.
function isBesideLabel({ shown: frame, label, words: { size, gap } }) {
  const kWidthOfDigit = .64;
  return ({ at, words }) => !label || at + size < label.y || at - size > label.y + label.height ||
    frame.x - gap - kWidthOfDigit * size * words.length > label.x + label.width;
}

// Names along an axis stay, and move with what they name.
function namesOf(labels, side, mapping, frame) {
  return labels.map((label) => {
    const box = label.box;
    const middle = { x: side === "below" ? box.x + box.width / 2 : frame.x,
      y: side === "left" ? box.y + box.height / 2 : frame.bottom };
    const at = mapping.at(middle);
    return { at: side === "left" ? at.y : at.x, label,
      by: side === "left" ? { x: 0, y: at.y - middle.y } : { x: at.x - middle.x, y: 0 } };
  });
}

function addTicks(svg, part, side, frame, places) {
  const isLeft = side === "left", { size, gap } = part.words;
  const grid = places.map(({ at }) => (isLeft ? `M${frame.x} ${at}H${frame.right}`
    : `M${at} ${frame.y}V${frame.bottom}`)).join("");
  const marks = places.map(({ at }) => (isLeft ? `M${frame.x} ${at}h-${kTickLength}`
    : `M${at} ${frame.bottom}v${kTickLength}`)).join("");
  addElement(part.grid, "path", { d: grid });
  addElement(part.layer, "path", { d: marks, fill: "none", stroke: "#1a1a1a",
    "stroke-width": .75 });
  if (!part.isLabelled(side)) return;
  for (const { at, words, label, by } of places) {
    if (label) {
      addCopy(part.layer, label, by.x, by.y);
      continue;
    }
    addElement(part.layer, "text", isLeft
      ? { x: frame.x - gap, y: at + .36 * size, "text-anchor": "end", "font-size": size }
      : { x: at, y: frame.bottom + gap + .8 * size, "text-anchor": "middle", "font-size": size })
      .textContent = words;
  }
}

function zoomTicks(svg, part, view, mapping) {
  const { shown: frame, panel } = part, { x, y, width, height } = view;
  part.layer?.remove();
  part.grid?.remove();
  const isZoomed = mapping.scale !== 1;
  for (const each of panel.filter((one) => /^(grid|tick|tick-label)$/.test(kindOf(one)))) {
    each.classList.toggle("unzoomed", isZoomed);
  }
  if (!isZoomed) return;
  part.grid = addElement(svg, "g", { class: "zoom-grid", fill: "none", stroke: "#e4e4e4",
    "stroke-width": .75 });
  panel.find((each) => kindOf(each) !== "panel-title").before(part.grid);
  part.layer = addElement(svg, "g", { class: "zoom-ticks", fill: "#1a1a1a" });
  panel.at(-1).after(part.layer);
  const [across, up] = frame.axes;
  const isInside = (low, high) => ({ at }) => low <= at && at <= high;
  const below = across
    ? placesOf(across, x, x + width, (share) => frame.x + share * frame.width)
    : namesOf(part.labels.below, "below", mapping, frame);
  const left = up
    ? placesOf(up, 1 - y - height, 1 - y, (share) => frame.bottom - share * frame.height,
      isBesideLabel(part))
    : namesOf(part.labels.left, "left", mapping, frame);
  addTicks(svg, part, "below", frame, below.filter(isInside(frame.x, frame.right)));
  addTicks(svg, part, "left", frame, left.filter(isInside(frame.y, frame.bottom)));
  for (const layer of [part.grid, part.layer]) {
    shifts.set(layer, shifts.get(panel[0]) ?? kNoShift);
    placePart(layer);
  }
  if (panel[0].classList.contains("off")) [part.grid, part.layer].forEach((layer) =>
    layer.classList.add("off"));
}

// Reads what of the panels follows the view, before anything was moved.
function readZoomedParts(svg) {
  const parts = partsOf(svg), { frames, panels, axes } = parts, size = leastWords(svg);
  const labels = panels.map((panel, i) => {
    const found = tickLabelsOf(panel, frames[i]);
    for (const label of [...found.left, ...found.below]) label.box = boxIn(svg, label);
    return found;
  });
  const hasAll = () => svg.querySelector(":scope > .step-axes") !== null;
  return panels.map((panel, i) => ({
    panel, frame: frames[i], shown: frames[i], labels: labels[i], content: contentOf(panel, frames[i]),
    ends: endsOf(parts, frames[i], panel),
    label: axes.filter(isUpright)
      .filter((label) => frameOfLabel(label, frames)?.x === frames[i].x)
      .map((label) => boxIn(svg, label))[0],
    words: { size, gap: kTickLength + 3.6 },
    isLabelled: (side) => labels[i][side].length > 0 || hasAll(),
  }));
}

function applyAxes(svg, view) {
  for (const part of zoomedParts.get(svg)) {
    const mapping = mappingOf(part.frame, part.shown, view.now);
    zoomShapes(part.frame, part.content, mapping);
    zoomMarks(part.shown, part.content, mapping);
    zoomTicks(svg, part, view.now, mapping);
    if (!svg.parentElement.classList.contains("stacked")) zoomEnds(part.frame, part.ends, mapping);
  }
  for (const { panel, frame, shown } of zoomedParts.get(svg)) {
    for (const part of panel.filter((each) => kindOf(each) === "frame")) {
      placeFrame(part, shown, shown.width / frame.width);
    }
  }
  const isEnlarged = zoomedParts.get(svg).some(({ frame, shown }) => shown !== frame);
  svg.classList.toggle("zoomed-axes", view.isZoomed || isEnlarged);
}

// The border of a frame that is shown so many times as large.
function placeFrame(part, { x, y }, scale) {
  part.dataset.zoom = scale === 1 ? ""
    : `matrix(${scale} 0 0 ${scale} ${x * (1 - scale)} ${y * (1 - scale)})`;
  part.style.strokeWidth = scale === 1 ? "" : part.getAttribute("stroke-width") / scale;
  placePart(part);
}

// Shows the frames `factor` times as large, from their upper left corners; lines, marks and words keep
// their size.
function enlargeFrames(svg, factor) {
  if (!zoomedParts.has(svg)) return;
  for (const part of zoomedParts.get(svg)) {
    part.shown = factor === 1 ? part.frame : enlarged(part.frame, factor);
  }
  applyAxes(svg, viewOf(svg));
}

function enlarged(frame, factor) {
  const width = factor * frame.width, height = factor * frame.height;
  return { ...frame, width, height, right: frame.x + width, bottom: frame.y + height };
}

// What the axes of the first frame count in a view, for whoever cannot see them.
function wordsOfView(svg, { x, y, width, height }) {
  const { frame } = zoomedParts.get(svg)[0], shares = [[x, x + width], [1 - y - height, 1 - y]];
  const labels = labelsOfFrame([...svg.querySelectorAll(":scope > .axis-label > *")], frame);
  return frame.axes.flatMap((axis, i) => {
    if (!axis) return [];
    const { low, high } = rangeShown(axis, ...shares[i]), { name, unit } = labels[i];
    return [`${name} ${numberOnAxis(low)} to ${withAxisUnit(numberOnAxis(high), unit)}`.trim()];
  }).join(", ");
}

// The frame under a pointer, or the nearest one, where it is shown.
function frameAt(svg, point) {
  const shown = zoomedParts.get(svg).filter(({ panel }) => !panel[0].classList.contains("off"))
    .map(({ panel, shown: frame }) => {
      const { x, y } = shifts.get(panel[0]) ?? kNoShift;
      return { ...frame, x: frame.x + x, y: frame.y + y };
    });
  const off = ({ x, y, width, height }) => Math.hypot(
    Math.max(0, x - point.x, point.x - x - width), Math.max(0, y - point.y, point.y - y - height));
  return shown.reduce((best, frame) => (off(frame) < off(best) ? frame : best));
}

function axesAdapter(box, svg) {
  let held = null;  // The frame in which a drag began.
  return {
    ...drawingAdapter(box, svg),
    most: kMostOfAxes,
    apply(view) {
      applyAxes(svg, view);
      box.classList.toggle("zoomed", view.isZoomed);
      box.dispatchEvent(new CustomEvent("viewchange"));
    },
    position(event) {
      const point = pointOf(svg, { x: event.clientX, y: event.clientY });
      const frame = event.buttons && held ? held : frameAt(svg, point);
      return { x: (point.x - frame.x) / frame.width, y: (point.y - frame.y) / frame.height };
    },
    point({ x, y }) {
      const { now } = viewOf(svg);
      return { x: now.x + clamp(x, 0, 1) * now.width, y: now.y + clamp(y, 0, 1) * now.height };
    },
    grab(event) {
      if (event.isPrimary) held = frameAt(svg, pointOf(svg, { x: event.clientX, y: event.clientY }));
    },
  };
}
